#include "foliage/grove.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "foliage/random.h"

namespace manzana::foliage {
namespace {

constexpr std::uint32_t kMostPoints = 1U << (kGroveFits - 1);  // of a tree
constexpr double kFade = 0.3;  // of the points that are meant; half of it is beyond them
constexpr double kBeyond = 1 + kFade / 2;

constexpr float kTall = 4;  // times the median height

float height_of(const PreparedPlant& plant, const TreeSite& site) { return plant.height_m * site.height; }

/// Points for each m2 that trees cover: as many as the highest of them needs where it is just too large for a grove,
/// and of all the same, so that a herb's points are no larger than those of the grass round it.
double points_a_m2(std::span<const PreparedPlant> plants, std::span<const TreeSite> sites,
                   const GroveOptions& options) {
  float highest = 0;
  for (const TreeSite& site : sites) highest = std::max(highest, height_of(plants[site.plant], site));
  const double errors = options.none() / static_cast<double>(highest);
  return highest > 0 ? kBeyond * options.points * errors * errors : 0;
}

/// Mean over trees of that size; less than one: some have none, and others stand for them.
double mean_points(const PreparedPlant& plant, const TreeSite& site, double a_m2) {
  const double most = std::min(kMostPoints, plant.grove.points.size());
  return std::min(a_m2 * static_cast<double>(plant.cover_m2 * site.radius * site.height), most);
}

/// In [0, 1): trees of the same size are out of step.
double start_of(const TreeSite& site) { return static_cast<double>(hash(site.hash) >> 40) * 0x1p-24; }

std::uint32_t points_of(const TreeSite& site, double mean) {
  return static_cast<std::uint32_t>(std::max(0.0, std::ceil(mean - start_of(site))));
}

Vec3 turned(const TreeSite& site, const Vec3& v) {
  return {v.x * site.turn.x - v.y * site.turn.y, v.x * site.turn.y + v.y * site.turn.x, v.z};
}

/// `area`: of a tree of natural size.
LeafPoint placed(const LeafPoint& point, const TreeSite& site, float area) {
  const Vec3 size(site.radius, site.radius, site.height);
  LeafPoint out = point;
  out.position = site.position + turned(site, point.position * size);
  out.area = area * site.radius * site.height;
  const bool leaf = (point.normal & glsl::kGroveLeaf) != 0;
  const Vec3 normal = unpack_normal(point.normal);
  out.normal =
      pack_normal(glm::normalize(turned(site, leaf ? normal / size : normal * size))) | (leaf ? glsl::kGroveLeaf : 0);
  out.tree = site.hash;
  return out;
}

/// How much of a point of that rank is shown.
double weight(double meant, std::size_t rank) {
  return std::clamp((kBeyond * meant - static_cast<double>(rank)) / std::max(kFade * meant, 1.0), 0.0, 1.0);
}

struct Ranked {
  double key;
  LeafPoint point;
};

/// All keys of a tree are spread over [0, 1), those of different trees out of step.
void add_tree(const PreparedPlant& plant, const TreeSite& site, double mean, std::vector<Ranked>& all) {
  const GroveFit& fit = plant.grove;
  const std::vector<std::uint32_t> rows = chosen_points(fit, points_of(site, mean), site.hash >> 8);
  const auto area = static_cast<float>(fitted(fit.area, 0, mean) / mean);
  for (std::size_t j = 0; j < rows.size(); ++j)
    all.push_back({(static_cast<double>(j) + start_of(site)) / mean, placed(plant.points[rows[j]], site, area)});
}

double shown_area(std::span<const LeafPoint> points, double meant) {
  double sum = 0;
  for (std::size_t r = 0; r < points.size() && static_cast<double>(r) < kBeyond * meant; ++r)
    sum += weight(meant, r) * static_cast<double>(points[r].area);
  return sum;
}

/// By the angle.
template <class OfView>  // a number of (std::size_t view)
float at_view(double up, OfView&& of_view) {
  const double angle = std::asin(std::clamp(std::abs(up), 0.0, 1.0));
  return static_cast<float>(between_views(angle / (std::numbers::pi / 2) * (kGroveViews - 1), of_view));
}

double cover_at(const GroveRule& rule, const GroveSight& sight) {
  return static_cast<double>(rule.cover_m2 * at_view(sight.up, [&](std::size_t view) { return rule.cover[view]; }));
}

/// What others hide in part is drawn with fewer points, but not as few as their size would allow: large ones would make
/// the wood wider and higher.
double meant_at(const GroveRule& rule, const GroveSight& sight) {
  return rule.per_square * cover_at(rule, sight) / (sight.error_m * sight.error_m * sight.times);
}

/// Squares reach beyond the outline of a wood that they are spread over, and hide less of each other there: by how much
/// less they should cover. By a quarter of their side, measured; it would be half of it if a wood's outline were sharp.
double within_outline(const GroveSight& sight, double cover_m2, double square_m2) {
  const Vec2d& a = sight.outline_m;
  const double side = 0.5 * std::sqrt(square_m2), area = a.x * a.y, larger = (a.x + side) * (a.y + side);
  if (!(area > 0 && cover_m2 > 0)) return 1;
  const double covered = area * -std::expm1(-cover_m2 / area);
  return -larger * std::log1p(-covered / larger) / cover_m2;
}

double cover_of(const PreparedPlant& plant, const NaturalView& seen) {
  return seen.scale * between_views(seen.view, [&](std::size_t view) { return plant.grove.cover_m2[view]; });
}

/// What all trees' points should sum up to when so large a share of them is meant; what they cover, and that by what
/// they should be lighter.
struct Sum {
  double share, area = 0, light = 0, cover = 0;
};

void add_to(std::span<Sum> sums, const PreparedPlant& plant, const NaturalView& seen, double points) {
  if (points == 0) return;
  const double cover = cover_of(plant, seen);
  for (Sum& sum : sums) {
    const double n = sum.share * points;
    sum.area += seen.scale * fitted(plant.grove.area, seen.view, n);
    sum.light += cover * fitted(plant.grove.light, seen.view, n);
    sum.cover += cover;
  }
}

template <class AddTrees>  // void(std::size_t view, std::span<Sum>)
void fit_to_trees(GroveRule& rule, std::span<const LeafPoint> points, AddTrees&& add_trees) {
  if (points.empty()) return;
  const auto n = static_cast<double>(points.size());
  std::array<Sum, std::tuple_size_v<GroveRule::Table::value_type>> shares;
  for (std::size_t i = 0; i < shares.size(); ++i)
    shares[i].share = std::max(1.0, std::exp2(-static_cast<double>(i)) * n / kBeyond) / n;
  for (std::size_t view = 0; view < kGroveViews; ++view) {
    auto sums = shares;
    add_trees(view, sums);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      rule.worth[view][i] = static_cast<float>(sums[i].area / shown_area(points, n * sums[i].share) * sums[i].share);
      rule.light[view][i] = static_cast<float>(sums[i].light / sums[i].cover);
    }
  }
}

}  // namespace

