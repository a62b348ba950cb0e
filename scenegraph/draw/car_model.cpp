#include "scenegraph/draw/car_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>

#include "scenegraph/mesh.h"

namespace manzana::draw {
namespace {

// A section across the car. From the front: y, half the width, height of the belt (where the windows begin) and of the
// top (bonnet, roof or boot); and what the strip of windows and the strip of the top are made of from here to the next.
struct Station {
  float y, width, belt, top;
  CarPart side, roof;
};
constexpr CarPart kPaint = CarPart::paint, kGlass = CarPart::glass;

constexpr std::array kSaloon{
    Station{2.23F, 0.66F, 0.56F, 0.58F, kPaint, kPaint},  Station{2.12F, 0.82F, 0.66F, 0.70F, kPaint, kPaint},
    Station{1.70F, 0.88F, 0.76F, 0.82F, kPaint, kPaint},  Station{1.02F, 0.89F, 0.85F, 0.92F, kPaint, kGlass},
    Station{0.34F, 0.89F, 0.89F, 1.38F, kGlass, kPaint},  Station{-0.30F, 0.89F, 0.90F, 1.43F, kPaint, kPaint},
    Station{-0.38F, 0.89F, 0.90F, 1.43F, kGlass, kPaint}, Station{-1.00F, 0.89F, 0.91F, 1.38F, kPaint, kGlass},
    Station{-1.62F, 0.88F, 0.94F, 1.02F, kPaint, kPaint}, Station{-2.12F, 0.82F, 0.90F, 0.97F, kPaint, kPaint},
    Station{-2.23F, 0.70F, 0.80F, 0.84F, kPaint, kPaint}};
constexpr std::array kHatchback{
    Station{1.95F, 0.64F, 0.58F, 0.60F, kPaint, kPaint},  Station{1.86F, 0.78F, 0.68F, 0.73F, kPaint, kPaint},
    Station{1.50F, 0.84F, 0.80F, 0.87F, kPaint, kPaint},  Station{0.95F, 0.85F, 0.89F, 0.97F, kPaint, kGlass},
    Station{0.38F, 0.85F, 0.92F, 1.44F, kGlass, kPaint},  Station{-0.25F, 0.85F, 0.93F, 1.49F, kPaint, kPaint},
    Station{-0.33F, 0.85F, 0.93F, 1.49F, kGlass, kPaint}, Station{-1.00F, 0.85F, 0.95F, 1.46F, kPaint, kPaint},
    Station{-1.45F, 0.84F, 0.98F, 1.40F, kPaint, kGlass}, Station{-1.82F, 0.82F, 0.98F, 1.04F, kPaint, kPaint},
    Station{-1.95F, 0.74F, 0.80F, 0.84F, kPaint, kPaint}};
constexpr std::array kVan{
    Station{2.15F, 0.68F, 0.66F, 0.70F, kPaint, kPaint},  Station{2.06F, 0.82F, 0.80F, 0.86F, kPaint, kPaint},
    Station{1.80F, 0.87F, 0.92F, 1.00F, kPaint, kPaint},  Station{1.45F, 0.88F, 1.00F, 1.08F, kPaint, kGlass},
    Station{0.92F, 0.88F, 1.04F, 1.72F, kGlass, kPaint},  Station{0.30F, 0.88F, 1.05F, 1.83F, kPaint, kPaint},
    Station{-0.40F, 0.88F, 1.05F, 1.84F, kPaint, kPaint}, Station{-1.20F, 0.88F, 1.05F, 1.84F, kPaint, kPaint},
    Station{-2.00F, 0.87F, 1.05F, 1.82F, kPaint, kPaint}, Station{-2.10F, 0.85F, 1.04F, 1.76F, kPaint, kGlass},
    Station{-2.15F, 0.82F, 1.00F, 1.04F, kPaint, kPaint}};
constexpr float kBottom = 0.24F, kWheelRadius = 0.31F, kWheelWidth = 0.2F;

std::span<const Station> stations(CarBody body) {
  if (body == CarBody::saloon) return kSaloon;
  if (body == CarBody::hatchback) return kHatchback;
  return kVan;
}

struct Triangle {
  std::array<Vec3, 3> corner;
  CarPart part;
};
using Soup = std::vector<Triangle>;

void add_triangle(Soup& soup, const Vec3& a, const Vec3& b, const Vec3& c, CarPart part) {
  const Vec3 n = glm::cross(b - a, c - a);
  constexpr float kNothing = 1e-10F;
  if (glm::dot(n, n) > kNothing) soup.push_back({{a, b, c}, part});
}

void add_quad(Soup& soup, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, CarPart part) {
  add_triangle(soup, a, b, c, part);
  add_triangle(soup, a, c, d, part);
}

// Half of a section: (x, z) from the sill over belt and window to the middle of the top. `glass`, `roof`: the first
// point of those strips.
struct Section {
  std::vector<Vec2> points;
  std::size_t glass = 0, roof = 0;
};

Section section(const Station& s, std::size_t level) {
  const float inner = s.width * (s.top - s.belt > 0.2F ? 0.78F : 0.86F);
  const float rise = s.top - s.belt;
  if (level == 0) {
    return {{{0.90F * s.width, kBottom},
             {0.97F * s.width, kBottom + 0.08F},
             {s.width, 0.55F * s.belt + 0.1F},
             {0.985F * s.width, s.belt - 0.06F},
             {0.95F * s.width, s.belt},
             {inner + 0.03F, s.top - 0.2F * rise},
             {inner, s.top - 0.1F * rise},
             {0.86F * inner, s.top - 0.025F * rise},
             {0.5F * inner, s.top},
             {0, s.top}},
            4,
            6};
  }
  if (level == 1) {
    return {{{0.93F * s.width, kBottom},
             {s.width, 0.55F * s.belt + 0.1F},
             {0.95F * s.width, s.belt},
             {inner, s.top - 0.1F * rise},
             {0.8F * inner, s.top},
             {0, s.top}},
            2,
            3};
  }
  return {{{s.width, 0.5F * kBottom}, {0.95F * s.width, s.belt}, {inner, s.top}, {0, s.top}}, 1, 2};
}

CarPart part_of(const Station& from, const Section& s, std::size_t strip) {
  if (strip < s.glass) return CarPart::paint;
  return strip < s.roof && from.roof == CarPart::paint ? from.side : strip < s.roof ? CarPart::paint : from.roof;
}

Vec3 mirrored(const Vec3& p, float side) { return {side * p.x, p.y, p.z}; }

// A quad on the right (x > 0) and its mirror on the left.
void add_pair(Soup& soup, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, CarPart part) {
  add_quad(soup, a, b, c, d, part);
  add_quad(soup, mirrored(d, -1), mirrored(c, -1), mirrored(b, -1), mirrored(a, -1), part);
}

Vec3 at(const Station& s, const Vec2& p) { return {p.x, s.y, p.y}; }

void add_body(Soup& soup, std::span<const Station> line, std::size_t level) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Section front = section(line[i], level), rear = section(line[i + 1], level);
    for (std::size_t k = 0; k + 1 < front.points.size(); ++k) {
      add_pair(soup, at(line[i], front.points[k]), at(line[i], front.points[k + 1]),
               at(line[i + 1], rear.points[k + 1]), at(line[i + 1], rear.points[k]), part_of(line[i], front, k));
    }
  }
}

