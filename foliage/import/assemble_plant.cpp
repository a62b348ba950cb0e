#include "foliage/import/assemble_plant.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "foliage/import/join_lines.h"
#include "foliage/import/nearest_branch.h"
#include "foliage/import/pieces.h"
#include "foliage/import/plant_image.h"
#include "foliage/import/tube_shape.h"
#include "foliage/simplify.h"

namespace manzana::foliage {
namespace {

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

/// Where the plant stands: the middle of what is within a twentieth of the height of the lowest point.
Vec3d foot_of(std::span<const SourcePart> parts) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const SourcePart& part : parts)
    for (const std::uint32_t i : part.indices)
      low = std::min(low, part.positions[i].z), high = std::max(high, part.positions[i].z);
  Vec3d least(HUGE_VAL), most(-HUGE_VAL);
  for (const SourcePart& part : parts) {
    for (const std::uint32_t i : part.indices) {
      if (part.positions[i].z > low + 0.05 * (high - low)) continue;
      least = glm::min(least, part.positions[i]);
      most = glm::max(most, part.positions[i]);
    }
  }
  return {0.5 * (least.x + most.x), 0.5 * (least.y + most.y), low};
}

/// Metres that floats can tell apart, and neither 0 nor without end.
void check_size(std::span<const SourcePart> parts, const Vec3d& foot) {
  double height = 0, radius = 0;
  for (const SourcePart& part : parts) {
    for (const std::uint32_t i : part.indices) {
      const Vec3d p = part.positions[i] - foot;
      height = std::max(height, p.z);
      radius = std::max(radius, std::hypot(p.x, p.y));
    }
  }
  const auto sensible = [](double v) { return v > 1e-6 && v < 1e6; };
  if (!sensible(height) || !sensible(radius))
    fail("a plant of " + std::to_string(height) + " m height and " + std::to_string(radius) + " m radius");
}

/// Copies triangles into one class, each vertex once for each shift of its texture coordinates.
class Collector {
 public:
  Collector(MeshPart& out, const TriangleList& list, std::span<const Vec3> normals)
      : out_(out), list_(list), normals_(normals) {}

  void add(std::uint32_t t) {
    const Vec2 shift = uv_shift(t);
    for (std::size_t k = 0; k < 3; ++k) out_.indices.push_back(vertex(list_.corners[3 * std::size_t{t} + k], shift));
  }

 private:
  /// Whole repeats taken off, so that the triangle's texture coordinates lie in [0, kUvRange]; steps of half the range,
  /// so that few vertices are split.
  Vec2 uv_shift(std::uint32_t t) const {
    constexpr float kStep = kUvRange / 2;
    const std::uint32_t* c = &list_.corners[3 * std::size_t{t}];
    const Vec2 low = glm::min(glm::min(list_.uvs[c[0]], list_.uvs[c[1]]), list_.uvs[c[2]]);
    return -glm::floor(low / kStep) * kStep;
  }

  std::uint32_t vertex(std::uint32_t i, const Vec2& shift) {
    const auto [found, added] =
        known_.try_emplace({i, shift.x, shift.y}, static_cast<std::uint32_t>(out_.vertices.size()));
    if (added) {
      const Vec2 uv = glm::clamp(list_.uvs[i] + shift, Vec2(0), Vec2(kUvRange));
      out_.vertices.push_back({list_.positions[i], normals_[i], uv});
    }
    return found->second;
  }

  MeshPart& out_;
  const TriangleList& list_;
  std::span<const Vec3> normals_;
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> known_;
};

/// The pictures of materials, each made when it is asked for.
class Images {
 public:
  explicit Images(std::span<const SourceMaterial> materials) : materials_(materials) {}

  const Image& of(int material) {
    constexpr std::size_t kMostMaterials = 64;
    const auto found = images_.find(material);
    if (found != images_.end()) return found->second;
    if (images_.size() >= kMostMaterials) fail("more than 64 materials");
    return images_
        .emplace(material, material < 0 ? plant_image(plain_picture(), {})
                                        : materials_[static_cast<std::size_t>(material)].image())
        .first->second;
  }