std::vector<std::uint32_t> grove_rows(std::span<const PreparedPlant> plants, std::span<const TreeSite> sites,
                                      bool tall) {
  std::vector<float> heights;
  for (const TreeSite& site : sites) heights.push_back(height_of(plants[site.plant], site));
  if (heights.empty()) return {};
  std::vector<float> sorted = heights;
  const auto median = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), median, sorted.end());
  std::vector<std::uint32_t> rows;
  for (std::uint32_t row = 0; row < heights.size(); ++row)
    if ((heights[row] > kTall * *median) == tall) rows.push_back(row);
  return rows;
}

GroveRule grove_rule(std::span<const PreparedPlant> plants, std::span<const TreeSite> sites,
                     const GroveOptions& options) {
  GroveRule rule{.per_square = options.points};
  const double a_m2 = points_a_m2(plants, sites, options);
  std::array<double, kGroveViews> cover{};
  for (const TreeSite& site : sites) {
    const PreparedPlant& plant = plants[site.plant];
    rule.points += points_of(site, mean_points(plant, site, a_m2));
    rule.cover_m2 += plant.cover_m2 * site.radius * site.height;
    for (std::size_t view = 0; view < kGroveViews; ++view) cover[view] += cover_of(plant, natural_view(site, view));
  }
  for (std::size_t view = 0; view < kGroveViews && rule.cover_m2 > 0; ++view)
    rule.cover[view] = static_cast<float>(cover[view]) / rule.cover_m2;
  return rule;
}

Grove make_grove(std::span<const PreparedPlant> plants, std::span<const TreeSite> sites, std::uint32_t level,
                 const GroveOptions& options) {
  Grove grove{{}, grove_rule(plants, sites, options)};
  GroveRule& rule = grove.rule;
  const double a_m2 = points_a_m2(plants, sites, options);
  std::vector<Ranked> all;
  for (const TreeSite& site : sites)
    add_tree(plants[site.plant], site, mean_points(plants[site.plant], site, a_m2), all);
  std::stable_sort(all.begin(), all.end(), [](const Ranked& a, const Ranked& b) { return a.key < b.key; });
  for (const Ranked& ranked : all) grove.points.push_back(ranked.point);
  fit_to_trees(rule, grove.points, [&](std::size_t view, std::span<Sum> sums) {
    for (const TreeSite& site : sites)
      add_to(sums, plants[site.plant], natural_view(site, view), mean_points(plants[site.plant], site, a_m2));
  });
  grove.points.resize(points_at(rule.points, level));
  return grove;
}

GroveShown shown_of(const GroveRule& rule, const GroveSight& sight, std::uint32_t there) {
  if (there == 0) return {};
  const double all = rule.points, most = there / kBeyond,
               meant = std::clamp(meant_at(rule, sight), std::min(1.0, most), most),
               at = std::clamp(std::log2(all / kBeyond / meant), 0.0, static_cast<double>(rule.worth[0].size() - 1));
  const auto i = static_cast<std::size_t>(at), next = std::min(i + 1, rule.worth[0].size() - 1);
  const auto from = [&](const GroveRule::Table& table) {
    const auto t = static_cast<float>(at - static_cast<double>(i));
    return at_view(sight.up, [&](std::size_t view) { return std::lerp(table[view][i], table[view][next], t); });
  };
  const double cover = cover_at(rule, sight), within = within_outline(sight, cover, cover / meant);
  return {std::min(there, static_cast<std::uint32_t>(std::ceil(kBeyond * meant))), static_cast<float>(kBeyond * meant),
          static_cast<float>(std::max(kFade * meant, 1.0)), from(rule.worth) * static_cast<float>(within * all / meant),
          from(rule.light)};
}

std::uint32_t level_of(const GroveRule& rule, const GroveSight& sight) {
  const double needed = std::max(1.0, kBeyond * meant_at(rule, sight));
  return static_cast<std::uint32_t>(std::clamp(std::floor(std::log2(rule.points / needed)), 0.0, 20.0));
}

}  // namespace manzana::foliage