// Nose and tail: strips from side to side.
void add_end(Soup& soup, const Station& s, std::size_t level, bool front) {
  const Section half = section(s, level);
  for (std::size_t k = 0; k + 1 < half.points.size(); ++k) {
    const Vec3 a = at(s, half.points[k]), b = at(s, half.points[k + 1]);
    if (front) {
      add_quad(soup, a, mirrored(a, -1), mirrored(b, -1), b, CarPart::paint);
    } else {
      add_quad(soup, b, mirrored(b, -1), mirrored(a, -1), a, CarPart::paint);
    }
  }
}

// A plate that faces along y, a little outside of the body.
void add_plate(Soup& soup, const Vec3& centre, const Vec2& half, CarPart part) {
  const float side = centre.y > 0 ? -1.0F : 1.0F;
  const Vec3 x(side * half.x, 0, 0), z(0, 0, half.y);
  add_quad(soup, centre - x - z, centre + x - z, centre + x + z, centre - x + z, part);
}

void add_lights(Soup& soup, const Station& nose, const Station& tail, bool plates) {
  constexpr float kOut = 0.012F;
  for (const float side : {-1.0F, 1.0F}) {
    add_plate(soup, {side * 0.74F * nose.width, nose.y + kOut, nose.belt - 0.06F}, {0.15F, 0.055F},
              CarPart::head_light);
    add_plate(soup, {side * 0.76F * tail.width, tail.y - kOut, tail.belt - 0.09F}, {0.13F, 0.07F}, CarPart::tail_light);
  }
  if (!plates) return;
  add_plate(soup, {0, nose.y + kOut, kBottom + 0.12F}, {0.45F, 0.06F}, CarPart::rubber);
  add_plate(soup, {0, nose.y + 2 * kOut, kBottom + 0.13F}, {0.24F, 0.045F}, CarPart::metal);
  add_plate(soup, {0, tail.y - kOut, tail.belt - 0.26F}, {0.24F, 0.05F}, CarPart::metal);
  add_plate(soup, {0, tail.y - kOut, kBottom + 0.06F}, {0.6F, 0.06F}, CarPart::rubber);
}

