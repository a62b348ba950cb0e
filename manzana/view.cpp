#include "manzana/view.h"

#include <EGL/egl.h>

#include <algorithm>
#include <cassert>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include "gl/context.h"
#include "gl/state.h"
#include "manzana/resident.h"

namespace manzana {
namespace {

using culling::ClipDepth;
using RendererPtr = std::unique_ptr<draw::Renderer>;

/// What a host asks for.
struct Shown {
  std::shared_ptr<const Model> model;
  std::shared_ptr<const Nodes> nodes;
};

void load_functions_once(const Host& host) {
  static std::once_flag once;
  std::call_once(
      once, [&] { gl::load_functions(host.get_proc_address != nullptr ? host.get_proc_address : &eglGetProcAddress); });
}

/// The host's depth of our own: both are linear in 1 / distance, or, without an apex, in the distance.
void set_depth(draw::Overlay& overlay, const HostCamera& host, const draw::Camera& camera) {
  overlay.nearer_is_less = host.depth != ClipDepth::reversed;
  if (camera.orthographic) {
    overlay.depth_scale = overlay.nearer_is_less ? -1 : 1;
    overlay.depth_offset = overlay.nearer_is_less ? 1 : 0;
    return;
  }
  const double at_infinity = host.projection[2][2] / host.projection[2][3];
  const glm::dvec4 w = glm::transpose(host.projection * host.view)[3];
  const double growth = host.projection[3][2] / (camera.view_projection[3][2] * glm::length(Vec3d(w)));
  const bool halved = host.depth == ClipDepth::minus_one_to_one;
  overlay.depth_scale = halved ? growth / 2 : growth;
  overlay.depth_offset = halved ? (at_infinity + 1) / 2 : at_infinity;
}

constexpr std::uint64_t kFarTreeBytesAFrame = 1 << 20;

draw::DrawOptions over_a_host() {
  draw::DrawOptions options;
  options.layers.sky = options.layers.fog = false;
  options.transparent = true;
  return options;
}

}  // namespace

struct View::State {
  Host host;
  ViewOptions options;
  draw::DrawOptions drawing = over_a_host();
  std::mutex mutex;  ///< of the two below
  bool asked = false;
  Shown wanted;

  Resident shown, coming;
  std::function<View::Colour(const Feature&)> colour;
  culling::ClassMask classes = culling::kAllClasses;
  bool recolour = false;          ///< `colour` is not yet that of what is shown
  std::vector<RendererPtr> gone;  ///< to be freed with the context current
  Update update;

