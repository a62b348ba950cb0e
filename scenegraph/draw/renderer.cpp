#include "scenegraph/draw/renderer.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "gl/framebuffer.h"
#include "manzana_draw_shaders.h"
#include "scenegraph/draw/car_layer.h"
#include "scenegraph/draw/city_meshes.h"
#include "scenegraph/draw/compositor.h"
#include "scenegraph/draw/debug_volumes.h"
#include "scenegraph/draw/frame_data.h"
#include "scenegraph/draw/node_layer.h"
#include "scenegraph/draw/photo_layer.h"
#include "scenegraph/draw/pick.h"
#include "scenegraph/draw/picture_pages.h"
#include "scenegraph/draw/shadows.h"
#include "scenegraph/draw/sky.h"
#include "scenegraph/draw/tree_layer.h"

namespace manzana::draw {
namespace {

constexpr GLuint kFrameBinding = 0, kPhotoBinding = 1;  // of uniforms
constexpr GLuint kBlocksBinding = 1;
constexpr std::size_t kPhotoShare = 8;  // of the device's bytes, for each screen; of pictures likewise

void set_depth_and_colour(const Camera& camera) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glEnable(GL_FRAMEBUFFER_SRGB);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glCullFace(GL_BACK);
  glFrontFace(camera.mirrored ? GL_CW : GL_CCW);
}

void clear(const gl::Target& target, const Vec4& colour) {
  const float zero = 0;
  glClearNamedFramebufferfv(target.framebuffer.name(), GL_COLOR, 0, &colour.x);
  glClearNamedFramebufferfv(target.framebuffer.name(), GL_DEPTH, 0, &zero);
}

void add(FrameCounts& counts, const Drawn& drawn) {
  counts.triangles += drawn.triangles;
  counts.commands += drawn.commands;
}

}  // namespace

struct Renderer::State {
  State(const Scene& scene, std::span<const foliage::PreparedPlant> plants, const Quality& asked, std::size_t most)
      : gpu_bytes(most),
        quality(asked),
        anchor(scene.blocks.empty() ? BlockFrame{} : scene.blocks.front()),
        rows(scene.blocks.size()),
        meshes(scene),
        paints(make_paint_programs(!scene.photo.empty(), !scene.pictures.textures.empty())),
        fading(meshes.buildings.has_levels() ? make_fading_programs(!scene.pictures.textures.empty())
                                             : PaintPrograms{}),
        pictures(scene.pictures, most > 0 ? most / kPhotoShare : PicturePages::kMostBytes),
        trees(scene, plants, limits_for(scene, plants, asked.tree_law == foliage::Law::full)),
        cars(scene.traffic.cars()),
        car_shadows(make_shadow("shadow_car", shaders::shadow_car_vert)),
        sky(!scene.photo.empty()) {}

  std::size_t bytes_of_frame(const VisibleSets& sets) const;
  void draw_host_nodes(std::span<const SeenNode> seen, const Vec3d& eye, FrameCounts& counts);
  void upload_frame(const VisibleSets& sets, const FrameData& frame);
  std::size_t bring_photo(const Scene& scene, const Camera& camera, std::size_t most_bytes);
  void upload_photo(const GroundPhoto& photo, const Vec3d& eye);
  void bind_photo() const;
  void draw_layers(const Scene& scene, const VisibleSets& sets, const Camera& camera, const DrawOptions& options,
                   std::span<const SeenNode> nodes, FrameCounts& counts);

  const gl::Target& target() const { return targets[screen]; }

  std::size_t gpu_bytes;  ///< at most; 0: no limit
  Quality quality;
  BlockFrame anchor;
  std::vector<Rows> rows;  ///< of visible blocks
  CityMeshes meshes;
  MeshDetail mesh_detail;  ///< of the last picture
  PaintPrograms paints, fading;
  PicturePages pictures;
  TreeLayerGpu trees;
  CarLayerGpu cars;
  gl::Program car_shadows;
  NodeLayerGpu nodes;
  std::optional<gl::Program> node_program;  ///< from the first node on
  Sky sky;
  std::vector<std::optional<PhotoLayerGpu>> photos;  ///< of each screen
  DebugVolumes volumes;
  gl::StreamBuffer stream;
  std::vector<gl::Target> targets;
  std::size_t screen = 0;
  Compositor compositor;
  TreeBytes tree_bytes;                ///< of the trees' buffers and pictures, which stay as large as they are
  std::optional<PickPrograms> picker;  ///< from the first time on that somebody picks
};

