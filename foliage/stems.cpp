#include "foliage/stems.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "foliage/random.h"

namespace manzana::foliage {
namespace {

constexpr float kPi = 3.14159265F;
constexpr float kDegree = kPi / 180;
constexpr float kShortest = 0.02F;  // metres; a shorter stem is left out

Vec3 rotated(const Vec3& v, const Vec3& axis, float angle) {  // Rodrigues
  const float c = std::cos(angle), s = std::sin(angle);
  return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1 - c));
}

Mat3 turned(const Mat3& frame, const Vec3& axis, float degrees) {
  const float angle = degrees * kDegree;
  // Made orthonormal again each time: axes of frames are turned about, and an error in their length would grow fast.
  const Vec3 z = glm::normalize(rotated(frame[2], axis, angle)), x = rotated(frame[0], axis, angle);
  const Vec3 across = glm::normalize(x - z * glm::dot(x, z));
  return {across, glm::cross(z, across), z};
}

float declination(const Mat3& frame) {  // degrees from the zenith
  const Vec3 z = frame[2];
  return std::atan2(std::sqrt(z.x * z.x + z.y * z.y), z.z) / kDegree;
}

/// What a stem starts from; a clone (after a split) starts at a later segment of the same stem.
struct Bud {
  int parent = -1, level = 0, first_segment = 0;
  Mat3 frame{1};
  Vec3 position{0};
  float length = 0, radius = 0;
  float length_max = 1, parent_length = 0, offset = 0;  // of its parent, metres along it
  float turn_back = 0;                                  // degrees a segment, to end as it would have without the split
  std::uint64_t seed = 0;
};

/// [section 4.4] Radius at z in [0, 1], without the flare.
float tapered_radius(float taper, float length, float radius, float z) {
  const float unit = taper < 1 ? taper : (taper < 2 ? 2 - taper : 0);
  const float cone = radius * (1 - unit * z);
  if (taper < 1) return cone;
  const float left = (1 - z) * length;
  const float depth = taper < 2 || left < cone ? 1 : taper - 2;
  const float along = taper < 2 || cone <= 0 ? left : std::abs(left - 2 * cone * std::trunc(left / (2 * cone) + 0.5F));
  if (taper < 2 && along >= cone) return cone;
  return (1 - depth) * cone + depth * std::sqrt(std::max(0.0F, cone * cone - (along - cone) * (along - cone)));
}

class Grower {
 public:
  Grower(const SpeciesParams& species, std::uint64_t seed) : species_(species), seed_(seed) {}

  Skeleton run() {
    std::vector<Bud> todo{trunk()};
    while (!todo.empty()) {
      const Bud bud = todo.back();
      todo.pop_back();
      grow_stem(bud, todo);
    }
    return std::move(out_);
  }

 private:
  const StemParams& params(int level) const { return species_.stems[static_cast<std::size_t>(std::min(level, 3))]; }

  Bud trunk() {
    Random random(hash(seed_, 0));
    scale_ = species_.scale + random.spread(species_.scale_v);
    Bud bud;
    bud.seed = hash(seed_, 1);
    bud.length = scale_ * (params(0).length + random.spread(params(0).length_v));
    bud.radius = scale_ * species_.ratio;
    bud.length_max = params(0).length;
    if (!(bud.length > kShortest))
      throw std::invalid_argument("species " + species_.name + ": the trunk has no length");
    bud.frame = turned(bud.frame, {0, 0, 1}, 360 * random.uniform());
    return bud;
  }

  void grow_stem(const Bud& bud, std::vector<Bud>& todo) {
    Random random(bud.seed);
    const Stem stem = follow(bud, random, todo);
    if (bud.level + 1 < species_.levels)
      add_branches(bud, stem, random, todo);
    else
      add_leaves(bud, stem, random), add_organs(bud, stem, random);
    if (bud.level + 1 < species_.levels && bud.level == 0) out_.leaves.push_back(terminal(stem, 0.6F));
    out_.stems.push_back(stem);
    vertices_ += stem_vertices(stem);
    if (vertices_ + 4 * out_.leaves.size() + 8 * out_.organs.size() + 4 * todo.size() > kMaxPlantVertices)
      throw std::invalid_argument("species " + species_.name + ": more than " + std::to_string(kMaxPlantVertices) +
                                  " vertices");
  }

  LeafSite terminal(const Stem& stem, float scale) const {
    return {stem.points.back().position, stem.points.back().frame[2], scale, row()};
  }

  int row() const { return static_cast<int>(out_.stems.size()); }  // of the stem that grows

  float card_scale(const Stem& stem) const {
    constexpr float kLeast = 0.45F;
    return std::clamp(stem.length / std::max(species_.leaf_scale, 1e-3F), kLeast, 1.0F);
  }

