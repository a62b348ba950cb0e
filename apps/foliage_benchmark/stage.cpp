#include "apps/foliage_benchmark/stage.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "foliage_benchmark_parts_shaders.h"
#include "scenegraph/draw/frame_data.h"
#include "scenegraph/draw/tree_layer.h"

namespace manzana::foliage_benchmark {
namespace {

// A reference has at least 4 x 4 samples a pixel, and so many that the plant is this high: where leaf cards are smaller
// than a few samples, the alpha test drops them, and four samples a pixel show half of a far crown.
constexpr double kFineHeightPx = 768;
constexpr double kFocalPx = 935;  // 1080 rows, 60 degrees
constexpr int kMarginPx = 8;
constexpr std::size_t kMostRooms = 3;

std::vector<foliage::PreparedPlant> without_pictures(std::span<const foliage::PreparedPlant> plants) {
  std::vector<foliage::PreparedPlant> all(plants.begin(), plants.end());
  for (foliage::PreparedPlant& plant : all) plant.leaf_image = plant.bark_image = {};
  return all;
}

gl::Renderbuffer make_renderbuffer(GLenum format, int width, int height, int samples) {
  GLuint name = 0;
  glCreateRenderbuffers(1, &name);
  gl::Renderbuffer buffer(name);
  glNamedRenderbufferStorageMultisample(name, samples > 1 ? samples : 0, format, width, height);
  return buffer;
}

gl::Framebuffer make_framebuffer(const gl::Renderbuffer& colour, const gl::Renderbuffer& mask, GLuint depth) {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  gl::Framebuffer framebuffer(name);
  constexpr std::array<GLenum, 2> kBoth{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glNamedFramebufferRenderbuffer(name, kBoth[0], GL_RENDERBUFFER, colour.name());
  glNamedFramebufferRenderbuffer(name, kBoth[1], GL_RENDERBUFFER, mask.name());
  if (depth != 0) glNamedFramebufferRenderbuffer(name, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
  glNamedFramebufferDrawBuffers(name, 2, kBoth.data());
  if (glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("the device cannot draw colour and mask of that size");
  return framebuffer;
}

template <class T>
void upload(const gl::Buffer& buffer, const T& value) {
  glNamedBufferSubData(buffer.name(), 0, sizeof value, &value);
}

void read_bytes(const gl::Framebuffer& from, GLenum attachment, GLenum format, int width, int height,
                std::vector<unsigned char>& bytes) {
  const std::size_t channels = format == GL_RGBA ? 4 : 1;
  bytes.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels);
  glNamedFramebufferReadBuffer(from.name(), attachment);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
  glReadPixels(0, 0, width, height, format, GL_UNSIGNED_BYTE, bytes.data());
}

std::array<float, 256> decoding() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = from_srgb(static_cast<float>(i) / 255);
  return table;
}

}  // namespace

foliage::HostShaders shaders_with_mask() {
  foliage::HostShaders host = draw::plant_shaders();
  for (gl::Pieces* pieces : {&host.quads, &host.lines, &host.points, &host.mosaics}) {
    pieces->insert(pieces->end() - 1, shaders::mask_begin_glsl);
    pieces->push_back(shaders::mask_end_glsl);
  }
  return host;
}

Extent extent_of(const foliage::PreparedPlant& plant) {
  Extent extent;
  extent.nominal_height = static_cast<double>(plant.height_m);
  for (const auto* quads : {&plant.bark, &plant.leaves}) {
    for (const foliage::PlantQuad& quad : *quads) {
      for (const auto& corner : quad.corners) {
        const Vec3d p(corner.position);
        extent.low = std::min(extent.low, p.z);
        extent.high = std::max(extent.high, p.z);
        extent.radius = std::max(extent.radius, std::hypot(p.x, p.y));
      }
    }
  }
  return extent;
}

Shot shot_of(const Extent& extent, double azimuth, double elevation, double height_px) {
  Shot shot;
  shot.focal_px = kFocalPx;
  const double distance = kFocalPx * extent.nominal_height / height_px, middle = (extent.low + extent.high) / 2;
  const Vec3d back(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                   std::sin(elevation));
  shot.view = culling::look(Vec3d(0, 0, middle) + distance * back, -back, {0, 0, 1}, 1, 1);
  // Of the ball round the cylinder: all there is of it, whatever the perspective.
  const double half_height = (extent.high - extent.low) / 2;
  const double tall = half_height * std::cos(elevation) + extent.radius * std::sin(elevation);
  const double nearest =
      std::max(0.1 * distance, distance - extent.radius * std::cos(elevation) - half_height * std::sin(elevation));
  const auto side = [&](double half) {
    return 2 * (static_cast<int>(std::ceil(kFocalPx * half / nearest)) + kMarginPx);
  };
  shot.width = side(extent.radius);
  shot.height = side(tall);
  shot.view.tan_right = shot.width / (2 * kFocalPx);
  shot.view.tan_left = -shot.view.tan_right;
  shot.view.tan_top = shot.height / (2 * kFocalPx);
  shot.view.tan_bottom = -shot.view.tan_top;
  shot.view.near_m = 0.05 * distance;
  shot.fine = fine_samples(height_px, shot.width);
  return shot;
}

int fine_samples(double height_px, int width) {
  constexpr int kWidest = 8192;
  int fine = 4;
  while (fine * height_px < kFineHeightPx && fine < 64 && 2 * fine * width <= kWidest) fine *= 2;
  return fine;
}

Shot moved(const Shot& shot, double right_px) {
  Shot other = shot;
  other.view.tan_left -= right_px / shot.focal_px;
  other.view.tan_right -= right_px / shot.focal_px;
  return other;
}

Shot window_of(const Shot& shot, int left, int low, int width, int height) {
  Shot part = shot;
  part.width = width;
  part.height = height;
  part.view.tan_left = shot.view.tan_left + left / shot.focal_px;
  part.view.tan_right = part.view.tan_left + width / shot.focal_px;
  part.view.tan_bottom = shot.view.tan_bottom + low / shot.focal_px;
  part.view.tan_top = part.view.tan_bottom + height / shot.focal_px;
  return part;
}

std::array<Vec4, 3> rows_seen_from(const Vec3d& eye) { return draw::relative_to(eye, BlockFrame{}); }

std::vector<Vec4> Stage::rows_seen_from(const Vec3d& eye) const {
  const auto rows = foliage_benchmark::rows_seen_from(eye);
  std::vector<Vec4> all;
  for (std::size_t block = 0; block < blocks_; ++block) all.insert(all.end(), rows.begin(), rows.end());
  return all;
}

Stage::Stage(std::span<const foliage::PreparedPlant> plants, std::span<const foliage::TreeSite> sites,
             const foliage::ExtractLimits& limits)
    : plants_(without_pictures(plants)),
      sites_(sites.begin(), sites.end()),
      store_(plants),
      extractor_(sites, limits),
      programs_(shaders_with_mask()),
      frame_(gl::make_buffer(sizeof(draw::FrameData))),
      trees_(gl::make_buffer(sites.size() * sizeof(std::uint32_t))) {
  for (const foliage::TreeSite& site : sites) blocks_ = std::max<std::size_t>(blocks_, site.block + 1);
  rows_ = gl::make_buffer(blocks_ * sizeof(draw::Rows));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
}

void Stage::set_law(foliage::Law law) {
  if (law_ != law) foliage::set_details(store_, make_details(plants_, law));
  law_ = law;
}

void Stage::set_details(std::vector<foliage::Detail> details) {
  foliage::set_details(store_, std::move(details));
  law_.reset();
}

Stage::Room Stage::make_room(int width, int height, int samples) {
  Room room;
  room.width = width;
  room.height = height;
  room.samples = samples;
  room.colour = make_renderbuffer(GL_SRGB8_ALPHA8, width, height, samples);
  room.mask = make_renderbuffer(GL_R8, width, height, samples);
  room.depth = make_renderbuffer(GL_DEPTH_COMPONENT32F, width, height, samples);
  room.drawn = make_framebuffer(room.colour, room.mask, room.depth.name());
  if (samples == 1) return room;
  room.flat_colour = make_renderbuffer(GL_SRGB8_ALPHA8, width, height, 1);
  room.flat_mask = make_renderbuffer(GL_R8, width, height, 1);
  room.flat = make_framebuffer(room.flat_colour, room.flat_mask, 0);
  return room;
}

Stage::Room& Stage::room_for(int width, int height, int samples) {
  const auto fits = [&](const Room& r) { return r.width == width && r.height == height && r.samples == samples; };
  const auto at = std::find_if(rooms_.begin(), rooms_.end(), fits);
  if (at != rooms_.end()) return *at;
  if (rooms_.size() == kMostRooms) rooms_.erase(rooms_.begin());
  return rooms_.emplace_back(make_room(width, height, samples));
}

std::vector<std::uint32_t> Stage::words_of(std::span<const foliage::Run> runs, const Shot& shot,
                                           const HowDrawn& how) const {
  std::vector<std::uint32_t> words;
  for (const foliage::Run& run : runs)
    for (std::uint32_t site = run.first; site < run.last; ++site) words.push_back(site);
  if (how.far == nullptr) return words;
  const std::vector<Vec4> rows = rows_seen_from(shot.view.eye);
  const double error_px = how.far_error_px > 0 ? how.far_error_px : how.error_px;
  words.resize(split_trees(*how.far, {store_.table, {sites_, rows, runs, error_px / shot.focal_px}}, words.data()));
  return words;
}

/// How many of the first have room in the lists at once.
std::size_t Stage::part_of(std::span<const std::uint32_t> words) const {
  if (law_ != foliage::Law::full) return words.size();
  const foliage::ListSizes room = foliage::room_of(extractor_.capacity);
  std::size_t cells = 0, groups = 0, n = 0;
  for (; n < words.size(); ++n) {
    const foliage::PreparedPlant& plant = plants_[sites_[words[n]].plant];
    const std::size_t bark = plant.branch_levels.empty() ? 0 : plant.branch_levels.front().quads.size();
    cells += plant.cells.size();
    groups += (bark + plant.leaves.size()) / foliage::glsl::kQuadGroup + plant.cells.size() + 2;
    if (static_cast<double>(cells) > room.x || static_cast<double>(groups) > room.y) break;
  }
  return std::min(std::max<std::size_t>(n, 1), words.size());
}

void Stage::begin(std::span<const foliage::Run> runs, const Shot& shot, const HowDrawn& how) {
  in_view_ = {};
  words_ = words_of(runs, shot, how);
  in_view_.buffer = trees_.name();
  in_view_.error_at_1m = how.error_px / shot.focal_px;
  in_view_.heed_neighbours = how.heed_neighbours;
  in_view_.sides = foliage::sides_of(culling::make_frustum(shot.view), shot.view.eye);
  begin(shot);
}

void Stage::extract_trees(std::span<const std::uint32_t> words) {
  in_view_.trees = static_cast<std::uint32_t>(words.size());
  glNamedBufferSubData(trees_.name(), 0, static_cast<GLsizeiptr>(words.size_bytes()), words.data());
  extract(extractor_, store_, in_view_);
}

void Stage::begin(const Shot& shot) {
  const std::vector<Vec4> rows = rows_seen_from(shot.view.eye);
  glNamedBufferSubData(rows_.name(), 0, static_cast<GLsizeiptr>(rows.size() * sizeof rows[0]), rows.data());
  draw::DrawOptions options;
  options.layers.fog = false;
  options.sun = shot.sun;
  draw::FrameData frame = draw::make_frame(LocalFrame{}, draw::camera_of(shot.view), options, BlockFrame{});
  // Level ground, wherever the eye is.
  frame.up = {0, 0, 1, 1};
  upload(frame_, frame);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, foliage::kBlockRowsBinding, rows_.name());
}

void Stage::clear(Room& room) {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, room.drawn.name());
  glViewport(0, 0, room.width, room.height);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  glDisable(GL_CULL_FACE);
  glEnable(GL_FRAMEBUFFER_SRGB);
  const Vec4 nothing{0};
  glClearNamedFramebufferfv(room.drawn.name(), GL_COLOR, 0, &nothing.x);
  glClearNamedFramebufferfv(room.drawn.name(), GL_COLOR, 1, &nothing.x);
  glClearNamedFramebufferfv(room.drawn.name(), GL_DEPTH, 0, &nothing.x);
}

