// manzana.h over view.h: a handle each, nothing thrown across.
#include <algorithm>
#include <cstring>

#include "manzana/manzana.h"
#include "manzana/view.h"
#include "scenegraph/import/model_file.h"

struct manzana_model {
  std::shared_ptr<const manzana::Model> model;
};
struct manzana_nodes {
  std::shared_ptr<manzana::Nodes> nodes;
};
struct manzana_view {
  manzana::View view;
};

namespace {

using namespace manzana;

void tell(manzana_error* error, const char* what) {
  if (error == nullptr) return;
  const std::size_t n = std::min(std::strlen(what), sizeof error->text - 1);
  std::memcpy(error->text, what, n);
  error->text[n] = '\0';
}

/// What `f` returns, or `failed`, with a line.
template <class F, class T>
T guarded(manzana_error* error, T failed, F&& f) noexcept {
  try {
    return f();
  } catch (const std::exception& e) {
    tell(error, e.what());
  } catch (...) {
    tell(error, "an unknown error");
  }
  return failed;
}

LoadOptions options_of(const manzana_load_options* given) {
  const manzana_load_options o = given != nullptr ? *given : manzana_load_defaults();
  LoadOptions options{
      .seed = o.seed, .cars = o.cars, .threads = o.threads, .trees = o.trees != 0, .attributes = o.attributes != 0};
  if (o.plant_cache != nullptr) options.plant_cache = o.plant_cache;
  if (o.orthophoto != nullptr) options.orthophoto = o.orthophoto;
  return options;
}

Progress progress_of(manzana_progress progress, void* user) {
  if (progress == nullptr) return {};
  return [=](std::string_view stage, double fraction) { progress(user, std::string(stage).c_str(), fraction); };
}

/// 1, or 0 with a line.
template <class F>
int done(manzana_error* error, F&& f) noexcept {
  return guarded(error, 0, [&] {
    f();
    return 1;
  });
}

template <class Load>
manzana_model* loaded(manzana_error* error, Load&& load) {
  return guarded(error, static_cast<manzana_model*>(nullptr), [&] { return new manzana_model{load()}; });
}

Mat4d matrix_of(const double* columns) {
  Mat4d m;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) m[c][r] = columns[4 * c + r];
  return m;
}

HostCamera camera_of(const manzana_camera& c) {
  constexpr culling::ClipDepth kDepths[] = {culling::ClipDepth::minus_one_to_one, culling::ClipDepth::zero_to_one,
                                            culling::ClipDepth::reversed};
  return {
      matrix_of(c.projection), matrix_of(c.view), kDepths[std::clamp(c.depth, 0, 2)], {c.x, c.y, c.width, c.height}};
}

Vec3d vector_of(const double* p) { return {p[0], p[1], p[2]}; }
void put(const Vec3d& from, double* to) { std::copy_n(&from.x, 3, to); }
void put(const GeoPoint& from, double* to) {
  to[0] = from.lat_deg;
  to[1] = from.lon_deg;
  to[2] = from.height_m;
}

using Task = std::function<void()>;

void run_task(void* argument) {
  const std::unique_ptr<Task> task(static_cast<Task*>(argument));
  (*task)();
}

Host host_of(const manzana_host* given) {
  if (given == nullptr) return {};
  const manzana_host h = *given;
  Host host;
  if (h.log != nullptr) host.log = [h](const std::string& line) { h.log(h.user, line.c_str()); };
  if (h.request_repaint != nullptr) host.request_repaint = [h] { h.request_repaint(h.user); };
  host.get_proc_address = h.get_proc_address;
  if (h.run != nullptr) host.run = [h](Task task) { h.run(h.user, run_task, new Task(std::move(task))); };
  return host;
}

}  // namespace

const char* manzana_version(void) { return MANZANA_VERSION; }

manzana_load_options manzana_load_defaults(void) { return {1, -1, 1, 1, 1, nullptr, nullptr}; }

manzana_model* manzana_model_load(const char* city, const manzana_load_options* options, manzana_progress progress,
                                  void* user, manzana_error* error) {
  return loaded(error, [&] { return Model::load(city, options_of(options), progress_of(progress, user)); });
}

manzana_model* manzana_model_load_bytes(const void* bytes, size_t size, const char* format, const char* name,
                                        const manzana_load_options* options, manzana_progress progress, void* user,
                                        manzana_error* error) {
  const std::span text(static_cast<const char*>(bytes), size);
  return loaded(error,
                [&] { return Model::load(text, format, name, options_of(options), progress_of(progress, user)); });
}

void manzana_model_free(manzana_model* model) { delete model; }

const char* manzana_model_credits(const manzana_model* model) { return model->model->credits().c_str(); }

