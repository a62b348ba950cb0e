// Plants from model files, compared with what their generator knew: <name>.branches.json.
#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "foliage/import/gltf_files.h"
#include "foliage/import/gltf_materials.h"
#include "foliage/import/gltf_plant.h"
#include "foliage/import/gltf_triangles.h"
#include "tests/foliage/plant_checks.h"
#include "tests/support/data.h"

using namespace manzana;
using namespace manzana::foliage;

namespace {

constexpr const char* kTrees[] = {"ash_medium", "aspen_medium_modelled", "oak_dense", "oak_medium", "pine_medium"};

struct TrueBranch {
  int parent;
  float radius;
  std::vector<Vec3> line;
};

/// Place, in units of a thousandth, and which class: the id there.
using Place = std::array<std::int64_t, 4>;

struct Truth {
  tinygltf::Model model;
  std::vector<SourcePart> parts;
  std::vector<TrueBranch> branches;
  Vec3d foot{0};
  std::map<Place, std::set<int>> ids;
};

Place place(const Vec3d& p, bool leaf) {
  return {std::llround(p.x * 1000), std::llround(p.y * 1000), std::llround(p.z * 1000), leaf};
}

std::optional<Truth> read_truth(const std::string& name) {
  const auto file = data_file("trees/" + name + ".glb"), json = data_file("trees/" + name + ".branches.json");
  if (!file || !json) return std::nullopt;
  Truth out;
  out.model = load_gltf(read_file(*file), std::nullopt);
  out.parts = gltf_triangles(out.model);
  std::ifstream stream(*json);
  const auto known = nlohmann::json::parse(stream);
  for (const auto& b : known.at("branches")) {
    TrueBranch branch{b.at("parent"), b.at("radius"), {}};
    for (const auto& p : b.at("centreLine")) branch.line.emplace_back(p[0], -p[2].get<float>(), p[1]);
    out.branches.push_back(branch);
  }
  for (const SourcePart& part : out.parts)
    for (std::size_t i = 0; i < part.positions.size(); ++i)
      out.ids[place(part.positions[i], part.name == "leaves")].insert(part.branch_ids[i]);
  return out;
}

PlantReading assembled(const Truth& truth, bool with_ids) {
  std::vector<SourcePart> parts = truth.parts;
  if (!with_ids)
    for (SourcePart& part : parts) part.branch_ids.clear();
  return assemble_plant("tree", parts, gltf_materials(truth.model));
}

/// What the file has at a place, to a thousandth.
std::set<int> ids_at(const Truth& truth, const Vec3d& p, bool leaf) {
  std::set<int> out;
  for (int n = 0; n < 27; ++n) {
    const Vec3d near = p + Vec3d(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1) * 0.001;
    if (const auto found = truth.ids.find(place(near, leaf)); found != truth.ids.end())
      out.insert(found->second.begin(), found->second.end());
  }
  return out;
}

/// The ids that all three corners of a triangle have: at a place where branches meet a corner has several.
std::set<int> ids_of(const Truth& truth, const MeshPart& part, std::uint32_t triangle, const Vec3d& foot, bool leaf) {
  std::set<int> out;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3d p = Vec3d(part.vertices[part.indices[3 * triangle + k]].position) + foot;
    const std::set<int> here = ids_at(truth, p, leaf);
    if (k == 0) out = here;
    std::erase_if(out, [&](int id) { return here.count(id) == 0; });
  }
  return out;
}

Vec3d lowest(const Plant& plant, const Truth& truth) {
  Vec3d a(1e9), b(1e9);
  for (const SourcePart& part : truth.parts)
    for (const Vec3d& p : part.positions) a = glm::min(a, p);
  for (const MeshPart* part : {&plant.mesh.bark, &plant.mesh.leaves})
    for (const MeshVertex& v : part->vertices) b = glm::min(b, Vec3d(v.position));
  return a - b;
}

