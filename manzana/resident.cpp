#include "manzana/resident.h"

#include <tbb/task_arena.h>

#include "foliage/import/ldm_cache.h"
#include "scenegraph/import/picture_square.h"

namespace manzana {
namespace {

void find(const Resident& resident, Eye& eye) {
  eye.nodes.clear();
  if (!resident.nodes) return find_visible(resident.model->scene(), eye.camera.frustum, Structure::bqr, *eye.sets);
  find_visible(*resident.nodes, eye.camera.frustum, *eye.sets);
  resident.nodes->find(eye.sets->nodes(), eye.nodes);
}

/// Of a model on its way what will be hidden once it is there: the rest need not be brought.
void hide(Resident& resident, Eye& eye) {
  const Scene& scene = resident.model->scene();
  if (!resident.horizon) resident.horizon = std::make_unique<Horizon>(scene);
  resident.horizon->hide(scene, {eye.camera.eye, near_plane(eye.camera)}, *eye.sets);
  if (!resident.shown) return;
  resident.horizon->reveal(scene, *eye.sets, [&](std::uint32_t row) { return resident.renderer->holds_building(row); });
}

/// On the calling thread alone.
std::optional<foliage::LdmPack> far_pack(const Model& model, const foliage::PreparedPlant& plant) {
  try {
    tbb::task_arena arena(1);
    return arena.execute([&] { return load_or_make_far_pack(plant, model.plant_cache(), [](const std::string&) {}); });
  } catch (const std::exception&) {
    return std::nullopt;  // its far trees are drawn as near ones are
  }
}

}  // namespace

bool hides(const Eye& eye, const Sight& sight) { return sight.buildings && !eye.camera.orthographic; }

void see(Resident& resident, Eye& eye, const HostCamera& camera, const Sight& sight) {
  const Scene& scene = resident.model->scene();
  eye.host = camera;
  eye.camera = draw::camera_of(camera.projection, camera.view, camera.depth, camera.viewport.height);
  eye.hides = hides(eye, sight);
  if (!eye.sets) eye.sets = std::make_unique<VisibleSets>(scene);
  eye.sets->classes = sight.classes;
  find(resident, eye);
  if (eye.hides) hide(resident, eye);
  find_cars(scene, ticks(sight.seconds), *eye.sets);
  if (eye.hides) resident.horizon->hide_cars(*eye.sets);
}

void see(Resident& resident, std::span<const HostCamera> cameras, const Sight& sight) {
  if (resident.eyes.size() < cameras.size()) resident.eyes.resize(cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) see(resident, resident.eyes[i], cameras[i], sight);
}

Update::Seen count_seen(const Resident& resident, const Eye& eye) {
  const Scene& scene = resident.model->scene();
  const VisibleSets& sets = *eye.sets;
  return {sets.block_count(),
          count(scene.buildings.table, sets.objects()),
          count(scene.surfaces.table, sets.objects()),
          count(scene.trees.table, sets.objects()),
          sets.cars.size(),
          eye.nodes.size()};
}

/// Tasks hold the model: they may end after the view.
std::unique_ptr<draw::FarTreeMaker> make_far_trees(const Resident& resident, const Host& host) {
  const std::shared_ptr<const Model> model = resident.model;
  const auto pack = [model](const foliage::PreparedPlant& plant) { return far_pack(*model, plant); };
  return std::make_unique<draw::FarTreeMaker>(
      draw::FarTreeSource{model->plants(), resident.renderer->sites(), model},
      draw::FarTreeHow{.make_pack = pack, .run = host.run, .arrived = host.request_repaint});
}

std::unique_ptr<draw::PictureMaker> make_pictures(const Resident& resident, const Host& host) {
  const auto make = [model = resident.model](const draw::PictureWanted& wanted) {
    return picture_square(model->scene().pictures.encoded[wanted.picture], wanted.side);
  };
  return std::make_unique<draw::PictureMaker>(make, host.run, host.request_repaint);
}

}  // namespace manzana
