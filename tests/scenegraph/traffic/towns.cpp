#include "towns.h"

#include <algorithm>
#include <cmath>

#include "culling/hash.h"

using namespace manzana;

std::uint32_t TownMaker::junction(const Vec3d& p) {
  auto& all = town_.graph.junctions;
  const auto same = std::find_if(all.begin(), all.end(), [&](const Junction& j) { return j.position == p; });
  const auto id = static_cast<std::uint32_t>(same - all.begin());
  if (id == all.size()) all.push_back({p, {}});
  return id;
}

void TownMaker::street(std::vector<Vec3d> line, bool one_way, double width, StreetClass kind) {
  StreetFeature feature;
  feature.width = width;
  feature.kind = kind;
  feature.one_way = one_way;
  StreetEdge edge;
  edge.from = junction(line.front());
  edge.to = junction(line.back());
  for (std::size_t i = 1; i < line.size(); ++i) edge.length += glm::distance(Vec2d(line[i - 1]), Vec2d(line[i]));
  edge.points = std::move(line);
  edge.street = static_cast<std::uint32_t>(town_.graph.streets.size());
  const auto id = static_cast<std::uint32_t>(town_.graph.edges.size());
  town_.graph.junctions[edge.from].edges.push_back(id);
  town_.graph.junctions[edge.to].edges.push_back(id);
  town_.graph.streets.push_back(std::move(feature));
  town_.graph.edges.push_back(std::move(edge));
}

Town TownMaker::done(std::uint32_t blocks) {
  town_.blocks = blocks;
  for (std::uint32_t h = 0; h < 2 * town_.graph.edges.size(); ++h) town_.half_street_blocks.push_back(h % blocks);
  return std::move(town_);
}

Town grid_town(int nx, int ny, double step, double shake, int one_way, std::uint64_t seed) {
  const auto at = [&](int x, int y) {
    const auto id = std::uint64_t(x * 10007 + y);
    const double dx = hash_unit(seed, 2 * id) - 0.5, dy = hash_unit(seed, 2 * id + 1) - 0.5;
    return Vec3d((x - nx / 2) * step + shake * 2 * dx, (y - ny / 2) * step + shake * 2 * dy, 0);
  };
  const auto is_one_way = [&](int line) { return one_way > 0 && line % one_way == 1; };
  const auto kind = [](int line) { return line % 5 == 2 ? StreetClass::primary : StreetClass::residential; };
  const auto width = [](int line) { return line % 5 == 2 ? 14.0 : 6.0; };
  TownMaker maker;
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y) {
      if (x + 1 < nx) maker.street({at(x, y), at(x + 1, y)}, is_one_way(y), width(y), kind(y));
      if (y + 1 < ny) maker.street({at(x, y), at(x, y + 1)}, is_one_way(x), width(x), kind(x));
      if (x + 1 < nx && y + 1 < ny && x == y)
        maker.street({at(x, y), at(x + 1, y + 1)}, false, 8, StreetClass::secondary);
      if (y == 0 && x % 3 == 1) maker.street({at(x, 0), at(x, 0) + Vec3d(20, -45, 0), at(x, 0) + Vec3d(60, -50, 0)});
    }
  return maker.done(std::uint32_t(std::max(1, (nx - 1) * (ny - 1))));
}

Town wild_town(int junctions, double size, std::uint64_t seed) {
  TownMaker maker;
  std::vector<Vec3d> at;
  std::uint64_t n = 0;
  const auto unit = [&] { return hash_unit(seed, ++n); };
  for (int j = 0; j < junctions; ++j) at.push_back({size * unit(), size * unit(), 0});
  for (std::size_t j = 0; j < at.size(); ++j) {
    std::vector<Vec3d> near = at;
    std::sort(near.begin(), near.end(),
              [&](const Vec3d& a, const Vec3d& b) { return glm::distance(a, at[j]) < glm::distance(b, at[j]); });
    for (std::size_t k = 1; k < std::min<std::size_t>(near.size(), 4); ++k) {
      if (unit() < 0.4) continue;
      const Vec3d middle = (at[j] + near[k]) * 0.5 + Vec3d(unit() - 0.5, unit() - 0.5, 0) * 10.0;
      const auto kind = static_cast<StreetClass>(1 + int(3 * unit()));
      std::vector<Vec3d> line{at[j], near[k]};
      if (unit() < 0.5) line.insert(line.begin() + 1, middle);
      maker.street(line, unit() < 0.25, 3 + 12 * unit(), kind);
    }
  }
  return maker.done(std::uint32_t(std::max(1, junctions / 2)));
}

Traffic traffic_of(const Town& town, const TrafficOptions& options) {
  return build_traffic(LocalFrame({60.17, 24.94, 0}), town.graph, town.half_street_blocks, town.blocks, options);
}