float distance_to(const std::vector<Vec3>& line, const Vec3& p) {
  float best = 1e9F;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec3 along = line[i + 1] - line[i];
    const float t = std::clamp(glm::dot(p - line[i], along) / std::max(glm::dot(along, along), 1e-12F), 0.0F, 1.0F);
    best = std::min(best, glm::length(p - line[i] - along * t));
  }
  return best;
}

/// A plant beside the truth: which ids each row stands for.
struct Comparison {
  const Truth& truth;
  Plant plant;
  Vec3d foot{0};
  std::vector<std::set<int>> ids;
  std::map<int, int> row_of;

  Comparison(const Truth& t, bool with_ids) : truth(t), plant(assembled(t, with_ids).plant) {
    foot = lowest(plant, truth);
    for (const Branch& b : plant.branches) {
      std::set<int>& here = ids.emplace_back();
      for (std::uint32_t i = b.triangles.first; i < b.triangles.last; ++i) {
        const auto own = ids_of(truth, plant.mesh.bark, i, foot, false);
        if (own.size() == 1) here.insert(*own.begin());
      }
      for (const int id : here) row_of[id] = static_cast<int>(ids.size()) - 1;
    }
  }

  const TrueBranch& branch(int id) const { return truth.branches.at(static_cast<std::size_t>(id)); }

  /// A row is a branch and what goes on from its tip without a seam; the first of them tells the parent.
  std::size_t parents_right() const {
    std::size_t right = 0;
    for (std::size_t row = 0; row < ids.size(); ++row) {
      const int parent = branch(*ids[row].begin()).parent;
      right += plant.branches[row].parent == (parent < 0 ? -1 : row_of.at(parent));
    }
    return right;
  }

  /// Of all centre points, the largest distance from the true line, in radii.
  float worst_centre() const {
    float worst = 0;
    for (std::size_t row = 0; row < ids.size(); ++row) {
      for (std::uint32_t i = plant.branches[row].line.first; i < plant.branches[row].line.last; ++i) {
        float best = 1e9F;
        for (const int id : ids[row])
          best = std::min(
              best, distance_to(branch(id).line, plant.centre_lines[i].position + Vec3(foot)) / branch(id).radius);
        worst = std::max(worst, best);
      }
    }
    return worst;
  }

  /// Relative error of the foot's radius; where a branch goes on from another's tip it has that one's radius.
  float worst_radius() const {
    float worst = 0;
    for (std::size_t row = 0; row < ids.size(); ++row) {
      const float truth_radius = branch(*ids[row].begin()).radius;
      worst = std::max(worst, std::abs(plant.centre_lines[plant.branches[row].line.first].radius / truth_radius - 1));
    }
    return worst;
  }

  double leaves_right() const {
    double right = 0;
    for (const Terminal& t : plant.terminals) {
      const auto has = ids_of(truth, plant.mesh.leaves, t.triangles.first, foot, true);
      const auto& carrier = ids.at(static_cast<std::size_t>(t.branch));
      right += std::any_of(has.begin(), has.end(), [&](int id) { return carrier.count(id) > 0; });
    }
    return right / static_cast<double>(plant.terminals.size());
  }
};

}  // namespace

TEST_CASE("branches of real trees hang where their generator hung them, with ids and without") {
  for (const std::string name : kTrees) {
    const auto truth = read_truth(name);
    if (!truth) return;
    for (const bool with_ids : {true, false}) {
      const Comparison found(*truth, with_ids);
      check_runs(found.plant);
      INFO(name << (with_ids ? " with ids: " : " without ids: ") << found.ids.size() << " branches, parents right "
                << found.parents_right() << ", centres off by " << found.worst_centre() << " radii, foot radii by "
                << found.worst_radius() << ", leaves right " << found.leaves_right());
      if (with_ids) CHECK(found.ids.size() == truth->branches.size());
      CHECK(found.parents_right() == found.ids.size());
      CHECK(found.worst_centre() < 0.1F);
      CHECK(found.leaves_right() >= (with_ids ? 1.0 : 0.9));
    }
  }
}
