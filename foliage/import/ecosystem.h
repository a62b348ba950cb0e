#pragma once
/// Plants and other ecosystems, placed, and so on inward: a meadow of clumps of herbs. Kept as it is written, each file
/// and each plant once, and flattened only where somebody looks.  [Deussen 2005, section 10: nested instances]
///   const Ecosystem meadow = read_ecosystem("meadow.json");
///   each_plant(meadow, [&](std::uint32_t node, const Placement& at) { return may_be_seen(balls[node], at); },
///              [&](std::uint32_t plant, const Placement& at) { draw(plant, at); });
/// The file is JSON; files are named from the first file's folder, and lie in it or below it:
///   {"instances": [{"plant": "herb.json#herb", "at": [1.5, 2], "turn": 40, "scale": 1.2},
///                  {"ecosystem": "clump.json", "scatter": {"count": 500, "radius": 30, "seed": 7}}]}
/// "at": metres east and north, and up if there are three. "scatter": spread evenly over a disk round "at", each turned
/// anyhow.
#include <cstdint>
#include <filesystem>
#include <vector>

#include "foliage/import/load_plant.h"

namespace manzana::foliage {

/// Scaled, turned about z (counterclockwise from above), then moved.
struct Placement {
  Vec3d position{0};  ///< metres
  double turn = 0;    ///< radians
  double scale = 1;   ///< above 0
  Vec3d operator()(const Vec3d& p) const;
  Placement operator()(const Placement& inner) const;
};

struct EcosystemInstance {
  bool is_plant = true;
  std::uint32_t child = 0;  ///< of Ecosystem::plants, or of Ecosystem::nodes
  Placement at;
};

/// A file.
struct EcosystemNode {
  std::string file;
  Run instances;             ///< of Ecosystem::instances
  std::uint64_t placed = 0;  ///< plants and nodes within, flattened
};

/// Nodes come after those that they refer to; the last is the file that was read. Without cycles.
struct Ecosystem {
  std::vector<PlantSource> plants;
  std::vector<EcosystemInstance> instances;
  std::vector<EcosystemNode> nodes;
};

inline constexpr std::size_t kMaxEcosystemDepth = 64;
inline constexpr std::uint64_t kMaxPlaced = 16'000'000;  ///< plants and nodes, flattened

/// Throws std::runtime_error ("FILE: place: what is wrong"): files outside the folder, that refer to themselves, nested
/// deeper or with more in them than the limits. The plants' files are not read.
Ecosystem read_ecosystem(const std::filesystem::path& file);

/// Closed.
struct Ball {
  Vec3d centre{0};
  double radius = -1;  ///< below 0: empty
};

/// Of each node, about its own origin, from the plants' own.
std::vector<Ball> node_balls(const Ecosystem& ecosystem, const std::vector<Ball>& plants);

/// Every plant with its place, in the file's order. enter(node, placement): false leaves out the node and all within.
template <class Enter, class Visit>
void each_plant(const Ecosystem& ecosystem, Enter&& enter, Visit&& visit) {
  struct Open {
    std::uint32_t next, last;
    Placement at;
  };
  std::vector<Open> open;
  const auto begin = [&](std::uint32_t node, const Placement& at) {
    const Run& run = ecosystem.nodes[node].instances;
    if (enter(node, at)) open.push_back({run.first, run.last, at});
  };
  if (!ecosystem.nodes.empty()) begin(static_cast<std::uint32_t>(ecosystem.nodes.size()) - 1, {});
  while (!open.empty()) {
    if (open.back().next == open.back().last) {
      open.pop_back();
      continue;
    }
    const EcosystemInstance& instance = ecosystem.instances[open.back().next++];
    const Placement at = open.back().at(instance.at);
    instance.is_plant ? visit(instance.child, at) : begin(instance.child, at);
  }
}

}  // namespace manzana::foliage