  void log(const std::string& line) const {
    if (host.log) host.log(line);
  }
  void repaint() const {
    if (host.request_repaint) host.request_repaint();
  }
  void drop(Resident& resident) {
    if (resident.renderer) gone.push_back(std::move(resident.renderer));
    resident = {};
  }
  void take_wanted();
  RendererPtr make_renderer(const Model& model) const;
  Sight sight() const { return {classes, drawing.layers.buildings, drawing.seconds}; }
  Eye* eye_at(std::size_t i);
  void bring_made();
  void bring();
  void bring(std::size_t most);
  void begin();
  void paint();
  void swap_in();
  void account();
  void forget() noexcept;
};

/// What show() left, from whichever thread.
void View::State::take_wanted() {
  const std::scoped_lock lock(mutex);
  if (!asked) return;
  asked = false;
  drop(coming);
  if (!wanted.model) drop(shown);
  if (wanted.model && wanted.model == shown.model && shown.renderer) {  // it is there already
    shown.nodes = std::move(wanted.nodes);
    wanted = {};
    return;
  }
  coming.model = std::move(wanted.model);
  coming.nodes = std::move(wanted.nodes);
}

RendererPtr View::State::make_renderer(const Model& model) const {
  const draw::Quality quality =
      options.quality.empty() ? draw::quality_for(gl::renderer_name()) : draw::quality_named(options.quality);
  return std::make_unique<draw::Renderer>(model.scene(), model.plants(), quality, options.gpu_bytes);
}

/// One frame's share of the upload of what its cameras will see.
void View::State::bring() {
  if (!coming.model) return;
  repaint();
  if (!coming.renderer) return begin();
  bring(options.upload_bytes_a_frame);
}

/// At most so many bytes; 0: only says how many are left, without GL.
void View::State::bring(std::size_t most) {
  coming.left = 0;
  for (const Eye& eye : coming.eyes) {
    const std::size_t before = coming.renderer->memory().meshes_held;
    coming.left += coming.renderer->bring(coming.model->scene(), *eye.sets, most);
    most -= std::min(most, coming.renderer->memory().meshes_held - before);
  }
}

/// Programs and plants.
void View::State::begin() {
  const std::shared_ptr<const Model> model = std::exchange(coming.model, nullptr);  // gone, should that throw
  coming.renderer = make_renderer(*model);
  coming.model = model;
  const draw::DeviceMemory memory = coming.renderer->memory();
  const std::uint64_t least = memory.sum() - memory.meshes;
  if (options.gpu_bytes == 0 || least <= options.gpu_bytes) return;
  log("the city needs " + std::to_string(least) + " bytes of the device for plants alone; " +
      std::to_string(options.gpu_bytes) + " are allowed");
  drop(coming);
}

void View::State::swap_in() {
  if (!coming.renderer || coming.eyes.empty() || coming.left > 0) return;
  drop(shown);
  shown = std::move(coming);
  coming = {};
  shown.shown = true;
  if (!shown.far) shown.far = make_far_trees(shown, host);
  if (!shown.pictures) shown.pictures = make_pictures(shown, host);
  recolour = colour != nullptr;
}

/// What has been made since the last picture, so much in one.
void View::State::bring_made() {
  shown.far->give(*shown.renderer, std::min<std::uint64_t>(options.upload_bytes_a_frame, kFarTreeBytesAFrame));
  shown.pictures->give(*shown.renderer, options.upload_bytes_a_frame);
  if (shown.far->ready() || shown.pictures->ready()) repaint();
}

void View::State::paint() {
  if (!recolour) return;
  recolour = false;
  const LayerTable& table = shown.model->scene().buildings.table;
  std::vector<std::uint32_t> colours(table.size(), draw::kOwnColour);
  for (FeatureId id = 1; colour && id <= shown.model->features(); ++id) {
    const std::uint32_t row = table.row_first[id - 1];
    if (row < table.row_first[id]) colours[row] = colour(shown.model->feature(id)).value_or(draw::kOwnColour);
  }
  shown.renderer->paint_buildings(shown.model->scene(), colours);
}

/// Of what is shown; as it is drawn now, were a layer switched since the update.
Eye* View::State::eye_at(std::size_t i) {
  if (!shown.renderer || i >= shown.eyes.size()) return nullptr;
  Eye& eye = shown.eyes[i];
  if (eye.hides != hides(eye, sight())) see(shown, eye, HostCamera(eye.host), sight());
  return &eye;
}

void View::State::account() {
  update.shown = shown.renderer != nullptr;
  update.bytes_to_upload = coming.renderer ? coming.left : shown.left;
  update.far_trees_left = shown.far ? shown.far->left() : 0;
  update.pictures_left = shown.pictures ? shown.pictures->left() : 0;
  update.gpu_bytes = 0;
  for (const Resident* resident : {&shown, &coming})
    if (resident->renderer) update.gpu_bytes += resident->renderer->memory().sum();
}

void View::State::forget() noexcept {
  gone.clear();
  if (shown.far) shown.far->keep(*shown.renderer);
  shown.renderer.reset();
  coming.renderer.reset();
  if (!coming.model) std::swap(coming, shown);  // it comes back when it is drawn again
  if (coming.far) coming.far->drop();
  if (coming.pictures) coming.pictures->drop();
  coming.shown = false;
  coming.left = 0;
  coming.eyes.clear();
  shown = {};
  account();
}

View::View(Host host, const ViewOptions& options) : state_(std::make_unique<State>()) {
  state_->host = std::move(host);
  state_->options = options;
}

View::~View() {
  State& s = *state_;
  if (!s.shown.renderer && !s.coming.renderer && s.gone.empty()) return;
  s.log("a view was not released: what it held of the device stays there until its context goes");
  context_lost();
}

void View::show(std::shared_ptr<const Model> model, std::shared_ptr<const Nodes> nodes) {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->wanted = {std::move(model), std::move(nodes)};
    state_->asked = true;
  }
  state_->repaint();
}

