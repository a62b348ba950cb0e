// The built-in town: a grid of streets, bent and jittered; a diagonal avenue; a river with bridges; a park with a pond;
// a wood; a square with a church. Dense and tall in the middle, houses with gardens at the rim. All of it is made of
// the same features as a file would give, so it takes the same way into the scene.
#include <array>
#include <cmath>
#include <utility>

#include "culling/hash.h"
#include "scenegraph/import/import.h"
#include "scenegraph/import/town_lots.h"
#include "scenegraph/import/tree_species.h"

namespace manzana {
namespace {

constexpr int kColumns = 17, kRows = 13;  // cells of the town as it is
constexpr int kRiverRow = 5;              // the cells that the river takes
constexpr int kBridgeEvery = 3;
constexpr double kPi = 3.14159265358979323846;
constexpr int kDiagonalColumn = 2;  // the avenue runs through the corners (k + 2, k)

struct CellRange {
  int i0, j0, i1, j1;
  bool holds(int i, int j) const { return i >= i0 && i < i1 && j >= j0 && j < j1; }
};
constexpr CellRange kPark{10, 7, 13, 9}, kWood{0, 9, 4, 13}, kSquare{7, 7, 8, 8};

struct Street {
  double width;
  int lanes;
  StreetClass kind;
};
constexpr Street kAvenue{15, 4, StreetClass::primary}, kQuay{10, 2, StreetClass::secondary},
    kLane{7, 2, StreetClass::residential}, kDiagonal{17, 4, StreetClass::primary};

int modulo(int i, int n) { return (i % n + n) % n; }
Street column_street(int i) { return modulo(i, 6) == 3 ? kAvenue : kLane; }
Street row_street(int j) { return j == kRiverRow || j == kRiverRow + 1 ? kQuay : modulo(j, 7) == 2 ? kAvenue : kLane; }

class Town {
 public:
  /// `times`: as large in area, by more houses all round.
  Town(std::uint64_t seed, double times) : seed_(seed) {
    city_.frame = LocalFrame({41.65, -0.88, 0});
    const double wider = (std::sqrt(times) - 1) / 2;
    const int columns = static_cast<int>(std::lround(kColumns * wider)),
              rows = static_cast<int>(std::lround(kRows * wider));
    all_ = {-columns, -rows, kColumns + columns, kRows + rows};
  }
  CityFeatures build() {
    streets();
    river();
    park();
    wood();
    square();
    constexpr CellRange kTown{0, 0, kColumns, kRows};
    for (int j = kTown.j0; j < kTown.j1; ++j)
      for (int i = kTown.i0; i < kTown.i1; ++i) cell(i, j);
    for (int j = all_.j0; j < all_.j1; ++j)
      for (int i = all_.i0; i < all_.i1; ++i)
        if (!kTown.holds(i, j)) cell(i, j);
    return std::move(city_);
  }

 private:
  std::int64_t node(int i, int j) const { return 1 + i + 1000 * j; }

  Vec2d corner(int i, int j) const {
    const double x = (i - kColumns / 2.0) * 98, y = (j - kRows / 2.0) * 90 + (j > kRiverRow ? -12 : 0);
    const auto jitter = [&](int axis) {
      return 10 * hash_unit(seed_ + 7, static_cast<std::uint64_t>(node(i, j) * 2 + axis)) - 5;
    };
    return {x + 34 * std::sin(y / 310 + 1) + 11 * std::sin(x / 140 + y / 200) + jitter(0),
            y + 30 * std::sin(x / 390 + 2) + 9 * std::sin(x / 170 - y / 150) + jitter(1)};
  }

  bool open(int i, int j) const { return kPark.holds(i, j) || kWood.holds(i, j); }

  // A stretch of street between neighbouring corners is missing inside the park and the wood, and over the river but
  // where there is a bridge.
  bool column_gap(int i, int j) const {
    return (open(i - 1, j) && open(i, j)) || (j == kRiverRow && modulo(i, kBridgeEvery) != 0);
  }
  bool row_gap(int i, int j) const { return open(i, j - 1) && open(i, j); }

  void add_street(const Street& s, std::vector<std::pair<int, int>> corners, bool bridge, const std::string& where) {
    if (corners.size() < 2) return;
    StreetFeature f;
    f.where = where;
    f.width = s.width;
    f.lanes = s.lanes;
    f.kind = s.kind;
    f.bridge = bridge;
    f.layer = bridge ? 1 : 0;
    for (const auto& [i, j] : corners) {
      f.line.push_back(corner(i, j));
      f.nodes.push_back(node(i, j));
    }
    city_.streets.push_back(std::move(f));
  }