void manzana_model_bounds(const manzana_model* model, double low[3], double high[3]) {
  put(model->model->scene().bounds.min, low);
  put(model->model->scene().bounds.max, high);
}

void manzana_model_local_to_ecef(const manzana_model* model, double matrix[16]) {
  const Mat4d m = model->model->local_to_ecef();
  std::copy_n(&m[0].x, 16, matrix);
}

int manzana_model_to_local(const manzana_model* model, const double geo[3], double local[3]) {
  const GeoPoint point{geo[0], geo[1], geo[2]};
  if (!valid(point)) return 0;
  put(model->model->frame().to_local(point), local);
  return 1;
}

void manzana_model_to_geo(const manzana_model* model, const double local[3], double geo[3]) {
  put(model->model->frame().to_geo(vector_of(local)), geo);
}

uint32_t manzana_model_features(const manzana_model* model) { return model->model->features(); }

int manzana_model_feature(const manzana_model* model, uint32_t id, manzana_feature* feature) {
  if (id == 0 || id > model->model->features()) return 0;
  const Feature f = model->model->feature(id);
  feature->id = f.id;
  feature->kind = f.kind;
  put(f.box.min, feature->low);
  put(f.box.max, feature->high);
  put(f.place, feature->geo);
  return 1;
}

uint32_t manzana_model_attributes(const manzana_model* model, uint32_t id) {
  return id == 0 ? 0 : static_cast<uint32_t>(model->model->scene().attributes.of(id - 1).size());
}

int manzana_model_attribute(const manzana_model* model, uint32_t id, uint32_t i, const char** name,
                            const char** value) {
  if (i >= manzana_model_attributes(model, id)) return 0;
  const auto pair = model->model->scene().attributes.of(id - 1)[i];
  *name = pair.first.data();
  *value = pair.second.data();
  return 1;
}

manzana_nodes* manzana_nodes_create(const manzana_model* model) { return new manzana_nodes{model->model->new_nodes()}; }

void manzana_nodes_free(manzana_nodes* nodes) { delete nodes; }

uint32_t manzana_nodes_add(manzana_nodes* nodes, uint32_t parent, const double placement[16], const char* name,
                           manzana_error* error) {
  return guarded(error, uint32_t{0}, [&] {
    return nodes->nodes->add(
        {.parent = parent, .placement = matrix_of(placement), .name = name != nullptr ? name : ""});
  });
}

uint32_t manzana_nodes_add_model(manzana_nodes* nodes, const char* file, uint32_t parent, const double placement[16],
                                 manzana_error* error) {
  return guarded(error, uint32_t{0}, [&] {
    return add_model(*nodes->nodes, read_model(file),
                     {.parent = parent, .placement = matrix_of(placement), .name = file});
  });
}

uint32_t manzana_nodes_copy(manzana_nodes* nodes, uint32_t id, uint32_t parent, const double placement[16],
                            manzana_error* error) {
  return guarded(error, uint32_t{0}, [&] { return add_copy(*nodes->nodes, id, parent, matrix_of(placement)); });
}

int manzana_nodes_move(manzana_nodes* nodes, uint32_t id, const double placement[16], manzana_error* error) {
  return done(error, [&] { nodes->nodes->move(id, matrix_of(placement)); });
}

int manzana_nodes_hang(manzana_nodes* nodes, uint32_t id, uint32_t parent, manzana_error* error) {
  return done(error, [&] { nodes->nodes->hang(id, parent); });
}

int manzana_nodes_show(manzana_nodes* nodes, uint32_t id, int32_t shown, manzana_error* error) {
  return done(error, [&] { nodes->nodes->show(id, shown != 0); });
}

int manzana_nodes_paint(manzana_nodes* nodes, uint32_t id, int32_t colour, manzana_error* error) {
  return done(error, [&] {
    nodes->nodes->paint(id, colour < 0 ? std::nullopt : std::optional(static_cast<std::uint32_t>(colour)));
  });
}

int manzana_nodes_remove(manzana_nodes* nodes, uint32_t id, manzana_error* error) {
  return done(error, [&] { nodes->nodes->remove(id); });
}

int manzana_nodes_node(const manzana_nodes* nodes, uint32_t id, manzana_node* node) {
  const Nodes& all = *nodes->nodes;
  if (!all.contains(id)) return 0;
  node->id = id;
  node->parent = all.node(id).parent;
  node->visible = all.visible(id) ? 1 : 0;
  put(all.box(id).min, node->low);
  put(all.box(id).max, node->high);
  return 1;
}