 private:
  std::span<const SourceMaterial> materials_;
  std::map<int, Image> images_;
};

class Assembler {
 public:
  Assembler(const std::string& name, std::span<const SourcePart> parts, std::span<const SourceMaterial> materials)
      : parts_(parts), images_(materials) {
    out_.plant.name = name;
    list_parts();
    Classified classified =
        classify_triangles(list_, parts, materials, [&](int m) -> const Image& { return images_.of(m); });
    part_ = std::move(classified.part);
    out_.taken = classified.taken;
  }

  PlantReading run() {
    Plant& plant = out_.plant;
    add_branches();
    add_terminals();
    plant.mesh = {welded(plant.mesh.bark), welded(plant.mesh.leaves)};
    CrownLight(plant.mesh.leaves).apply(plant.mesh);
    plant.bark_image = images_.of(widest(true));
    plant.leaf_image = images_.of(widest(false));
    return std::move(out_);
  }

 private:
  void list_parts() {
    const Vec3d foot = foot_of(parts_);
    check_size(parts_, foot);
    for (std::uint32_t s = 0; s < parts_.size(); ++s) {
      std::vector<std::uint32_t> place(parts_[s].positions.size(), kUnused);
      for (const std::uint32_t i : parts_[s].indices) {
        if (place[i] == kUnused) place[i] = listed(parts_[s], i, foot);
        list_.corners.push_back(place[i]);
      }
      list_.source.resize(list_.corners.size() / 3, s);
    }
    const std::vector<std::uint32_t> place = joined_by_place(list_.positions);
    for (const std::uint32_t c : list_.corners) list_.joined.push_back(place[c]);
  }

  std::uint32_t listed(const SourcePart& part, std::uint32_t i, const Vec3d& foot) {
    list_.positions.emplace_back(part.positions[i] - foot);
    list_.uvs.push_back(part.uvs[i]);
    normals_.push_back(part.normals[i]);
    ids_.push_back(part.branch_ids.empty() ? kNoId : part.branch_ids[i]);
    return static_cast<std::uint32_t>(list_.positions.size()) - 1;
  }

  std::int32_t id(std::uint32_t t) const { return ids_[list_.corners[3 * std::size_t{t}]]; }

  /// Lists of triangles that hang together and are of one kind.
  template <class Key>
  std::vector<std::vector<std::uint32_t>> pieces(bool branches, Key&& key) const {
    std::vector<std::uint32_t> triangles, corners, keys;
    for (std::uint32_t t = 0; t < part_.size(); ++t) {
      if ((part_[t] == PlantPart::branch) != branches) continue;
      triangles.push_back(t);
      keys.push_back(key(t));
      for (std::size_t k = 0; k < 3; ++k) corners.push_back(list_.joined[3 * std::size_t{t} + k]);
    }
    const Pieces found = connected_pieces(corners, keys);
    std::vector<std::vector<std::uint32_t>> out(found.count());
    for (std::size_t p = 0; p < out.size(); ++p)
      for (const std::uint32_t i : found.of(p)) out[p].push_back(triangles[i]);
    return out;
  }

  Run copied(Collector& collector, const MeshPart& part, std::span<const std::uint32_t> triangles) const {
    Run run;
    run.first = static_cast<std::uint32_t>(part.triangles());
    for (const std::uint32_t t : triangles) collector.add(t);
    run.last = static_cast<std::uint32_t>(part.triangles());
    return run;
  }

