#include "foliage/gl/draw_groves.h"

#include "foliage/gl/stream_lists.h"
#include "gl/vertex_array.h"
#include "manzana_foliage_gl_shaders.h"

namespace manzana::foliage {
namespace {

gl::Program make_program(const HostShaders& host, int samples) {
  using namespace shaders;
  const std::string define = define_samples(samples);
  gl::Pieces vertex{version_glsl, define, hash_glsl, samples_glsl, grove_layout_glsl};
  vertex.insert(vertex.end(), host.vertex.begin(), host.vertex.end());
  vertex.insert(vertex.end(), {packed_normal_glsl, flat_picture_glsl, grove_vert});
  gl::Pieces pixels{version_glsl, define, hash_glsl, samples_glsl, tree_share_glsl, cover_glsl, plant_share_glsl};
  pixels.insert(pixels.end(), host.points.begin(), host.points.end());
  return gl::make_program("groves", vertex, pixels);
}

}  // namespace

GroveDrawer::GroveDrawer(HostShaders host) : host_(std::move(host)), array_(gl::make_vertex_array()) {}

std::optional<GroveDrawer::Place> GroveDrawer::take(std::uint32_t points) {
  for (std::uint32_t page = 0; page < pages_.size(); ++page)
    if (const auto first = pages_[page].room.take(points)) return Place{page, *first, points};
  return std::nullopt;
}

std::optional<GroveDrawer::Place> GroveDrawer::add(std::span<const LeafPoint> points) {
  if (points.empty() || points.size() > kPage) return std::nullopt;
  const auto n = static_cast<std::uint32_t>(points.size());
  auto place = take(n);
  if (!place && pages_.size() < most_pages_) {
    pages_.push_back({gl::make_writable_buffer(kPageBytes), {}});
    pages_.back().room.grow(kPage);
    place = take(n);
  }
  if (place)
    glNamedBufferSubData(pages_[place->page].points.name(), static_cast<GLintptr>(place->first * sizeof(LeafPoint)),
                         static_cast<GLsizeiptr>(points.size_bytes()), points.data());
  return place;
}

void GroveDrawer::remove(const Place& place) { pages_[place.page].room.give(place.first, place.points); }

std::uint64_t GroveDrawer::draw(std::span<const Shown> shown, float focal_px, int samples) {
  items_.clear();
  groups_.resize(pages_.size());
  for (auto& list : groups_) list.clear();
  std::uint64_t points = 0;
  for (const Shown& grove : shown) {
    const auto item = static_cast<std::uint32_t>(items_.size());
    const GroveShown& s = grove.points;
    items_.push_back({grove.block, grove.place.first, s.count, grove.share, s.edge, s.fade, s.scale, s.light});
    for (std::uint32_t rank = 0; rank < s.count; rank += glsl::kGroveGroup)
      groups_[grove.place.page].emplace_back(item, rank);
    points += s.count;
  }
  if (points == 0) return 0;
  std::size_t room = room_for(items_);
  for (const auto& list : groups_) room += room_for(list);
  stream_.begin(room);
  if (samples_ != samples) program_ = make_program(host_, samples);
  samples_ = samples;
  glUseProgram(program_.name());
  glUniform1f(0, focal_px);
  glBindVertexArray(array_.name());
  glEnable(GL_PROGRAM_POINT_SIZE);
  bind_list(stream_, kItemsBinding, items_);
  for (std::size_t page = 0; page < pages_.size(); ++page) {
    if (groups_[page].empty()) continue;
    bind_list(stream_, kGroupsBinding, groups_[page]);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kPrimitivesBinding, pages_[page].points.name());
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(groups_[page].size() * glsl::kGroveGroup));
  }
  glDisable(GL_PROGRAM_POINT_SIZE);
  stream_.end();
  return points;
}

}  // namespace manzana::foliage