  float radius_at(const Bud& bud, float z) const {
    const float r = tapered_radius(params(bud.level).taper, bud.length, bud.radius, z);
    if (bud.level > 0) return r;
    const float y = std::max(0.0F, 1 - 8 * z);  // [section 4.4] root flare
    return r * (1 + species_.flare * (std::pow(100.0F, y) - 1) / 100);
  }

  /// The stem's segments one after the other; splits push clones.
  Stem follow(const Bud& bud, Random& random, std::vector<Bud>& todo) {
    const StemParams& p = params(bud.level);
    Stem stem{bud.parent, bud.level, bud.length, {}};
    Bud at = bud;
    float split_error = 0;
    for (int s = bud.first_segment; s <= p.curve_res; ++s) {
      const float z = static_cast<float>(s) / static_cast<float>(p.curve_res);
      stem.points.push_back({at.position, at.frame, radius_at(bud, z)});
      if (s == p.curve_res) break;
      at.position += at.frame[2] * (bud.length / static_cast<float>(p.curve_res));
      at.frame = curved(at, s, random);
      split(at, s + 1, split_error, random, todo);
    }
    return stem;
  }

  /// [sections 4.1, 4.8] The frame after segment s.
  Mat3 curved(const Bud& bud, int s, Random& random) const {
    const StemParams& p = params(bud.level);
    const auto res = static_cast<float>(p.curve_res);
    float bend = p.curve / res;
    if (p.curve_back != 0) bend = (2 * s < p.curve_res ? p.curve : p.curve_back) / (res / 2);
    Mat3 frame = turned(bud.frame, bud.frame[0], bend + random.spread(p.curve_v) / res + bud.turn_back);
    if (bud.level < 2 || species_.attraction_up == 0) return frame;
    const Vec3 across = glm::cross(frame[2], Vec3(0, 0, 1));
    const float sine = glm::length(across);
    if (sine < 1e-4F) return frame;
    return turned(frame, across / sine, std::min(species_.attraction_up / res, 1.0F) * declination(frame));
  }

  /// [section 4.2] Clones by error diffusion; the stem itself turns the other way.
  void split(Bud& bud, int segment, float& error, Random& random, std::vector<Bud>& todo) {
    const StemParams& p = params(bud.level);
    const int left = p.curve_res - segment;
    if (left <= 0) return;
    int clones = bud.level == 0 && segment == 1 ? species_.base_splits : 0;
    if (clones == 0) {
      clones = static_cast<int>(std::floor(p.seg_splits + error + 0.5F));
      error += p.seg_splits - static_cast<float>(clones);
    }
    if (clones <= 0) return;
    const Bud before = bud;
    for (int c = 0; c < clones; ++c) {
      Bud clone = divergent(before, left, random);
      clone.parent = row();
      clone.first_segment = segment;
      clone.seed = random.bits();
      todo.push_back(clone);
    }
    bud = divergent(before, left, random);
  }

  Bud divergent(Bud bud, int segments_left, Random& random) const {
    const StemParams& p = params(bud.level);
    const float decline = declination(bud.frame);
    const float angle = std::max(0.0F, p.split_angle + random.spread(p.split_angle_v) - decline);
    bud.frame = turned(bud.frame, bud.frame[0], angle);
    bud.turn_back = -angle / static_cast<float>(segments_left);
    const float u = random.uniform();
    const float around = 20 + 0.75F * (30 + std::abs(decline - 90)) * u * u;
    bud.frame = turned(bud.frame, {0, 0, 1}, bud.level == 0 ? 360 * random.uniform() : around * sign(random));
    return bud;
  }

  static float sign(Random& random) { return random.bits() & 1 ? 1.0F : -1.0F; }

  float base_length(int level) const { return level == 0 ? species_.base_size * scale_ : 0; }

  /// [section 4.3] How many children a stem may carry.
  int branch_count(const Bud& bud) const {
    const auto most = static_cast<float>(params(bud.level + 1).branches);
    if (bud.level == 0) return params(1).branches;
    const float longest = std::max(bud.parent_length * bud.length_max, kShortest);
    if (bud.level == 1)
      return static_cast<int>(std::lround(most * (0.2F + 0.8F * std::min(bud.length / longest, 1.0F))));
    return static_cast<int>(std::lround(most * (1 - 0.5F * std::min(bud.offset / bud.parent_length, 1.0F))));
  }

  float child_length(const Bud& parent, float offset, float length_max) const {
    if (parent.level > 0) return length_max * (parent.length - 0.6F * offset);
    const float crown = std::max(parent.length - base_length(0), 1e-6F);
    return parent.length * length_max * shape_ratio(species_.shape, (parent.length - offset) / crown);
  }

