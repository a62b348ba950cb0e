#include "foliage/silhouettes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "foliage/leaf_scale.h"
#include "foliage/lod_factor.h"

namespace manzana::foliage {
namespace {

constexpr std::size_t kViews = Silhouettes::kViews;
constexpr int kPixels = 256;
constexpr float kMargin = 1.1F;  // leaves grow out of the crown

Vec3d view_direction(std::size_t view, std::span<const double> rises) {
  const double angle = 3.14159265358979 * static_cast<double>(view) / kViews + 0.1;
  return glm::normalize(Vec3d(std::cos(angle), std::sin(angle), rises[view % rises.size()]));
}

constexpr int kBlock = 8;
bool all_hit(const std::uint8_t* first) {
  std::uint64_t eight;
  std::memcpy(&eight, first, kBlock);
  return eight == 0x0101010101010101U;
}

void draw(const LeafPoint& point, float factor, const ParallelView& view, std::vector<std::uint8_t>& hits) {
  const Vec2 middle = view.pixel(point.position), half(0.5F * view.pixels_of(std::sqrt(point.area * factor)));
  const auto pixel = [](float v) { return first_pixel(v, kPixels); };
  const Vec2 low = middle - half, high = middle + half;
  for (int y = pixel(low.y); y < pixel(high.y); ++y)
    std::fill(hits.begin() + y * kPixels + pixel(low.x), hits.begin() + y * kPixels + pixel(high.x), std::uint8_t{1});
}

void draw(const LineSegment& line, const ParallelView& view, std::vector<std::uint8_t>& hits) {
  const Vec2 a = view.pixel(line.a), b = view.pixel(line.b), along = b - a;
  const float length = glm::length(along);
  if (!(length > 0)) return;
  const Vec2 across(-along.y / length, along.x / length), wide_a = across * view.pixels_of(line.radius_a),
                                                          wide_b = across * view.pixels_of(line.radius_b);
  const auto fill = [&](const PixelSpan& span) {
    std::fill_n(hits.begin() + span.y * kPixels + span.first, span.last - span.first, std::uint8_t{1});
  };
  for_each_span({a - wide_a, b - wide_b, b + wide_b}, kPixels, fill);
  for_each_span({a - wide_a, b + wide_b, a + wide_a}, kPixels, fill);
}

}  // namespace

Silhouettes::Silhouettes(const PreparedPlant& plant, std::span<const double> rises)
    : plant_(plant), holes_(plant.leaf_image) {
  for (std::size_t v = 0; v < kViews; ++v) {
    views_.push_back(view_of(plant, view_direction(v, rises), kPixels, kMargin));
    bark_.emplace_back(std::size_t{kPixels} * kPixels + kBlock, std::uint8_t{0});
  }
  tbb::parallel_for(std::size_t{0}, kViews, [&](std::size_t v) {
    const Run bark = finest_bark(plant);
    for (std::uint32_t q = bark.first; q < bark.last; ++q) draw(plant.bark[q], 1, false, views_[v], bark_[v]);
  });
}

template <class Draw>
Silhouettes::Coverage Silhouettes::counted(Draw&& draw_all) const {
  Coverage count{};
  tbb::parallel_for(std::size_t{0}, kViews, [&](std::size_t v) {
    const Hits hits = draw_all(v);
    count[v] = static_cast<std::size_t>(std::count(hits.begin(), hits.end(), 1));
  });
  return count;
}

Silhouettes::Coverage Silhouettes::coverage(double u, float scale) const {
  return counted([&](std::size_t v) {
    Hits hits = bark_[v];
    for (std::uint32_t c = 0; c < plant_.cells.size(); ++c) {
      const Run& quads = plant_.cells[c].quads;
      const auto last = quads.first + static_cast<std::uint32_t>(kept(quads.size(), u, cell_threshold(c)));
      for (std::uint32_t q = quads.first; q < last; ++q) draw(plant_.leaves[q], scale, true, views_[v], hits);
    }
    return hits;
  });
}

Silhouettes::Coverage Silhouettes::coverage(const Selection& chosen) const {
  return counted([&](std::size_t v) {
    Hits hits(bark_[v].size(), std::uint8_t{0});
    for (const Item& item : chosen.items)
      for (std::uint32_t rank = 0; item.record == v && rank < item.count; ++rank) draw(item, rank, views_[v], hits);
    return hits;
  });
}

/// As foliage/shaders/plant_quads.vert, plant_lines.vert and plant_points.vert have it.
void Silhouettes::draw(const Item& item, std::uint32_t rank, const ParallelView& view, Hits& hits) const {
  const float left = std::clamp((item.edge - static_cast<float>(rank)) / item.fade, 0.0F, 1.0F);
  if (item.kind == glsl::kBark) {
    draw(plant_.bark[item.first + rank], 1, false, view, hits);
  } else if (item.kind == glsl::kLeaves) {
    const std::size_t quad = item.first + rank - plant_.bark.size();
    draw(plant_.leaves[quad], item.scale * std::sqrt(left), true, view, hits);
  } else if (item.kind == glsl::kPoints) {
    foliage::draw(plant_.points[item.first + rank], item.scale * left, view, hits);
  } else {
    const std::size_t row = rank + (static_cast<float>(rank) < item.edge ? item.first : item.second);
    const LineSegment& line =
        row < plant_.lines.size() ? plant_.lines[row] : plant_.coarse_lines[row - plant_.lines.size()];
    if (line.branch != kOfLeaf) foliage::draw(line, view, hits);
  }
}

void Silhouettes::draw(const PlantQuad& quad, float scale, bool leaf, const ParallelView& view, Hits& hits) const {
  std::array<Vec2, 4> at;
  for (std::size_t k = 0; k < 4; ++k) at[k] = view.pixel(scaled_corner(quad, k, scale));
  const QuadUv uv(quad);
  for_each_quad_span(at, form_of(quad, uv), kPixels, [&](const PixelSpan& span, const QuadPart& part) {
    const Along u(span, uv.u, part), v(span, uv.v, part);
    std::uint8_t* hit = &hits[static_cast<std::size_t>(span.y * kPixels + span.first)];
    const int size = span.last - span.first;
    for (int i = 0; i < size; i += kLanes) {
      if (i % kBlock == 0 && all_hit(hit + i)) {  // most are, where leaves lie deep
        i += kBlock - kLanes;
        continue;
      }
      const Lanes<std::int32_t> texels = holes_.texels(u.lanes(i), v.lanes(i));
      for (int j = 0; j < std::min(size - i, kLanes); ++j)
        if (hit[i + j] == 0 && (!leaf || holes_.opaque(texels[j]))) hit[i + j] = 1;
    }
  });
}

double covered(const Silhouettes::Coverage& coverage) {
  double all = 0;
  for (const std::size_t pixels : coverage) all += static_cast<double>(pixels);
  return all;
}

}  // namespace manzana::foliage