Vec3 rim(const Vec3& hub, float x, float radius, float angle) {
  return {x, hub.y + radius * std::cos(angle), hub.z + radius * std::sin(angle)};
}

// A wheel on the right: tread, tyre wall, rim. Coarse ones are discs.
void add_wheel(Soup& soup, const Vec3& hub, int sides, bool whole, bool tread) {
  const float x = hub.x;
  for (int i = 0; i < sides; ++i) {
    const auto angle = [&](int k) { return static_cast<float>(2 * std::numbers::pi * k / sides); };
    const float a = angle(i), b = angle(i + 1);
    const float hub_radius = 0.64F * kWheelRadius;
    const Vec3 centre(x, hub.y, hub.z);
    if (tread) {
      add_pair(soup, rim(hub, x - kWheelWidth, kWheelRadius, a), rim(hub, x - kWheelWidth, kWheelRadius, b),
               rim(hub, x, kWheelRadius, b), rim(hub, x, kWheelRadius, a), CarPart::rubber);
    }
    if (!whole) {
      Soup one;
      add_triangle(one, centre, rim(hub, x, kWheelRadius, a), rim(hub, x, kWheelRadius, b), CarPart::rubber);
      for (const Triangle& t : one) {
        soup.push_back(t);
        add_triangle(soup, mirrored(t.corner[2], -1), mirrored(t.corner[1], -1), mirrored(t.corner[0], -1), t.part);
      }
      continue;
    }
    add_pair(soup, rim(hub, x, hub_radius, a), rim(hub, x, kWheelRadius, a), rim(hub, x, kWheelRadius, b),
             rim(hub, x, hub_radius, b), CarPart::rubber);
    const CarPart spoke = i % 3 == 2 ? CarPart::rubber : CarPart::metal;
    add_pair(soup, Vec3(x - 0.03F, hub.y, hub.z), rim(hub, x, hub_radius, a), rim(hub, x, hub_radius, b),
             Vec3(x - 0.03F, hub.y, hub.z), spoke);
  }
}

void add_wheels(Soup& soup, std::span<const Station> line, std::size_t level) {
  constexpr std::array<int, 3> kSides{18, 7, 4};
  const float half_base = 0.6F * line.front().y;
  for (const float y : {half_base, -half_base}) {
    add_wheel(soup, {line[4].width + 0.015F, y, kWheelRadius}, kSides[level], level == 0, level < 2);
  }
}

// The coarsest: the outline from the side, drawn out to the width. 18 triangles.
Soup outline(std::span<const Station> line) {
  Soup soup;
  const std::array<const Station*, 6> at_station{&line[1], &line[1], &line[3], &line[4], &line[7], &line[9]};
  std::array<Vec3, 6> p;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p[i] = {0.85F * line[4].width, at_station[i]->y, i == 0 ? kBottom - 0.1F : at_station[i]->top};
  }
  p[5].y = line.back().y;
  constexpr std::array kTop{CarPart::paint, CarPart::paint, CarPart::glass, CarPart::paint, CarPart::glass};
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    add_quad(soup, p[i], mirrored(p[i], -1), mirrored(p[i + 1], -1), p[i + 1], kTop[i]);
  }
  const Vec3 foot(p[5].x, p[5].y, kBottom - 0.1F);
  add_pair(soup, p[0], p[1], p[5], foot, CarPart::paint);
  add_pair(soup, p[1], p[2], p[4], p[5], CarPart::glass);
  return soup;
}

