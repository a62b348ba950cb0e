#include "foliage/import/tube_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace manzana::foliage {
namespace {

constexpr std::uint32_t kFar = ~0U;

/// Along which the places spread most. By power iteration; ten digits are not asked for.
Vec3 long_direction(std::span<const Vec3> places, const Vec3& middle) {
  Mat3 spread(0);
  for (const Vec3& p : places) {
    const Vec3 d = p - middle;
    for (int c = 0; c < 3; ++c) spread[c] += d * d[c];
  }
  Vec3 v(0.48F, 0.6F, 0.64F);
  for (int i = 0; i < 40; ++i) {
    const Vec3 next = spread * v;
    const float length = glm::length(next);
    if (!(length > 0)) break;
    v = next / length;
  }
  return v;
}

class Tracer {
 public:
  Tracer(std::span<const Vec3> positions, std::span<const std::uint32_t> corners,
         std::span<const std::uint32_t> triangles) {
    std::vector<std::uint32_t> known;
    for (const std::uint32_t t : triangles)
      known.insert(known.end(), corners.begin() + 3 * static_cast<std::ptrdiff_t>(t),
                   corners.begin() + 3 * static_cast<std::ptrdiff_t>(t) + 3);
    corners_ = known;
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    for (const std::uint32_t v : known) places_.push_back(positions[v]);
    for (std::uint32_t& c : corners_)
      c = static_cast<std::uint32_t>(std::lower_bound(known.begin(), known.end(), c) - known.begin());
    middle_ = std::accumulate(places_.begin(), places_.end(), Vec3(0)) / static_cast<float>(places_.size());
    long_ = long_direction(places_, middle_);
    connect();
  }

  TubeShape run() {
    TubeShape shape;
    walk(seeds(shape.openings));
    slice();
    shape.line = drawn_line();
    if (shape.line.size() < 2) shape.line = chord();
    measure(shape);
    return shape;
  }

 private:
  using Edge = std::array<std::uint32_t, 2>;

  void connect() {
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const std::uint32_t a = corners_[i], b = corners_[i % 3 == 2 ? i - 2 : i + 1];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0, next; i < edges.size(); i = next) {
      for (next = i + 1; next < edges.size() && edges[next] == edges[i];) ++next;
      edges_.push_back(edges[i]);
      if (next == i + 1) rim_.push_back(edges[i]);
    }
  }

  /// Lists of neighbours: those of v are list[first[v]] to list[first[v + 1]].
  struct Neighbours {
    std::vector<std::uint32_t> first, list;
    Neighbours(const std::vector<Edge>& edges, std::size_t count) : first(count + 1, 0), list(2 * edges.size()) {
      for (const Edge& e : edges) ++first[e[0] + 1], ++first[e[1] + 1];
      std::partial_sum(first.begin(), first.end(), first.begin());
      std::vector<std::uint32_t> place(first.begin(), first.end() - 1);
      for (const Edge& e : edges) list[place[e[0]]++] = e[1], list[place[e[1]]++] = e[0];
    }
  };

