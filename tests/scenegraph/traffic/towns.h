#pragma once
/// Street graphs made by hand, and their traffic.
#include "scenegraph/import/build_traffic.h"

struct Town {
  manzana::StreetGraph graph;
  std::vector<std::uint32_t> half_street_blocks;
  std::uint32_t blocks = 1;
};

/// Streets are added one by one; junctions are points in plan that are equal.
class TownMaker {
 public:
  /// The line's ends are junctions.
  void street(std::vector<manzana::Vec3d> line, bool one_way = false, double width = 7,
              manzana::StreetClass kind = manzana::StreetClass::residential);
  /// Half-streets are dealt to `blocks` blocks in turn.
  Town done(std::uint32_t blocks = 1);

 private:
  std::uint32_t junction(const manzana::Vec3d& p);
  Town town_;
};

/// nx x ny junctions, `step` metres apart, shaken by up to `shake` metres; a diagonal avenue on top that cuts through
/// the blocks it meets at junctions, every `one_way`-th line one-way, dead ends along the rim.
Town grid_town(int nx, int ny, double step, double shake, int one_way, std::uint64_t seed);

/// Anything goes: junctions anywhere, edges between near ones, of all lengths, widths and angles, crossing each other.
Town wild_town(int junctions, double size, std::uint64_t seed);

manzana::Traffic traffic_of(const Town& town, const manzana::TrafficOptions& options = {});
