#include "foliage/import/classify_triangles.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "foliage/import/pieces.h"
#include "foliage/import/tube_shape.h"

namespace manzana::foliage {
namespace {

bool has_word(std::string_view name, std::span<const std::string_view> words) {
  std::string lower(name);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return std::any_of(words.begin(), words.end(), [&](auto word) { return lower.find(word) != std::string::npos; });
}

struct Told {
  PlantPart part;
  Reason reason;
};

/// By what the part says of itself alone.
std::optional<Told> told_by_file(const SourcePart& part, const SourceMaterial* material) {
  if (part.told) return Told{*part.told, Reason::extras};
  if (material != nullptr) {
    if (material->told) return Told{*material->told, Reason::extras};
    if (const auto named = part_by_name(material->name)) return Told{*named, Reason::material};
    if (material->cut_out) return Told{PlantPart::leaf, Reason::alpha};
  }
  if (const auto named = part_by_name(part.name)) return Told{*named, Reason::name};
  return std::nullopt;
}

std::vector<std::optional<Told>> told_parts(std::span<const SourcePart> parts,
                                            std::span<const SourceMaterial> materials) {
  std::vector<std::optional<Told>> told;
  bool ids = false, none = false;
  for (const SourcePart& part : parts) {
    told.push_back(
        told_by_file(part, part.material < 0 ? nullptr : &materials[static_cast<std::size_t>(part.material)]));
    (part.branch_ids.empty() ? none : ids) = true;
  }
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!told[i] && ids && none)
      told[i] = Told{parts[i].branch_ids.empty() ? PlantPart::leaf : PlantPart::branch, Reason::branch_ids};
  return told;
}

/// Nothing for what is neither: crowns drawn as balls and cones, forked surfaces. Measured on real models: cards and
/// flat leaves, crossed ones too, have a roundness up to 0.3, tubes from 0.57; tubes are slender from 10, balls up
/// to 7.
std::optional<PlantPart> part_by_shape(const TubeShape& shape) {
  constexpr float kRound = 0.5F, kFlat = 0.35F, kSlender = 8, kStub = 3;
  if (shape.roundness < kFlat) return PlantPart::leaf;
  if (shape.roundness < kRound) return std::nullopt;
  if (shape.slenderness > kSlender || (shape.openings > 1 && shape.slenderness > kStub)) return PlantPart::branch;
  return std::nullopt;
}

bool is_green(const Image& image, const Vec2& uv) {
  const auto at = [&](float v) {
    return static_cast<std::size_t>(
        std::clamp(static_cast<int>((v - std::floor(v)) * static_cast<float>(image.size)), 0, image.size - 1));
  };
  const std::uint8_t* p = &image.rgba[4 * (at(uv.y) * static_cast<std::size_t>(image.size) + at(uv.x))];
  return p[1] > p[0] && p[1] > p[2];
}

class Classifier {
 public:
  Classifier(const TriangleList& triangles, std::span<const SourcePart> parts,
             std::span<const SourceMaterial> materials, const std::function<const Image&(int)>& image)
      : list_(triangles), parts_(parts), image_(image), told_(told_parts(parts, materials)) {
    for (const Vec3& p : list_.positions) height_ = std::max(height_, p.z);
    out_.part.resize(list_.source.size());
  }

  Classified run() {
    const Pieces pieces = connected_pieces(list_.joined, list_.source);
    std::vector<std::span<const std::uint32_t>> unsure;
    for (std::size_t p = 0; p < pieces.count(); ++p) {
      const auto piece = pieces.of(p);
      const auto& told = told_[list_.source[piece[0]]];
      if (told)
        set(piece, *told);
      else if (const auto part = part_by_shape(tube_shape(list_.positions, list_.joined, piece)))
        set(piece, {*part, Reason::shape});
      else
        unsure.push_back(piece);
    }
    const bool leaves = leaves_;
    const std::set<int> coloured = green_materials(unsure);
    for (const auto piece : unsure) {
      if (coloured.count(material_of(piece)) > 0)
        by_colour(piece);
      else
        set(piece, {leaves || on_ground(piece) ? PlantPart::branch : PlantPart::leaf, Reason::rest});
    }
    return std::move(out_);
  }

 private:
  void set(std::span<const std::uint32_t> triangles, const Told& told) {
    for (const std::uint32_t t : triangles) out_.part[t] = told.part;
    const bool branch = told.part == PlantPart::branch;
    (branch ? out_.taken.branch : out_.taken.terminal)[static_cast<std::size_t>(told.reason)] += triangles.size();
    leaves_ = leaves_ || (!branch && !triangles.empty());
  }

  using Triangles = std::span<const std::uint32_t>;

  int material_of(Triangles piece) const { return parts_[list_.source[piece[0]]].material; }
  bool green(std::uint32_t t, int material) const { return is_green(image_(material), middle_uv(t)); }

  /// Those in which something is green: there, what is not green is no leaf.
  std::set<int> green_materials(const std::vector<Triangles>& pieces) const {
    std::set<int> out;
    for (const Triangles piece : pieces) {
      const int material = material_of(piece);
      if (std::any_of(piece.begin(), piece.end(), [&](std::uint32_t t) { return green(t, material); }))
        out.insert(material);
    }
    return out;
  }

  void by_colour(Triangles piece) {
    std::vector<std::uint32_t> leaf, other;
    for (const std::uint32_t t : piece) (green(t, material_of(piece)) ? leaf : other).push_back(t);
    set(leaf, {PlantPart::leaf, Reason::colour});
    set(other, {PlantPart::branch, Reason::colour});
  }

  bool on_ground(std::span<const std::uint32_t> piece) const {
    constexpr float kGround = 0.02F;  // of the height
    return std::any_of(piece.begin(), piece.end(), [&](std::uint32_t t) {
      return list_.positions[list_.corners[3 * std::size_t{t}]].z <= kGround * height_;
    });
  }

  Vec2 middle_uv(std::uint32_t t) const {
    Vec2 sum(0);
    for (std::size_t k = 0; k < 3; ++k) sum += list_.uvs[list_.corners[3 * std::size_t{t} + k]];
    return sum / 3.0F;
  }

  const TriangleList& list_;
  std::span<const SourcePart> parts_;
  const std::function<const Image&(int)>& image_;
  std::vector<std::optional<Told>> told_;
  float height_ = 0;
  bool leaves_ = false;
  Classified out_;
};

}  // namespace

std::optional<PlantPart> part_by_name(std::string_view name) {
  static constexpr std::array<std::string_view, 4> kFlower{"flower", "blossom", "petal", "catkin"};
  static constexpr std::array<std::string_view, 3> kFruit{"fruit", "berry", "acorn"};
  static constexpr std::array<std::string_view, 6> kLeaf{"leaf", "leaves", "foliage", "needle", "frond", "crown"};
  static constexpr std::array<std::string_view, 6> kBranch{"bark", "branch", "trunk", "wood", "stem", "pot"};
  if (has_word(name, kFlower)) return PlantPart::flower;
  if (has_word(name, kFruit)) return PlantPart::fruit;
  if (has_word(name, kLeaf)) return PlantPart::leaf;
  if (has_word(name, kBranch)) return PlantPart::branch;
  return std::nullopt;
}

Classified classify_triangles(const TriangleList& triangles, std::span<const SourcePart> parts,
                              std::span<const SourceMaterial> materials,
                              const std::function<const Image&(int material)>& image) {
  return Classifier(triangles, parts, materials, image).run();
}

}  // namespace manzana::foliage