  // One line of the grid, from k0 to k1: broken at gaps, with bridges as streets of their own.
  template <class Gap, class Corner>
  void line(const Street& s, int k0, int k1, const std::string& where, Gap gap, Corner at) {
    std::vector<std::pair<int, int>> run{at(k0)};
    for (int k = k0; k < k1; ++k) {
      const bool bridge = over_river(at(k), at(k + 1));
      if (gap(k) || bridge) add_street(s, std::exchange(run, {}), false, where);
      if (bridge && !gap(k)) add_street(s, {at(k), at(k + 1)}, true, where + ", bridge");
      if (gap(k) || bridge)
        run = {at(k + 1)};
      else
        run.push_back(at(k + 1));
    }
    add_street(s, run, false, where);
  }
  static bool over_river(std::pair<int, int> a, std::pair<int, int> b) {
    return a.second == kRiverRow && b.second == kRiverRow + 1;
  }

  void streets() {
    for (int i = all_.i0; i <= all_.i1; ++i)
      line(
          column_street(i), all_.j0, all_.j1, "column " + std::to_string(i), [&](int j) { return column_gap(i, j); },
          [&](int j) { return std::pair(i, j); });
    for (int j = all_.j0; j <= all_.j1; ++j)
      line(
          row_street(j), all_.i0, all_.i1, "row " + std::to_string(j), [&](int i) { return row_gap(i, j); },
          [&](int i) { return std::pair(i, j); });
    line(
        kDiagonal, all_.j0, all_.j1, "diagonal avenue", [](int) { return false; },
        [](int k) { return std::pair(k + kDiagonalColumn, k); });
    avenue_trees();
  }

  // One species for each street, on both sides of everything wider than a lane.
  void avenue_trees() {
    for (std::size_t s = 0; s < city_.streets.size(); ++s) {
      const StreetFeature& street = city_.streets[s];
      if (street.width <= kLane.width || street.bridge) continue;
      for (std::size_t k = 0; k + 1 < street.line.size(); ++k)
        for (const double side : {-1.0, 1.0})
          tree_row(street.line[k], street.line[k + 1], side * (street.width / 2 + 1.2),
                   species_for(PlantKind::broadleaf, TreePlace::row, hash_bits(seed_ + 12, s)));
    }
  }
  void tree_row(const Vec2d& a, const Vec2d& b, double offset, PlantSpecies species) {
    const Vec2d d = glm::normalize(b - a), n{-d.y, d.x};
    const double clear = 17;  // of junctions
    for (double s = clear; s < glm::length(b - a) - clear; s += 11) tree(a + s * d + offset * n, 9, 13, species);
  }
  void tree(const Vec2d& p, double low, double high, PlantSpecies species) {
    const double u = hash_unit(seed_ + 11, city_.trees.size());
    city_.trees.push_back(free_tree(p, low + (high - low) * u, species));
  }

  void area(const std::string& where, std::vector<Vec2d> outer, Material kind, double trees_per_ha = 0,
            bool mixed = false) {
    city_.areas.push_back({where, {std::move(outer), {}}, kind, trees_per_ha, PlantKind::broadleaf, mixed});
  }

  void river() {
    std::vector<Vec2d> north, south;
    for (int i = all_.i0 - 4; i <= all_.i1 + 4; ++i) {
      const Vec2d a = corner(i, kRiverRow), b = corner(i, kRiverRow + 1);
      const Vec2d middle = (a + b) / 2.0, half = glm::normalize(b - a) * 19.0;
      north.push_back(middle + half);
      south.push_back(middle - half);
    }
    north.insert(north.end(), south.rbegin(), south.rend());
    area("river", std::move(north), Material::water);
  }

  std::vector<Vec2d> range_outline(const CellRange& r, double inset) const {
    std::vector<Vec2d> ring;
    for (int i = r.i0; i < r.i1; ++i) ring.push_back(corner(i, r.j0));
    for (int j = r.j0; j < r.j1; ++j) ring.push_back(corner(r.i1, j));
    for (int i = r.i1; i > r.i0; --i) ring.push_back(corner(i, r.j1));
    for (int j = r.j1; j > r.j0; --j) ring.push_back(corner(r.i0, j));
    return inset_ring(ring, std::vector<double>(ring.size(), inset));
  }

