#include "foliage/plant_mesh.h"

#include <algorithm>
#include <cmath>

namespace manzana::foliage {
namespace {

constexpr float kHuge = 3e38F;

float from_axis(const Vec3& p) { return std::sqrt(p.x * p.x + p.y * p.y); }

}  // namespace

void add_quad(MeshPart& part, const std::array<MeshVertex, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(part.vertices.size());
  part.vertices.insert(part.vertices.end(), corners.begin(), corners.end());
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) part.indices.push_back(first + i);
}

PlantSize measure(const PlantMesh& mesh) {
  PlantSize size;
  for (const MeshPart* part : {&mesh.bark, &mesh.leaves}) {
    for (const MeshVertex& v : part->vertices) {
      size.height = std::max(size.height, v.position.z);
      size.radius = std::max(size.radius, from_axis(v.position));
    }
  }
  return size;
}

CrownLight::CrownLight(const MeshPart& leaves) : density_(kCells * kCells * kCells, 0.0F) {
  if (leaves.indices.empty()) return;
  Vec3 low(kHuge), high(-kHuge);
  for (const MeshVertex& v : leaves.vertices) low = glm::min(low, v.position), high = glm::max(high, v.position);
  low_ = low;
  cell_ = glm::max((high - low) * (1.0F / kCells), Vec3(1e-4F));
  const float volume = cell_.x * cell_.y * cell_.z;
  for (std::size_t t = 0; t + 2 < leaves.indices.size(); t += 3) {
    const Vec3& a = leaves.vertices[leaves.indices[t]].position;
    const Vec3& b = leaves.vertices[leaves.indices[t + 1]].position;
    const Vec3& c = leaves.vertices[leaves.indices[t + 2]].position;
    const glm::ivec3 at(glm::clamp(((a + b + c) / 3.0F - low_) / cell_, 0.0F, kCells - 1.0F));
    density_[static_cast<std::size_t>((at.z * kCells + at.y) * kCells + at.x)] +=
        0.5F * glm::length(glm::cross(b - a, c - a)) / volume;
  }
}

float CrownLight::ambient(const Vec3& at) const {
  // Sky directions: the zenith, four at 45 degrees, four at the horizon, weighted as the sky's light on a leaf.
  static const std::array<Vec3, 9> kSky{Vec3{0, 0, 1},        Vec3{.7F, 0, .7F},   Vec3{-.7F, 0, .7F},
                                        Vec3{0, .7F, .7F},    Vec3{0, -.7F, .7F},  Vec3{.95F, .3F, 0},
                                        Vec3{-.95F, -.3F, 0}, Vec3{-.3F, .95F, 0}, Vec3{.3F, -.95F, 0}};
  constexpr float kBlocked = 0.22F;  // of a leaf area density, per metre: half is turned away, half of a card is air
  float light = 0, weights = 0;
  for (std::size_t d = 0; d < kSky.size(); ++d) {
    const Vec3 step = kSky[d] * cell_;
    Vec3 p = (at - low_) / cell_ + kSky[d] * 0.7F;
    float passed = 0;
    for (int i = 0; i < kCells; ++i, p += kSky[d]) {
      // In floats: bark may lie farther out than an int counts.
      if (glm::any(glm::lessThan(p, Vec3(0))) || glm::any(glm::greaterThanEqual(p, Vec3(kCells)))) break;
      const glm::ivec3 c(p);
      passed += density_[static_cast<std::size_t>((c.z * kCells + c.y) * kCells + c.x)];
    }
    const float weight = d < 5 ? 1.0F : 0.6F;
    light += weight * std::exp(-kBlocked * passed * glm::length(step));
    weights += weight;
  }
  return light / weights;
}

Vec3 CrownLight::bent_normal(const MeshVertex& vertex) const {
  constexpr float kBend = 0.75F;
  const Vec3 half = cell_ * (0.5F * kCells);
  const Vec3 middle = low_ + half * Vec3(1, 1, 0.8F);
  const Vec3 out = (vertex.position - middle) / (half * half);
  const float length = glm::length(out);
  const Vec3 away = length > 1e-6F ? out / length : Vec3(0, 0, 1);
  const Vec3 facing = glm::dot(vertex.normal, away) < 0 ? -vertex.normal : vertex.normal;
  return glm::normalize(away * kBend + facing * (1 - kBend));
}

void CrownLight::apply(PlantMesh& mesh) const {
  constexpr float kDarkest = 0.12F;
  for (MeshPart* part : {&mesh.bark, &mesh.leaves})
    for (MeshVertex& v : part->vertices) v.shade = kDarkest + (1 - kDarkest) * ambient(v.position);
  for (MeshVertex& v : mesh.leaves.vertices) v.normal = bent_normal(v);
}

std::uint32_t pack_normal(const Vec3& normal) {
  const auto bits = [](float v) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(v, -1.0F, 1.0F) * 511)) & 1023U;
  };
  return bits(normal.x) | (bits(normal.y) << 10) | (bits(normal.z) << 20);
}

Vec3 unpack_normal(std::uint32_t bits) {
  const auto part = [&](int shift) { return static_cast<float>(static_cast<int>(bits << shift) >> 22) / 511; };
  return {part(22), part(12), part(2)};
}

std::uint16_t pack_uv(float v) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(v / kUvRange, 0.0F, 1.0F) * 65535));
}

std::uint8_t pack_shade(float v) { return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0F, 1.0F) * 255)); }

}  // namespace manzana::foliage