std::size_t Renderer::State::bytes_of_frame(const VisibleSets& sets) const {
  using gl::StreamBuffer;
  return StreamBuffer::padded(sizeof(FrameData)) + StreamBuffer::padded(sizeof(glsl::PhotoData)) +
         StreamBuffer::padded((rows.size() + 1) * sizeof(Rows)) +
         stream_bytes(meshes.buildings, sets.objects().size()) + stream_bytes(meshes.surfaces, sets.objects().size()) +
         stream_bytes(trees) + stream_bytes(cars.meshes, most_instances(sets.cars.size()));
}

void Renderer::State::upload_frame(const VisibleSets& sets, const FrameData& frame) {
  const auto uniforms = stream.take<FrameData>(1);
  *uniforms.items = frame;
  const auto blocks = stream.take<Rows>(rows.size() + 1);
  for (const culling::LeafRun& run : sets.blocks()) {
    std::copy(rows.begin() + run.first, rows.begin() + run.last, blocks.items + run.first);
  }
  glBindBufferRange(GL_UNIFORM_BUFFER, kFrameBinding, stream.name(), uniforms.offset, sizeof(FrameData));
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, kBlocksBinding, stream.name(), blocks.offset,
                    static_cast<GLsizeiptr>((rows.size() + 1) * sizeof(Rows)));
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, stream.name());
}

/// About where this camera looks; a screen has its own.
std::size_t Renderer::State::bring_photo(const Scene& scene, const Camera& camera, std::size_t most_bytes) {
  if (scene.photo.empty()) return 0;
  if (photos.size() <= screen) photos.resize(screen + 1);
  const PhotoPlan plan = plan_photo(scene.photo, focal_px(camera, target().height), gpu_bytes / kPhotoShare);
  std::optional<PhotoLayerGpu>& layer = photos[screen];
  if (!layer || layer->plan() != plan) layer.emplace(scene.photo, plan);
  return layer->bring(scene.photo, camera, scene.frame.ground_z(Vec2d(camera.eye)), most_bytes);
}

void Renderer::State::upload_photo(const GroundPhoto& photo, const Vec3d& eye) {
  if (photo.empty()) return;
  const auto uniforms = stream.take<glsl::PhotoData>(1);
  *uniforms.items = photos[screen]->data(photo, eye);
  glBindBufferRange(GL_UNIFORM_BUFFER, kPhotoBinding, stream.name(), uniforms.offset, sizeof(glsl::PhotoData));
}

/// Trees have their own pictures in the same places.
void Renderer::State::bind_photo() const {
  if (!photos.empty()) photos[screen]->bind();
}

void Renderer::State::draw_host_nodes(std::span<const SeenNode> seen, const Vec3d& eye, FrameCounts& counts) {
  counts.nodes = seen.size();
  if (seen.empty()) return;
  if (!node_program) node_program = make_node_program();
  glUseProgram(node_program->name());
  add(counts, draw_nodes(nodes, seen, eye, NodeExtra::paint, stream));
}

// What stands high hides what lies flat, and the sky shades only what is left.
void Renderer::State::draw_layers(const Scene& scene, const VisibleSets& sets, const Camera& camera,
                                  const DrawOptions& options, std::span<const SeenNode> seen, FrameCounts& counts) {
  const Layers& layers = options.layers;
  const foliage::Wind wind{Vec3(0.8, 0.6, 0) * static_cast<float>(options.wind), static_cast<float>(options.seconds)};
  glEnable(GL_CULL_FACE);
  if (layers.buildings) {
    counts.buildings = count(scene.buildings.table, sets.objects());
    pictures.bind();
    add(counts, draw_city(meshes, scene.buildings.table, meshes.buildings, paints, fading, sets.objects(), stream));
  }
  if (layers.cars) {
    counts.cars = sets.cars.size();
    add(counts, draw_cars(cars, scene, sets.cars, camera.eye, stream));
  }
  glDisable(GL_CULL_FACE);
  draw_host_nodes(seen, camera.eye, counts);
  if (layers.trees) {
    counts.trees = count(scene.trees.table, sets.objects());
    add(counts, draw_trees(trees, {static_cast<float>(focal_px(camera, target().height)), target().samples, wind}));
    counts.points = trees.grove_points;
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, stream.name());
  }
  bind_photo();
  if (layers.surfaces) {
    counts.surfaces = count(scene.surfaces.table, sets.objects());
    add(counts, draw_city(meshes, scene.surfaces.table, meshes.surfaces, paints, fading, sets.objects(), stream));
  }
  if (layers.surfaces) {
    if (layers.trees) add(counts, draw_tree_shadows(trees));
    glBindVertexArray(cars.meshes.array.name());
    if (layers.cars) add(counts, draw_shadows(car_shadows, cars.selection.bins.total()));
  }
  bind_photo();
  if (layers.sky)
    draw_sky(sky);
  else if (layers.surfaces)
    draw_bare_photo(sky);
}

