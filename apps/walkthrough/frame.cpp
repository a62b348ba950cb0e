#include "apps/walkthrough/frame.h"

#include <glad/gl.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "apps/walkthrough/options.h"
#include "foliage/import/ldm_cache.h"
#include "gl/context.h"
#include "scenegraph/draw/frame_data.h"
#include "scenegraph/import/picture_square.h"

namespace manzana::walkthrough {
namespace {

class Stopwatch {
 public:
  /// Seconds since the last lap.
  double lap() {
    const auto now = Clock::now();
    const std::chrono::duration<double> passed = now - last_;
    last_ = now;
    return passed.count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

/// Its own clock tells nothing of a software renderer: the frame's does, once it is done.
bool must_wait(const Stage& stage) { return stage.tree_ms > 0 && gl::software_renderer(); }

/// Of two budgets the stricter.
draw::DrawOptions options_within_budget(const Stage& stage) {
  draw::DrawOptions options = stage.options;
  if (stage.tree_ms > 0)
    options.tree_vertices = options.tree_vertices > 0 ? std::min(options.tree_vertices, stage.time_budget.vertices)
                                                      : stage.time_budget.vertices;
  return options;
}

constexpr std::size_t kGroveBytesAFrame = 256 << 10;

/// Brings what is in sight; what is still missing hides nothing. Seconds.
double bring(Stage& stage) {
  Stopwatch watch;
  stage.renderer.bring(stage.scene, stage.sets, stage.options.upload_bytes);
  const double seconds = watch.lap();
  stage.horizon.reveal(stage.scene, stage.sets, [&](std::uint32_t row) { return stage.renderer.holds_building(row); });
  return seconds;
}

/// What far trees asked for: so much in a frame that nobody waits for it, unless a frame is to be whole. True: there is
/// something new.
bool add_far_trees(Stage& stage) {
  if (!stage.far) return false;
  stage.far->want(stage.renderer);
  return stage.whole ? stage.far->give_all(stage.renderer) : stage.far->give(stage.renderer, kGroveBytesAFrame);
}

constexpr std::size_t kPictureBytesAFrame = 4 << 20;

/// Likewise of pictures that buildings wear.
bool add_pictures(Stage& stage) {
  stage.pictures.want(stage.renderer);
  return stage.whole ? stage.pictures.give_all(stage.renderer)
                     : stage.pictures.give(stage.renderer, kPictureBytesAFrame);
}

/// Kept on disk.
std::optional<foliage::LdmPack> pack_of(const foliage::PreparedPlant& plant) {
  const auto tell = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  try {
    return load_or_make_far_pack(plant, foliage::default_cache_folder(), tell);
  } catch (const std::exception& error) {
    tell(plant.name + ": far trees stay as near ones are: " + error.what());
    return std::nullopt;
  }
}

}  // namespace

void make_far_trees(Stage& stage, std::span<const foliage::PreparedPlant> plants) {
  stage.far.emplace(draw::FarTreeSource{plants, stage.renderer.sites()}, draw::FarTreeHow{.make_pack = pack_of});
}

Stage::Stage(const Scene& city, std::span<const foliage::PreparedPlant> plants, const draw::Quality& quality,
             draw::Size first_size, std::size_t gpu_bytes)
    : scene(city),
      renderer(city, plants, quality, gpu_bytes),
      sets(city),
      horizon(city),
      size(first_size),
      pictures(
          [&city](const draw::PictureWanted& w) { return picture_square(city.pictures.encoded[w.picture], w.side); }) {
  options.tree_error_px = quality.tree_error_px;
  options.tree_law = quality.tree_law;
  renderer.resize(size);
}

void Stage::resize(draw::Size new_size) {
  if (new_size.width == size.width && new_size.height == size.height) return;
  size = new_size;
  renderer.resize(size);
}

void apply(const Options& options, Stage& stage) {
  stage.structure = options.structure;
  stage.sets.classes = options.only;
  if (options.tree_error_px) stage.options.tree_error_px = *options.tree_error_px;
  stage.options.tree_vertices = options.tree_vertices;
  stage.tree_ms = options.tree_ms;
  if (options.tree_law) stage.options.tree_law = options.tree_law;
  stage.options.trees_by_node = options.trees_by_node;
  stage.options.wind = options.wind ? 1 : 0;
  if (options.sun_deg) stage.options.sun = draw::sun_direction((*options.sun_deg)[0], (*options.sun_deg)[1]);
}

FrameRow draw_frame(Stage& stage, const culling::View& view, double seconds) {
  const culling::View& seen_by = stage.options.frozen != nullptr ? *stage.options.frozen : view;
  FrameRow row;
  Stopwatch watch;
  find_visible(stage.scene, seen_by, stage.structure, stage.sets);
  const bool hide = stage.structure == Structure::bqr && stage.options.layers.buildings;
  if (hide) stage.horizon.hide(stage.scene, {seen_by.eye, stage.sets.frustum.planes[culling::kNear]}, stage.sets);
  row.cull_us = watch.lap() * 1e6;
  const double bring_s = hide ? bring(stage) : 0;
  find_cars(stage.scene, ticks(seconds), stage.sets);
  if (hide) stage.horizon.hide_cars(stage.sets);
  row.update_us = (watch.lap() - bring_s) * 1e6;
  stage.options.seconds = seconds;
  stage.timer.begin();
  draw::FrameCounts counts = stage.renderer.draw(stage.scene, stage.sets, view, options_within_budget(stage));
  const bool dressed = add_pictures(stage);
  if ((add_far_trees(stage) || dressed) && stage.whole) {
    watch.lap();
    counts = stage.renderer.draw(stage.scene, stage.sets, view, options_within_budget(stage));
  }
  stage.timer.end();
  if (stage.wait || must_wait(stage)) glFinish();
  row.draw_ms = (watch.lap() + bring_s) * 1e3;
  row.meshes_missing = counts.bytes_without_room;
  row.blocks_visible = stage.sets.block_count();
  row.buildings_visible = counts.buildings;
  row.trees_visible = counts.trees;
  row.cars_visible = counts.cars;
  // Trees by the newest frame that the GPU has finished: this one, if it was waited for.
  const foliage::Shown trees = stage.renderer.trees_shown();
  row.triangles = counts.triangles + 2 * (trees.bark + trees.leaves + trees.lines);
  row.points = trees.points + counts.points;
  row.tree_error_px = counts.tree_error_px;
  row.tree_law = counts.tree_law;
  row.trees_missing = trees.missing;
  if (stage.tree_ms > 0)
    follow(stage.time_budget, gl::software_renderer() ? row.frame_ms() : stage.timer.newest_ms(), stage.tree_ms,
           static_cast<double>(4 * (trees.bark + trees.leaves + trees.lines) + trees.points));
  return row;
}

}  // namespace manzana::walkthrough