// Smooth over edges that are blunter than this.
constexpr float kCrease = 0.80F;

struct Face {
  Vec3 normal;  // as long as twice the area
  Vec3 unit;
};

std::vector<Face> faces_of(const Soup& soup) {
  std::vector<Face> faces;
  for (const Triangle& t : soup) {
    const Vec3 normal = glm::cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]);
    faces.push_back({normal, glm::normalize(normal)});
  }
  return faces;
}

bool same_place(const Vec3& a, const Vec3& b) {
  constexpr float kApart = 1e-4F;
  return glm::dot(a - b, a - b) < kApart * kApart;
}

CarMesh weld(const Soup& soup) {
  CarMesh mesh;
  const std::vector<Face> faces = faces_of(soup);
  for (std::size_t i = 0; i < soup.size(); ++i) {
    std::array<Vec3, 3> sums{};
    for (std::size_t other = 0; other < soup.size(); ++other) {
      if (glm::dot(faces[other].unit, faces[i].unit) < kCrease) continue;
      for (std::size_t k = 0; k < 3; ++k)
        for (const Vec3& q : soup[other].corner)
          if (same_place(q, soup[i].corner[k])) sums[k] += faces[other].normal;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.vertices.push_back({soup[i].corner[k], pack_normal(glm::normalize(sums[k])), soup[i].part});
    }
  }
  return mesh;
}

std::uint32_t hash(std::uint32_t x) {
  std::uint64_t z = x * 0x9e3779b97f4a7c15ULL + 0x632be59bd9b4e019ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<std::uint32_t>((z ^ (z >> 31)) >> 32);
}

Vec3 linear(std::uint32_t rgb) {
  const auto channel = [&](int shift) { return std::pow(static_cast<float>(rgb >> shift & 255U) / 255.0F, 2.2F); };
  return {channel(16), channel(8), channel(0)};
}

/// Of a hundred cars.
std::array<Vec3, 100> paints() {
  struct Share {
    std::uint32_t rgb, percent;
  };
  constexpr std::array kShares{Share{0xe9ebec, 24}, Share{0x15171a, 19}, Share{0x55595e, 18}, Share{0xa9adb2, 13},
                               Share{0x24406f, 9},  Share{0x8f1d1d, 7},  Share{0x4d6f8e, 4},  Share{0x6d5a45, 2},
                               Share{0x2f4a36, 2},  Share{0xd9b23a, 1},  Share{0xb85a24, 1}};
  std::array<Vec3, 100> all;
  auto next = all.begin();
  for (const Share& share : kShares) next = std::fill_n(next, share.percent, linear(share.rgb));
  assert(next == all.end());
  return all;
}

}  // namespace

CarMesh make_car(CarBody body, std::size_t level) {
  const std::span<const Station> line = stations(body);
  if (level + 1 >= kCarLevels) return weld(outline(line));
  Soup soup;
  std::vector<Station> kept(line.begin(), line.end());
  if (level == 2) kept = {line[0], line[3], line[4], line[7], line[8], line[10]};
  add_body(soup, kept, level);
  add_end(soup, kept.front(), level, true);
  add_end(soup, kept.back(), level, false);
  add_wheels(soup, line, level);
  if (level < 2) add_lights(soup, line.front(), line.back(), level == 0);
  return weld(soup);
}

Vec3 car_paint(std::uint32_t car) {
  static const std::array<Vec3, 100> kPaints = paints();
  return kPaints[hash(car) % kPaints.size()];
}

CarBody car_body(std::uint32_t car) {
  const std::uint32_t at = hash(car ^ 0x5bd1e995U) % 100;
  return at < 45 ? CarBody::saloon : at < 88 ? CarBody::hatchback : CarBody::van;
}

}  // namespace manzana::draw