Renderer::Renderer(const Scene& scene, std::span<const foliage::PreparedPlant> plants, const Quality& quality,
                   std::size_t gpu_bytes)
    : state_(std::make_unique<State>(scene, plants, quality, gpu_bytes)) {
  state_->tree_bytes = device_bytes_of(state_->trees);
  if (gpu_bytes > 0) state_->trees.groves.most_bytes = std::min(Groves::kMostBytes, gpu_bytes / 8);
  resize({1, 1});
}

std::size_t Renderer::bring(const Scene& scene, const VisibleSets& sets, std::size_t most_bytes) {
  if (state_->gpu_bytes > 0) {
    const DeviceMemory now = memory();
    const std::size_t others = now.sum() - now.meshes;
    state_->meshes.limit(state_->gpu_bytes > others ? state_->gpu_bytes - others : 1);
  }
  return state_->meshes.bring(scene, sets.to_bring(), state_->mesh_detail, most_bytes);
}

bool Renderer::holds_building(std::uint32_t row) const {
  const LayerPieces& buildings = state_->meshes.buildings;
  return buildings.held[buildings.shown[buildings.piece_of[row]].item].has_value();
}

DeviceMemory Renderer::memory() const {
  const State& s = *state_;
  DeviceMemory memory{.meshes = s.meshes.device_bytes(),
                      .meshes_held = s.meshes.held_bytes(),
                      .meshes_seen = s.meshes.seen_bytes(),
                      .meshes_all = s.meshes.all_bytes(),
                      .meshes_missing = s.meshes.missing_bytes(),
                      .plants = s.tree_bytes.plants,
                      .lists = s.tree_bytes.lists,
                      .packs = bytes_of_packs(s.trees.far),
                      .groves = s.trees.groves.drawer->bytes(),
                      .textures = s.pictures.device_bytes(),
                      .nodes = s.nodes.device_bytes(),
                      .stream = s.stream.bytes()};
  for (const auto& photo : s.photos)
    if (photo) memory.photo += photo->device_bytes();
  for (const gl::Target& t : s.targets)
    memory.pictures += static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height) * 8 *
                       static_cast<std::size_t>(t.samples > 1 ? t.samples + 1 : 1);
  return memory;
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::resize(Size size, std::size_t screen) {
  State& s = *state_;
  size = {std::max(1, size.width), std::max(1, size.height)};
  if (s.targets.size() <= screen) s.targets.resize(screen + 1);
  gl::Target& target = s.targets[screen];
  if (target.width != size.width || target.height != size.height)
    target = gl::make_target(size.width, size.height, s.quality.samples);
  s.screen = screen;
}

FrameCounts Renderer::draw(const Scene& scene, const VisibleSets& sets, const Camera& camera,
                           const DrawOptions& options, std::span<const SeenNode> nodes) {
  State& s = *state_;
  assert(scene.blocks.size() == s.rows.size());
  const FrameData frame = make_frame(scene.frame, camera, options, s.anchor);
  const double f_px = focal_px(camera, s.target().height);
  for (const culling::LeafRun& run : sets.blocks()) {
    for (std::uint32_t b = run.first; b < run.last; ++b) s.rows[b] = relative_to(camera.eye, scene.blocks[b]);
  }
  const double error_px = options.tree_error_px > 0 ? options.tree_error_px : s.quality.tree_error_px;
  count_cars(sets.cars, camera.eye, f_px / error_px, s.cars.selection);

  const foliage::Law law = options.tree_law.value_or(s.quality.tree_law);
  const bool full = law == foliage::Law::full;
  s.mesh_detail = {camera.eye, full ? 0 : error_px / f_px, full ? 0 : 1 / f_px};

  FrameCounts counts;
  const std::size_t held = s.meshes.held_bytes();
  counts.bytes_to_bring = bring(scene, sets, options.upload_bytes);
  const std::size_t brought = s.meshes.held_bytes() - std::min(held, s.meshes.held_bytes());
  counts.bytes_to_bring += s.bring_photo(scene, camera, options.upload_bytes - std::min(options.upload_bytes, brought));
  counts.bytes_without_room = s.meshes.missing_bytes();
  s.pictures.begin();
  see(s.pictures, scene, s.meshes.buildings, s.mesh_detail);
  s.pictures.end();
  s.stream.begin(s.bytes_of_frame(sets) + stream_bytes(nodes));
  gl::bind(s.target());
  set_depth_and_colour(camera);
  clear(s.target(), options.transparent ? Vec4(0) : frame.horizon);
  s.upload_frame(sets, frame);
  s.upload_photo(scene.photo, camera.eye);
  if (options.layers.trees) {
    constexpr double kSmallestShadow = 0.0035;  // of half the picture's height: shadow_tree.vert
    const bool mosaics = options.mosaics && law == foliage::Law::ours;
    const TreeDetail detail{.law = law,
                            .error_at_1m = error_px / f_px,
                            .vertices = options.tree_vertices,
                            .mosaics = mosaics,
                            .groves = mosaics && options.groves && (sets.classes & kTrees) == kTrees,
                            .shadow_at_1m = kSmallestShadow * glm::length(camera.ray_up),
                            .sides = foliage::sides_of(camera.frustum, camera.eye),
                            .by_node = options.trees_by_node};
    extract_trees(s.trees, scene.trees, sets.objects(), s.rows, detail, s.stream);
    counts.tree_error_px = s.trees.law == foliage::Law::full ? 0 : s.trees.error_at_1m * f_px;
    counts.tree_law = s.trees.law;
  }
  s.draw_layers(scene, sets, camera, options, nodes, counts);
  if (options.frozen != nullptr) draw_lines(s.volumes, volume_lines(scene.tree, *options.frozen, camera.eye));
  gl::resolve(s.target());
  s.stream.end();
  return counts;
}