  void add_branches() {
    Plant& plant = out_.plant;
    const auto found = pieces(true, [&](std::uint32_t t) { return static_cast<std::uint32_t>(id(t)); });
    std::vector<std::vector<CentrePoint>> lines;
    for (const auto& piece : found) lines.push_back(tube_shape(list_.positions, list_.joined, piece).line);
    const JoinedLines tree = join_lines(lines);
    Collector collector(plant.mesh.bark, list_, normals_);
    for (std::size_t row = 0; row < tree.order.size(); ++row) {
      const std::uint32_t piece = tree.order[row];
      row_of_id_.try_emplace(id(found[piece][0]), static_cast<std::int32_t>(row));
      Branch branch{tree.parent[row], tree.level[row], {}, copied(collector, plant.mesh.bark, found[piece])};
      branch.line.first = static_cast<std::uint32_t>(plant.centre_lines.size());
      plant.centre_lines.insert(plant.centre_lines.end(), lines[piece].begin(), lines[piece].end());
      branch.line.last = static_cast<std::uint32_t>(plant.centre_lines.size());
      plant.branches.push_back(branch);
    }
  }

  void add_terminals() {
    Plant& plant = out_.plant;
    const LineTree tree(plant.branches, plant.centre_lines);
    Collector collector(plant.mesh.leaves, list_, normals_);
    const auto key = [&](std::uint32_t t) {
      return static_cast<std::uint32_t>(id(t)) * 4 + static_cast<std::uint32_t>(part_[t]);
    };
    for (const auto& piece : pieces(false, key)) {
      const PlantPart part = part_[piece[0]];
      const Organ organ = part == PlantPart::flower  ? Organ::flower
                          : part == PlantPart::fruit ? Organ::fruit
                                                     : Organ::leaf;
      plant.terminals.push_back({copied(collector, plant.mesh.leaves, piece), carrier(tree, piece), organ});
    }
  }

  /// The row of the branch that bears these triangles.
  std::int32_t carrier(const LineTree& tree, std::span<const std::uint32_t> piece) const {
    if (id(piece[0]) != kNoId)
      if (const auto row = row_of_id_.find(id(piece[0])); row != row_of_id_.end()) return row->second;
    if (out_.plant.branches.empty()) return -1;
    constexpr std::size_t kMostAsked = 16;
    LineTree::Found best;
    const std::size_t step = (piece.size() + kMostAsked - 1) / kMostAsked;
    for (std::size_t i = 0; i < piece.size(); i += step) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& a = corner(piece[i], k);
        for (const Vec3& place : {a, (a + corner(piece[i], (k + 1) % 3)) * 0.5F}) {
          const auto found = tree.nearest(place, false, [](std::uint32_t) { return true; });
          if (found.distance < best.distance) best = found;
        }
      }
    }
    return static_cast<std::int32_t>(best.branch);
  }

  const Vec3& corner(std::uint32_t t, std::size_t k) const {
    return list_.positions[list_.corners[3 * std::size_t{t} + k]];
  }

  /// The material that covers most of the branches, or of the rest; -1 without any.
  int widest(bool branches) const {
    std::map<int, float> areas{{-1, 0}};
    for (std::uint32_t t = 0; t < part_.size(); ++t)
      if ((part_[t] == PlantPart::branch) == branches)
        areas[parts_[list_.source[t]].material] +=
            glm::length(glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)));
    return std::max_element(areas.begin(), areas.end(), [](auto& a, auto& b) { return a.second < b.second; })->first;
  }

  static constexpr std::int32_t kNoId = -1;
  static constexpr std::uint32_t kUnused = ~0U;

  std::span<const SourcePart> parts_;
  Images images_;
  TriangleList list_;
  std::vector<Vec3> normals_;
  std::vector<std::int32_t> ids_;  // of vertices
  std::vector<PlantPart> part_;    // of triangles
  std::map<std::int32_t, std::int32_t> row_of_id_;
  PlantReading out_;
};

}  // namespace

PlantReading assemble_plant(const std::string& name, std::span<const SourcePart> parts,
                            std::span<const SourceMaterial> materials) {
  return Assembler(name, parts, materials).run();
}

}  // namespace manzana::foliage