void Stage::extract_and_draw(Room& room, const Shot& shot, const HowDrawn& how) {
  clear(room);
  if (how.hidden_too) glDepthFunc(GL_ALWAYS);
  const double enlarged = static_cast<double>(room.width) / shot.width;
  foliage::DrawPlantsOptions options;  // no wind
  options.focal_px = static_cast<float>(shot.focal_px * enlarged);
  options.samples = room.samples;
  shown_before_ = {};
  for (std::span<const std::uint32_t> rest = words_;;) {
    const std::size_t n = part_of(rest);
    extract_trees(rest.first(n));
    draw_plants(programs_, store_, extractor_, options);
    rest = rest.subspan(n);
    if (rest.empty()) break;
    shown_before_ = shown();
  }
  if (how.far != nullptr) draw_far(*how.far, options.focal_px, room.samples);
}

/// Means over squares of `factor` pixels.
Picture Stage::read(Room& room, int factor) {
  const bool many = room.samples > 1;
  for (const GLenum part : {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1}) {
    if (!many) break;
    glNamedFramebufferReadBuffer(room.drawn.name(), part);
    glNamedFramebufferDrawBuffers(room.flat.name(), 1, &part);
    glBlitNamedFramebuffer(room.drawn.name(), room.flat.name(), 0, 0, room.width, room.height, 0, 0, room.width,
                           room.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  const gl::Framebuffer& from = many ? room.flat : room.drawn;
  read_bytes(from, GL_COLOR_ATTACHMENT0, GL_RGBA, room.width, room.height, colour_);
  read_bytes(from, GL_COLOR_ATTACHMENT1, GL_RED, room.width, room.height, mask_);
  static const auto linear = decoding();
  Picture picture = make_picture(room.width / factor, room.height / factor);
  for (int y = 0; y < room.height; ++y) {
    for (int x = 0; x < room.width; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(room.width) + static_cast<std::size_t>(x);
      if (mask_[i] == 0) continue;
      picture.at(x / factor, y / factor) += Vec4{linear[colour_[4 * i]], linear[colour_[4 * i + 1]],
                                                 linear[colour_[4 * i + 2]], static_cast<float>(mask_[i]) / 255};
    }
  }
  for (Vec4& texel : picture.texels) texel /= static_cast<float>(factor * factor);
  return picture;
}

Stage::Room& Stage::room_for(const Shot& shot, Sampling sampling) {
  const bool fine = sampling == Sampling::fine;
  const int enlarged = fine ? shot.fine : 1;
  return room_for(shot.width * enlarged, shot.height * enlarged, sampling == Sampling::product ? kProductSamples : 1);
}

Stage::Room& Stage::paint_into_room(const Paint& paint, const Shot& shot, Sampling sampling) {
  Room& room = room_for(shot, sampling);
  begin(shot);
  clear(room);
  paint({room.width, room.height, room.samples, shot.focal_px * room.width / shot.width});
  return room;
}

Stage::Room& Stage::draw_into_room(std::span<const foliage::Run> runs, const Shot& shot, const HowDrawn& how) {
  Room& room = room_for(shot, how.sampling);
  begin(runs, shot, how);
  extract_and_draw(room, shot, how);
  return room;
}

Picture Stage::draw(std::span<const foliage::Run> runs, const Shot& shot, const HowDrawn& how) {
  Room& room = draw_into_room(runs, shot, how);
  return read(room, how.sampling == Sampling::fine ? shot.fine : 1);
}

Picture Stage::draw(const Paint& paint, const Shot& shot, Sampling sampling) {
  return read(paint_into_room(paint, shot, sampling), sampling == Sampling::fine ? shot.fine : 1);
}

void Stage::draw_only(const Paint& paint, const Shot& shot, Sampling sampling) {
  paint_into_room(paint, shot, sampling);
  glFinish();
}

void Stage::draw_only(std::span<const foliage::Run> runs, const Shot& shot, const HowDrawn& how) {
  draw_into_room(runs, shot, how);
  glFinish();
}

std::uint64_t Stage::samples_drawn(std::span<const foliage::Run> runs, const Shot& shot, HowDrawn how) {
  how.sampling = Sampling::product;
  how.hidden_too = true;
  GLuint name = 0;
  glCreateQueries(GL_SAMPLES_PASSED, 1, &name);
  const gl::Query query(name);
  glBeginQuery(GL_SAMPLES_PASSED, name);
  draw_into_room(runs, shot, how);
  glEndQuery(GL_SAMPLES_PASSED);
  GLuint64 samples = 0;
  glGetQueryObjectui64v(name, GL_QUERY_RESULT, &samples);
  return samples;
}

void Stage::extract_only(std::span<const foliage::Run> runs, const Shot& shot, const HowDrawn& how) {
  begin(runs, shot, how);
  extract_trees(words_);
  glFinish();
}

foliage::Shown Stage::shown() {
  glFinish();
  const foliage::Shown last = newest_shown(extractor_), &before = shown_before_;
  return {before.bark + last.bark, before.leaves + last.leaves, before.lines + last.lines, before.points + last.points,
          before.missing + last.missing};
}

}  // namespace manzana::foliage_benchmark