std::span<const std::uint32_t> Renderer::packs_wanted() const { return state_->trees.far.wanted; }

bool Renderer::add_pack(std::uint32_t plant, foliage::LdmPack pack) {
  return draw::add_pack(state_->trees.far, plant, std::move(pack));
}

std::map<std::uint32_t, foliage::LdmPack> Renderer::take_packs() {
  FarTrees& far = state_->trees.far;
  std::map<std::uint32_t, foliage::LdmPack> packs;
  for (std::uint32_t plant = 0; plant < far.pack_of.size(); ++plant)
    if (far.pack_of[plant] != FarTrees::kNone) packs.emplace(plant, std::move(far.packs[far.pack_of[plant]].pack));
  return packs;
}

std::span<const GroveWanted> Renderer::groves_wanted() const { return state_->trees.groves.wanted; }

std::shared_ptr<const std::vector<foliage::TreeSite>> Renderer::sites() const { return state_->trees.sites; }

bool Renderer::add_grove(const GroveWanted& wanted, const foliage::Grove& grove) {
  return draw::add_grove(state_->trees.groves, wanted, grove);
}

std::span<const PictureWanted> Renderer::pictures_wanted() const { return state_->pictures.wanted(); }

bool Renderer::add_picture(const PictureWanted& wanted, const PictureSquare& square) {
  return state_->pictures.add(wanted, square);
}

foliage::Shown Renderer::trees_shown() const { return newest_shown(state_->trees); }

void Renderer::present(unsigned framebuffer) {
  const gl::Target& target = state_->target();
  glDisable(GL_FRAMEBUFFER_SRGB);  // the bytes as they are
  glBlitNamedFramebuffer(target.picture().name(), framebuffer, 0, 0, target.width, target.height, 0, 0, target.width,
                         target.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Renderer::overlay(const Overlay& how) {
  gl::resolve_depth(state_->target());
  draw_overlay(state_->compositor, state_->target(), how);
}

double Renderer::depth_at(std::size_t screen, int x, int y) const {
  if (screen >= state_->targets.size()) return 0;
  const gl::Target& target = state_->targets[screen];
  float depth = 0;
  if (x >= 0 && y >= 0 && x < target.width && y < target.height)
    glGetTextureSubImage(target.depth.name(), 0, x, y, 0, 1, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof depth, &depth);
  return static_cast<double>(depth);
}

std::vector<std::uint32_t> Renderer::pick(const Scene& scene, const VisibleSets& sets, const Camera& camera,
                                          const PixelRect& rect, std::span<const SeenNode> nodes) {
  State& s = *state_;
  if (!s.picker) s.picker.emplace();
  return pick_objects(*s.picker, {scene, sets, s.meshes, s.nodes, nodes}, camera, {s.target().width, s.target().height},
                      rect);
}

void Renderer::paint_buildings(const Scene& scene, std::span<const std::uint32_t> colours) {
  state_->meshes.paint(scene.buildings, state_->meshes.buildings, colours);
}

std::size_t Renderer::bring(std::span<const SeenNode> nodes, std::size_t most_bytes) {
  return state_->nodes.bring(nodes, most_bytes);
}

std::vector<unsigned char> Renderer::read_pixels() {
  const gl::Target& target = state_->target();
  const std::size_t row = 3 * static_cast<std::size_t>(target.width);
  std::vector<unsigned char> pixels(row * static_cast<std::size_t>(target.height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target.picture().name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glReadPixels(0, 0, target.width, target.height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  for (auto top = pixels.begin(), bottom = pixels.end(); top + static_cast<std::ptrdiff_t>(row) < bottom;) {
    bottom -= static_cast<std::ptrdiff_t>(row);
    std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(row), bottom);
    top += static_cast<std::ptrdiff_t>(row);
  }
  return pixels;
}

}  // namespace manzana::draw