  /// [section 4.3] A negative down_angle_v: the angle goes from wide at the crown's base to narrow at its top.
  float down_angle(const Bud& parent, float offset, Random& random) const {
    const StemParams& p = params(parent.level + 1);
    if (p.down_angle_v >= 0) return p.down_angle + random.spread(p.down_angle_v);
    const float base = base_length(parent.level);
    const float ratio = (parent.length - offset) / std::max(parent.length - base, 1e-6F);
    return p.down_angle + p.down_angle_v * (1 - 2 * shape_ratio(0, ratio));
  }

  /// Place and frame on the stem at `offset` metres from its foot.
  static StemPoint point_at(const Bud& bud, const Stem& stem, float offset) {
    const auto segments = static_cast<float>(stem.points.size() - 1 + static_cast<std::size_t>(bud.first_segment));
    const float t = std::max(offset / stem.length * segments - static_cast<float>(bud.first_segment), 0.0F);
    const auto s = std::min(static_cast<std::size_t>(t), stem.points.size() - 2);
    const StemPoint &a = stem.points[s], &b = stem.points[s + 1];
    const float f = std::min(t - static_cast<float>(s), 1.0F);
    return {glm::mix(a.position, b.position, f), a.frame, a.radius + (b.radius - a.radius) * f};
  }

  static float start_of(const Bud& bud, const StemParams& p) {
    return bud.length * static_cast<float>(bud.first_segment) / static_cast<float>(p.curve_res);
  }

  Mat3 child_frame(const Mat3& frame, const StemParams& p, float around, float down, Random& random) const {
    const Mat3 spun = turned(frame, frame[2], around + random.spread(p.rotate_v));
    return turned(spun, spun[0], down);
  }

  /// [section 4.3] Helical for rotate >= 0; otherwise the sides alternate.
  static float around(const StemParams& p, int i, float phase) {
    const auto n = static_cast<float>(i);
    return phase + (p.rotate >= 0 ? std::fmod(n * p.rotate, 360.0F) : static_cast<float>(i % 2) * (180 + p.rotate));
  }

  void add_branches(const Bud& bud, const Stem& stem, Random& random, std::vector<Bud>& todo) {
    const StemParams& p = params(bud.level + 1);
    const int count = branch_count(bud);
    const float base = base_length(bud.level), start = start_of(bud, params(bud.level));
    const float phase = p.rotate >= 0 ? 360 * random.uniform() : 0;
    for (int i = 0; i < count; ++i) {
      const float along = (static_cast<float>(i) + 0.5F + random.spread(0.4F)) / static_cast<float>(count);
      const float offset = base + along * (bud.length - base);
      if (offset < start) continue;
      Bud child;
      child.parent = row();
      child.level = bud.level + 1;
      child.length_max = std::max(p.length + random.spread(p.length_v), 0.0F);
      child.length = child_length(bud, offset, child.length_max);
      if (!(child.length > kShortest)) continue;
      const StemPoint at = point_at(bud, stem, offset);
      const float power = std::pow(child.length / bud.length, species_.ratio_power);
      child.radius = std::min(at.radius * 0.9F, bud.radius * power);  // 0 times infinity is not taken
      child.parent_length = bud.length;
      child.offset = offset;
      child.position = at.position;
      child.frame = child_frame(at.frame, p, around(p, i, phase), down_angle(bud, offset, random), random);
      child.seed = random.bits();
      todo.push_back(child);
    }
  }

  /// [section 4.6] Cards along the stem, one at its tip; leaves take the angles of the level after the last.
  void add_leaves(const Bud& bud, const Stem& stem, Random& random) {
    constexpr float kBare = 0.1F;  // of a stem's length, at its foot
    const StemParams& p = params(bud.level + 1);
    const float ratio = bud.parent_length > 0 ? bud.offset / bud.parent_length : 0;
    const int count = static_cast<int>(std::lround(static_cast<float>(species_.leaves) * shape_ratio(4, 1 - ratio)));
    const float start = start_of(bud, params(bud.level)), phase = p.rotate >= 0 ? 360 * random.uniform() : 0;
    const float scale = card_scale(stem);
    for (int i = 0; i + 1 < count; ++i) {
      const float along = kBare + (1 - kBare) * (static_cast<float>(i) + random.uniform()) / static_cast<float>(count);
      const float offset = along * bud.length;
      if (offset < start) continue;
      const StemPoint at = point_at(bud, stem, offset);
      const float down = p.down_angle + random.spread(std::abs(p.down_angle_v));
      const Vec3 axis = child_frame(at.frame, p, around(p, i, phase), down, random)[2];
      out_.leaves.push_back({at.position, axis, scale, row()});
    }
    if (count > 0) out_.leaves.push_back(terminal(stem, scale));
  }