  /// Steps from the seeds, along edges.
  static void spread(const Neighbours& at, std::vector<std::uint32_t> seeds, std::vector<std::uint32_t>& steps) {
    for (const std::uint32_t v : seeds) steps[v] = 0;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const std::uint32_t v = seeds[i];
      for (std::uint32_t n = at.first[v]; n < at.first[v + 1]; ++n)
        if (steps[at.list[n]] == kFar) steps[at.list[n]] = steps[v] + 1, seeds.push_back(at.list[n]);
    }
  }

  /// The longest opening, or else what is at one end.
  std::vector<std::uint32_t> seeds(int& openings) {
    const Neighbours along(rim_, places_.size());
    std::vector<std::uint32_t> loop_of(places_.size(), kFar), best;
    float longest = 0;
    for (const Edge& e : rim_) {
      if (loop_of[e[0]] != kFar) continue;
      ++openings;
      std::vector<std::uint32_t> loop{e[0]};
      float length = 0;
      loop_of[e[0]] = static_cast<std::uint32_t>(openings);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        for (std::uint32_t n = along.first[loop[i]]; n < along.first[loop[i] + 1]; ++n) {
          const std::uint32_t v = along.list[n];
          length += glm::length(places_[v] - places_[loop[i]]);
          if (loop_of[v] == kFar) loop_of[v] = loop_of[e[0]], loop.push_back(v);
        }
      }
      if (length > longest) longest = length, best = std::move(loop);
    }
    sheet_ = !best.empty() && is_rim(best);
    return best.empty() || sheet_ ? end_vertices() : best;
  }

  /// Round a sheet, from end to end; not the opening of a tube.
  bool is_rim(const std::vector<std::uint32_t>& loop) const {
    Vec2 part(HUGE_VALF, -HUGE_VALF);
    for (const std::uint32_t v : loop) part = {std::min(part.x, along(v)), std::max(part.y, along(v))};
    const Vec2 whole = ends();
    return part.y - part.x > 0.5F * (whole.y - whole.x);
  }

  std::vector<std::uint32_t> end_vertices() const {
    constexpr float kEnd = 0.02F;  // of the length
    const Vec2 whole = ends();
    std::vector<std::uint32_t> out;
    for (std::uint32_t v = 0; v < places_.size(); ++v)
      if (along(v) <= whole.x + kEnd * (whole.y - whole.x)) out.push_back(v);
    return out;
  }

  float along(std::uint32_t v) const { return glm::dot(places_[v] - middle_, long_); }

  Vec2 ends() const {
    Vec2 out(HUGE_VALF, -HUGE_VALF);
    for (std::uint32_t v = 0; v < places_.size(); ++v) out = {std::min(out.x, along(v)), std::max(out.y, along(v))};
    return out;
  }

  void walk(const std::vector<std::uint32_t>& from) {
    level_.assign(places_.size(), kFar);
    spread(Neighbours(edges_, places_.size()), from, level_);
    for (std::uint32_t& l : level_)
      if (l == kFar) l = 0;  // a corner of triangles without extent
  }

  /// The middle of each level, and its mean distance from the line.
  void slice() {
    const std::size_t levels = *std::max_element(level_.begin(), level_.end()) + std::size_t{1};
    std::vector<float> counts(levels, 0);
    slices_.assign(levels, {Vec3(0), 0});
    for (std::size_t v = 0; v < places_.size(); ++v) slices_[level_[v]].position += places_[v], ++counts[level_[v]];
    for (std::size_t l = 0; l < levels; ++l) slices_[l].position /= counts[l];
    for (std::size_t v = 0; v < places_.size(); ++v) {
      const std::size_t l = level_[v];
      const Vec3 along = slices_[std::min(l + 1, levels - 1)].position - slices_[l > 0 ? l - 1 : 0].position;
      const float length2 = glm::dot(along, along);
      Vec3 out = places_[v] - slices_[l].position;
      if (length2 > 0) out -= along * (glm::dot(out, along) / length2);
      slices_[l].radius += glm::length(out) / counts[l];
    }
  }

  /// Without what lies in the slice before: the middle of a lid.
  std::vector<CentrePoint> drawn_line() const {
    constexpr float kSame = 0.05F;  // of the radius
    std::vector<CentrePoint> line;
    for (const CentrePoint& s : slices_) {
      if (!line.empty()) {
        CentrePoint& last = line.back();
        const float step = glm::length(s.position - last.position);
        if (!(step > kSame * std::max(s.radius, last.radius))) {
          last.radius = std::max(last.radius, s.radius);
          continue;
        }
      }
      line.push_back(s);
    }
    return line;
  }

  /// From end to end along the longest direction.
  std::vector<CentrePoint> chord() const {
    const Vec2 whole = ends();
    float radius = 0;
    for (std::uint32_t v = 0; v < places_.size(); ++v)
      radius += glm::length(places_[v] - middle_ - long_ * along(v)) / static_cast<float>(places_.size());
    return {{middle_ + long_ * whole.x, radius}, {middle_ + long_ * whole.y, radius}};
  }

  void measure(TubeShape& shape) const {
    constexpr float kBeside = 1e-3F;  // of a triangle's size: nearer to the line it has no side that faces away
    float facing = 0;
    Vec3 normals(0);
    for (std::size_t i = 0; i + 2 < corners_.size(); i += 3) {
      const Vec3 &a = places_[corners_[i]], &b = places_[corners_[i + 1]], &c = places_[corners_[i + 2]];
      const Vec3 normal = glm::cross(b - a, c - a) * 0.5F;  // as long as the triangle is large
      Vec3 out = a + b + c;
      for (std::size_t k = 0; k < 3; ++k) out -= slices_[level_[corners_[i + k]]].position;
      const float length = glm::length(out);
      shape.area += glm::length(normal);
      normals += normal;
      if (length > kBeside * std::sqrt(glm::length(normal))) facing += std::abs(glm::dot(normal, out)) / length;
    }
    // A sheet is not rounder than it is rolled up.
    if (sheet_) facing = std::min(facing, std::max(shape.area - glm::length(normals), 0.0F));
    shape.roundness = shape.area > 0 ? facing / shape.area : 0;
    float reach = 0, length = 0, radius = 0;
    for (std::size_t i = 0; i + 1 < shape.line.size(); ++i) {
      const CentrePoint &p = shape.line[i], &q = shape.line[i + 1];
      const float step = glm::length(q.position - p.position);
      reach = std::max(reach, glm::length(q.position - shape.line[0].position));
      length += step, radius += step * 0.5F * (p.radius + q.radius);
    }
    shape.slenderness = radius > 0 ? reach * length / radius : 0;
  }

  std::vector<std::uint32_t> corners_;  // of places_, three a triangle
  std::vector<Vec3> places_;
  Vec3 middle_{0}, long_{0};
  bool sheet_ = false;
  std::vector<Edge> edges_, rim_;
  std::vector<std::uint32_t> level_;
  std::vector<CentrePoint> slices_;
};

}  // namespace

TubeShape tube_shape(std::span<const Vec3> positions, std::span<const std::uint32_t> corners,
                     std::span<const std::uint32_t> triangles) {
  return Tracer(positions, corners, triangles).run();
}

}  // namespace manzana::foliage