void manzana_model_upright(const manzana_model* model, const double local[3], double turn, double placement[16]) {
  const Mat4d m = upright(model->model->frame(), vector_of(local), glm::radians(turn));
  std::copy_n(&m[0].x, 16, placement);
}

manzana_view_options manzana_view_defaults(void) {
  const ViewOptions options;
  return {options.gpu_bytes, options.upload_bytes_a_frame, nullptr, options.linear_framebuffer ? 1 : 0};
}

manzana_view* manzana_view_create(const manzana_host* host, const manzana_view_options* given) {
  const manzana_view_options o = given != nullptr ? *given : manzana_view_defaults();
  const ViewOptions options{.gpu_bytes = o.gpu_bytes,
                            .upload_bytes_a_frame = o.upload_bytes_a_frame,
                            .quality = o.quality != nullptr ? o.quality : "",
                            .linear_framebuffer = o.linear_framebuffer != 0};
  return new manzana_view{View(host_of(host), options)};
}

void manzana_view_free(manzana_view* view) { delete view; }

void manzana_view_show(manzana_view* view, const manzana_model* model) {
  view->view.show(model != nullptr ? model->model : nullptr);
}

void manzana_view_show_nodes(manzana_view* view, const manzana_model* model, const manzana_nodes* nodes) {
  view->view.show(model != nullptr ? model->model : nullptr, nodes != nullptr ? nodes->nodes : nullptr);
}

void manzana_view_update(manzana_view* view, const manzana_camera* cameras, size_t count, double seconds,
                         manzana_update* update, manzana_seen* seen) {
  std::vector<HostCamera> eyes(count);
  std::transform(cameras, cameras + count, eyes.begin(), camera_of);
  const Update& now = view->view.update(eyes, seconds);
  if (update != nullptr)
    *update = {now.bytes_to_upload, now.far_trees_left, now.pictures_left, now.gpu_bytes, now.shown ? 1 : 0};
  for (std::size_t i = 0; seen != nullptr && i < count; ++i) {
    const Update::Seen& s = now.cameras[i];
    seen[i] = {s.blocks, s.buildings, s.surfaces, s.trees, s.cars, s.nodes};
  }
}

int manzana_view_render(manzana_view* view, size_t camera, manzana_error* error) {
  return guarded(error, 0, [&] {
    view->view.render(camera);
    return 1;
  });
}

int manzana_view_complete(const manzana_view* view) { return view->view.complete() ? 1 : 0; }

int manzana_view_pick(manzana_view* view, size_t camera, int32_t x, int32_t y, int32_t width, int32_t height,
                      uint32_t* ids, manzana_error* error) {
  return guarded(error, 0, [&] {
    if (width < 1 || height < 1) throw std::invalid_argument("a rectangle without pixels");
    const auto n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    view->view.pick(camera, {x, y, width, height}, {ids, n});
    return 1;
  });
}

int manzana_view_place(manzana_view* view, size_t camera, int32_t x, int32_t y, double local[3]) {
  const auto place = view->view.place(camera, x, y);
  if (place) put(*place, local);
  return place ? 1 : 0;
}

manzana_drawing manzana_view_drawing(const manzana_view* view) {
  const draw::DrawOptions& d = view->view.drawing();
  const auto on = [](bool value) { return value ? 1 : 0; };
  return {on(d.layers.buildings),      on(d.layers.surfaces), on(d.layers.trees),
          on(d.layers.cars),           on(d.layers.sky),      on(d.layers.fog),
          {d.sun.x, d.sun.y, d.sun.z}, d.tree_error_px,       d.wind};
}

void manzana_view_set_drawing(manzana_view* view, const manzana_drawing* drawing) {
  draw::DrawOptions& d = view->view.drawing();
  d.layers = {drawing->buildings != 0, drawing->surfaces != 0, drawing->trees != 0,
              drawing->cars != 0,      drawing->sky != 0,      drawing->fog != 0};
  d.sun = vector_of(drawing->sun);
  d.tree_error_px = drawing->tree_error_px;
  d.wind = drawing->wind;
}

int manzana_view_show_only(manzana_view* view, const char* classes, manzana_error* error) {
  return done(error, [&] { view->view.show_only(classes != nullptr ? classes_named(classes) : culling::kAllClasses); });
}

void manzana_view_colour_by(manzana_view* view, manzana_colour colour, void* user) {
  if (colour == nullptr) return view->view.colour_by({});
  view->view.colour_by([=](const Feature& feature) {
    const int32_t rgb = colour(user, feature.id);
    return rgb < 0 ? View::Colour() : View::Colour(static_cast<std::uint32_t>(rgb));
  });
}

void manzana_view_release(manzana_view* view) { view->view.release(); }

void manzana_view_context_lost(manzana_view* view) { view->view.context_lost(); }