  /// Flowers look where their stem goes, fruit hangs.
  void add_organs(const Bud& bud, const Stem& stem, Random& random) {
    const bool hangs = species_.organ == "fruit";
    const float start = start_of(bud, params(bud.level));
    for (int i = 0; i < 2 * species_.organs; ++i) {
      const float offset = (0.2F + 0.8F * random.uniform()) * bud.length;
      if (random.uniform() < 0.5F || offset < start) continue;
      const StemPoint at = point_at(bud, stem, offset);
      out_.organs.push_back(
          {at.position, hangs ? Vec3(0, 0, -1) : at.frame[2], 0.85F + 0.3F * random.uniform(), row()});
    }
  }

  const SpeciesParams& species_;
  std::uint64_t seed_;
  float scale_ = 0;
  std::size_t vertices_ = 0;
  Skeleton out_;
};

void require(bool ok, const SpeciesParams& species, const std::string& what) {
  if (!ok) throw std::invalid_argument("species " + species.name + ": " + what);
}

/// Closed; false for what is not a number.
bool within(float v, float low, float high) { return v >= low && v <= high; }

void check_stem(const SpeciesParams& species, std::size_t level) {
  const StemParams& p = species.stems[level];
  const std::string where = "stems[" + std::to_string(level) + "].";
  for (const float angle : {p.down_angle, p.down_angle_v, p.rotate, p.rotate_v, p.curve, p.curve_v, p.curve_back,
                            p.split_angle, p.split_angle_v})
    require(within(angle, -3600, 3600), species, where + "angles are within -3600 .. 3600 degrees");
  require(within(p.branches, 0, 10'000), species, where + "branches is within 0 .. 10000");
  require(within(p.length, 0, 100) && within(p.length_v, 0, 100), species, where + "length is within 0 .. 100");
  require(within(p.taper, 0, 3), species, where + "taper is within 0 .. 3");
  require(within(p.curve_res, 1, 100), species, where + "curve_res is within 1 .. 100");
  require(p.curve_v >= 0, species, where + "curve_v below 0 (a helix) is not offered");
  require(within(p.seg_splits, 0, 10), species, where + "seg_splits is within 0 .. 10");
}

void check(const SpeciesParams& species) {
  require(within(species.shape, 0, 7), species, "shape is within 0 .. 7");
  require(within(species.scale, 0.01F, 1000) && within(species.scale_v, 0, species.scale), species,
          "scale is within 0.01 .. 1000 m, scale_v within 0 .. scale");
  require(within(species.base_size, 0, 0.99F), species, "base_size is within 0 .. 0.99");
  require(within(species.ratio, 0, 1) && within(species.ratio_power, -10, 10) && within(species.flare, 0, 100), species,
          "ratio is within 0 .. 1, ratio_power within -10 .. 10, flare within 0 .. 100");
  require(within(species.base_splits, 0, 20), species, "base_splits is within 0 .. 20");
  require(within(species.levels, 1, 4), species, "levels is within 1 .. 4");
  require(within(species.leaves, 0, 10'000), species, "leaves is within 0 .. 10000");
  require(within(species.leaf_scale, 0, 100) && within(species.leaf_scale_x, 0, 100), species,
          "leaf_scale and leaf_scale_x are within 0 .. 100");
  require(species.organ == "none" || species.organ == "flower" || species.organ == "fruit", species,
          "organ is none of none, flower, fruit");
  require(within(species.organs, 0, 1000) && within(species.organ_scale, 0, 100), species,
          "organs is within 0 .. 1000, organ_scale within 0 .. 100");
  require(within(species.attraction_up, -10, 10), species, "attraction_up is within -10 .. 10");
  for (std::size_t level = 0; level < species.stems.size(); ++level) check_stem(species, level);
}

}  // namespace

int stem_sides(int level) {
  constexpr std::array<int, 4> kSides{6, 4, 3, 3};
  return kSides[static_cast<std::size_t>(std::min(level, 3))];
}

std::size_t stem_vertices(const Stem& stem) {
  return static_cast<std::size_t>(stem_sides(stem.level) + 1) * (stem.points.size() - 1) + 1;
}

float shape_ratio(int shape, float ratio) {
  switch (shape) {
    case 0:
      return 0.2F + 0.8F * ratio;
    case 1:
      return 0.2F + 0.8F * std::sin(kPi * ratio);
    case 2:
      return 0.2F + 0.8F * std::sin(0.5F * kPi * ratio);
    case 3:
      return 1;
    case 4:
      return 0.5F + 0.5F * ratio;
    case 5:
      return ratio <= 0.7F ? ratio / 0.7F : (1 - ratio) / 0.3F;
    case 6:
      return 1 - 0.8F * ratio;
    default:
      return 0.5F + 0.5F * (ratio <= 0.7F ? ratio / 0.7F : (1 - ratio) / 0.3F);
  }
}

Skeleton grow(const SpeciesParams& species, std::uint64_t seed) {
  check(species);
  return Grower(species, seed).run();
}

}  // namespace manzana::foliage