const Update& View::update(std::span<const HostCamera> cameras, double seconds) {
  State& s = *state_;
  s.take_wanted();
  s.swap_in();
  s.drawing.seconds = seconds;
  s.update.cameras.assign(cameras.size(), {});
  if (s.shown.model) {
    see(s.shown, cameras, s.sight());
    for (std::size_t i = 0; i < cameras.size(); ++i) s.update.cameras[i] = count_seen(s.shown, s.shown.eyes[i]);
  }
  if (s.coming.renderer) {
    see(s.coming, cameras, s.sight());
    s.bring(0);
  }
  s.account();
  return s.update;
}

void View::render(std::size_t i) {
  State& s = *state_;
  load_functions_once(s.host);
  const gl::SavedState saved;
  gl::set_clean_state();
  s.gone.clear();
  s.bring();
  const Eye* const eye = s.eye_at(i);
  if (eye == nullptr) return;
  s.paint();
  s.bring_made();
  draw::Renderer& renderer = *s.shown.renderer;
  const draw::PixelRect& viewport = eye->host.viewport;
  renderer.resize({viewport.width, viewport.height}, i);
  const std::size_t nodes_left = renderer.bring(eye->nodes, s.options.upload_bytes_a_frame);
  draw::DrawOptions drawing = s.drawing;
  drawing.upload_bytes = s.options.upload_bytes_a_frame;
  s.shown.left =
      nodes_left + renderer.draw(s.shown.model->scene(), *eye->sets, eye->camera, drawing, eye->nodes).bytes_to_bring;
  if (s.shown.left > 0) s.repaint();
  s.shown.far->want(renderer);
  s.shown.pictures->want(renderer);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, saved.framebuffer());
  draw::Overlay overlay{.viewport = viewport, .linear = s.options.linear_framebuffer};
  set_depth(overlay, eye->host, eye->camera);
  renderer.overlay(overlay);
}

bool View::complete() const {
  State& s = *state_;
  const std::scoped_lock lock(s.mutex);
  return !s.asked && !s.coming.model && s.shown.renderer &&
         s.shown.left + s.shown.far->left() + s.shown.pictures->left() == 0;
}

void View::pick(std::size_t i, const draw::PixelRect& rect, std::span<FeatureId> ids) {
  State& s = *state_;
  assert(ids.size() == static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height));
  std::fill(ids.begin(), ids.end(), 0);
  const Eye* const eye = s.eye_at(i);
  if (eye == nullptr) return;
  const gl::SavedState saved;
  gl::set_clean_state();
  s.shown.renderer->resize({eye->host.viewport.width, eye->host.viewport.height}, i);
  const auto seen = s.shown.renderer->pick(s.shown.model->scene(), *eye->sets, eye->camera, rect, eye->nodes);
  std::copy(seen.begin(), seen.end(), ids.begin());
}

std::optional<Vec3d> View::place(std::size_t i, int x, int y) {
  State& s = *state_;
  if (!s.shown.renderer || i >= s.shown.eyes.size()) return {};
  const Eye& eye = s.shown.eyes[i];
  const draw::PixelRect& v = eye.host.viewport;
  const double depth = s.shown.renderer->depth_at(i, x, y);
  if (depth <= 0) return {};
  const Vec2d at = 2.0 * Vec2d((x + 0.5) / v.width, (y + 0.5) / v.height) - 1.0;
  const glm::dvec4 rel = glm::inverse(eye.camera.view_projection) * glm::dvec4(at, depth, 1);
  return eye.camera.eye + Vec3d(rel) / rel.w;
}

void View::show_only(culling::ClassMask classes) { state_->classes = classes; }

void View::colour_by(std::function<Colour(const Feature&)> colour) {
  state_->colour = std::move(colour);
  state_->recolour = true;
}

draw::DrawOptions& View::drawing() { return state_->drawing; }
const draw::DrawOptions& View::drawing() const { return state_->drawing; }

void View::release() noexcept { state_->forget(); }

void View::context_lost() noexcept {
  const gl::LostContext lost;
  state_->forget();
}

}  // namespace manzana