  void park() {
    area("park", range_outline(kPark, 11), Material::park, 90, true);
    const Vec2d c = corner(12, 8) + Vec2d(-60, 12);
    std::vector<Vec2d> pond;
    for (int k = 0; k < 28; ++k) {
      const double a = 2 * kPi * k / 28;
      pond.push_back(c + Vec2d(std::cos(a) * (38 + 7 * std::sin(3 * a)), std::sin(a) * (24 + 4 * std::cos(2 * a))));
    }
    area("pond", std::move(pond), Material::water);
    path("park walk", {corner(kPark.i0, kPark.j0), corner(11, 8) + Vec2d(0, -20), corner(kPark.i1, kPark.j1)});
    path("park walk", {corner(kPark.i0, kPark.j1), corner(11, 8) + Vec2d(0, -20), corner(kPark.i1, kPark.j0)});
  }
  void path(const std::string& where, std::vector<Vec2d> points) {
    StreetFeature f;
    f.where = where;
    f.kind = StreetClass::path;
    f.width = 2.5;
    f.lanes = 1;
    for (std::size_t k = 0; k < points.size(); ++k)
      f.nodes.push_back(-1 - static_cast<std::int64_t>(city_.streets.size() * 100 + k));
    f.line = std::move(points);
    city_.streets.push_back(std::move(f));
  }

  void wood() { area("wood", range_outline(kWood, 9), Material::wood, 230, true); }

  void square() {
    area("square", range_outline(kSquare, 7), Material::pavement);
    const Vec2d c = (corner(7, 7) + corner(8, 8)) / 2.0 + Vec2d(0, 6);
    const Vec2d d = glm::normalize(corner(8, 7) - corner(7, 7));
    add_building("church, nave", rectangle(c, d, 34, 14), 0, 16, 1, RoofShape::gabled, 7, 0xcdbf9f, 0x7a4a3a);
    add_building("church, tower", rectangle(c - 21.5 * d, d, 9, 9), 0, 46, 5, RoofShape::pyramidal, 17, 0xcdbf9f,
                 0x4d5a58);
    add_building("church, choir", rectangle(c + 20.0 * d, d, 6, 9), 0, 13, 1, RoofShape::hipped, 4, 0xcdbf9f, 0x7a4a3a);
    for (const double side : {-1.0, 1.0})
      for (int k = -2; k <= 2; ++k)
        tree(c + d * (12.0 * k) + Vec2d(-d.y, d.x) * (side * 22), 10, 13, PlantSpecies::palm);
  }

  void add_building(std::string where, std::vector<Vec2d> ring, double min_height, double height, int levels,
                    RoofShape roof, double roof_height, std::uint32_t wall, std::uint32_t roof_rgb) {
    city_.buildings.push_back(
        {std::move(where), {std::move(ring), {}}, height, min_height, roof_height, levels, roof, wall, roof_rgb});
  }

  // The faces of a cell: one, or two where the diagonal avenue cuts it.
  void cell(int i, int j) {
    if (open(i, j) || j == kRiverRow || kSquare.holds(i, j)) return;
    const double south = row_street(j).width, north = row_street(j + 1).width;
    const double west = column_street(i).width, east = column_street(i + 1).width;
    const Vec2d sw = corner(i, j), se = corner(i + 1, j), ne = corner(i + 1, j + 1), nw = corner(i, j + 1);
    if (i - kDiagonalColumn == j) {
      block(i, j, {sw, se, ne}, {south, east, kDiagonal.width});
      block(i, j, {sw, ne, nw}, {kDiagonal.width, north, west});
    } else {
      block(i, j, {sw, se, ne, nw}, {south, east, north, west});
    }
  }

  void block(int i, int j, const std::vector<Vec2d>& corners, std::vector<double> widths) {
    for (double& w : widths) w = front(w);
    const std::vector<Vec2d> ring = inset_ring(corners, widths);
    if (ring.size() < 3) return;
    Vec2d middle{0, 0};
    for (const Vec2d& p : ring) middle += p / static_cast<double>(ring.size());
    LotStyle style = style_at(glm::length(middle - corner(8, 7)));
    style.seed =
        hash_bits(seed_, static_cast<std::uint64_t>(city_.buildings.size() * 64 + static_cast<std::size_t>(i + j)));
    fill_block(ring, style, city_);
  }

  // From the middle of a street to the fronts along it: they stand where its pavement ends.
  static double front(double width) {
    return width / 2 + (width >= kAvenue.width ? 2.4 : width >= kQuay.width ? 2.1 : 1.7);
  }

  static LotStyle style_at(double to_centre) {
    if (to_centre < 330) return {LotKind::perimeter, 4, 7, 0};
    if (to_centre < 560) return {LotKind::rows, 3, 4, 0};
    return {LotKind::houses, 1, 2, 0};
  }

  std::uint64_t seed_;
  CellRange all_{};
  CityFeatures city_;
};

}  // namespace

CityFeatures make_town(std::uint64_t seed, double times) { return Town(seed, times).build(); }

}  // namespace manzana
