#include "foliage/leaf_cloud.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "foliage/fill_colour.h"
#include "foliage/leaf_form.h"
#include "foliage/leaf_lines.h"
#include "foliage/leaf_points.h"
#include "foliage/leaf_scale.h"
#include "foliage/obb_cells.h"
#include "foliage/point_fit.h"
#include "foliage/point_shade.h"
#include "foliage/random.h"

namespace manzana::foliage {
namespace {

/// How much longer than a leaf an organ stays, as leaves are taken away. [Deussen 2005, section 10: visual importance]
std::uint64_t importance(Organ organ) { return organ == Organ::leaf ? 1 : 3; }

/// The best of so many draws: the order of such keys is a random one in which an organ that is three times as important
/// is three times as likely to come next. [Efraimidis and Spirakis, Weighted random sampling with a reservoir, 2006]
std::uint64_t random_key(std::uint64_t seed, std::uint64_t row, std::uint64_t weight) {
  std::uint64_t best = 0;
  for (std::uint64_t draw = 0; draw < weight; ++draw) best = std::max(best, hash(hash(seed, row), draw));
  return best;
}

/// Rows in the order of their keys, the greatest first.
std::vector<std::uint32_t> order_of(const std::vector<std::uint64_t>& keys) {
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] > keys[b]; });
  return order;
}

/// Fills a PreparedPlant from leaves, step by step.
class LeafCloud {
 public:
  LeafCloud(const Plant& plant, LeafQuads source, const PrepareOptions& options, PreparedPlant& ready)
      : plant_(plant), source_(std::move(source)), options_(options), ready_(ready), points_(ready.leaf_image) {}

  /// Shares of the work as they are for 131 000 leaves.
  void run(const Progress& progress) {
    if (source_.quads.empty()) return;
    make_cells();
    shuffle();
    tell(progress, 0.1);
    make_points();
    make_lines();
    tell(progress, 0.2);
    const LeafScaleFit fit = fit_leaf_scale(ready_, part_of(progress, 0.2, 0.7));
    ready_.leaf_scale = fit.scale;
    ready_.cover_m2 = fit.cover_m2;
    fit_points(ready_, part_of(progress, 0.7, 0.9));
    fit_point_shades(ready_, part_of(progress, 0.9, 1));
  }

 private:
  void make_cells() {
    std::vector<std::uint64_t> keys;
    for (std::size_t i = 0; i < source_.leaves.size(); ++i)
      keys.push_back(random_key(options_.seed, i, importance(plant_.terminals[i].organ)));
    for (std::vector<std::uint32_t>& cell : split_cells(source_, options_.quads_per_cell)) {
      std::stable_sort(cell.begin(), cell.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] > keys[b]; });
      append_cell(cell);
    }
  }

  void append_cell(const std::vector<std::uint32_t>& leaves) {
    const auto first = static_cast<std::uint32_t>(ready_.leaves.size());
    std::vector<Vec3d> corners;
    for (const std::uint32_t leaf : leaves) {
      for (std::uint32_t q = source_.leaves[leaf].first; q < source_.leaves[leaf].last; ++q) {
        for (const PlantQuad::Corner& corner : source_.quads[q].corners) corners.emplace_back(corner.position);
        ready_.leaves.push_back(source_.quads[q]);
        leaf_of_.push_back(leaf);
      }
    }
    const OrientedBox box = fit_box(corners);
    ready_.cells.push_back({box.centre, box.axes, box.half, {first, static_cast<std::uint32_t>(ready_.leaves.size())}});
  }

  Organ organ(std::uint32_t quad) const { return plant_.terminals[leaf_of_[quad]].organ; }

  /// Large quads first: they stay quads when most others are points.
  void shuffle() {
    double sum = 0;
    std::vector<double> areas;
    for (const PlantQuad& quad : ready_.leaves) areas.push_back(quad_area(quad)), sum += areas.back();
    mean_area_ = sum / static_cast<double>(areas.size());
    std::vector<std::uint64_t> keys;
    for (std::uint32_t quad = 0; quad < areas.size(); ++quad)
      keys.push_back(random_key(options_.seed + 1, quad, importance(organ(quad))));
    ready_.shuffled = order_of(keys);
    const auto large = [&](std::uint32_t quad) { return areas[quad] > kLarge * mean_area_; };
    const auto end = std::stable_partition(ready_.shuffled.begin(), ready_.shuffled.end(), large);
    ready_.large_quads = static_cast<std::uint32_t>(end - ready_.shuffled.begin());
  }

  void make_points() {
    PointCloud finest = large_points();
    ready_.large_points = static_cast<std::uint32_t>(finest.size());
    for (std::uint32_t i = ready_.large_quads; i < ready_.shuffled.size(); ++i) {
      const std::uint32_t quad = ready_.shuffled[i];
      const std::array<CloudPoint, 4> four = points_.four(ready_.leaves[quad], organ(quad));
      finest.insert(finest.end(), four.begin(), four.end());
    }
    append_level(finest);
    for (const PointCloud& level : merged_levels(finest)) append_level(level);
    ready_.leaf_area_m2 = 2 * ready_.point_levels[0].area;
  }

  /// From all large quads by turns, each in its own order.
  PointCloud large_points() {
    std::vector<std::pair<double, CloudPoint>> ranked;
    for (std::uint32_t i = 0; i < ready_.large_quads; ++i) {
      const std::uint32_t quad = ready_.shuffled[i];
      const PointCloud many = points_.many(ready_.leaves[quad], organ(quad), points_on(quad), hash(options_.seed, i));
      for (std::size_t k = 0; k < many.size(); ++k)
        ranked.emplace_back((static_cast<double>(k) + 0.5) / static_cast<double>(many.size()), many[k]);
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    PointCloud out;
    for (const auto& [rank, point] : ranked) out.push_back(point);
    return out;
  }

  std::uint32_t points_on(std::uint32_t quad) const {
    constexpr double kMost = 1024;
    return static_cast<std::uint32_t>(std::min(4 * quad_area(ready_.leaves[quad]) / mean_area_, kMost));
  }

  void append_level(const PointCloud& cloud) {
    const auto first = static_cast<std::uint32_t>(ready_.points.size());
    double sum = 0;
    for (const CloudPoint& point : cloud) {
      ready_.points.push_back(packed(point));
      sum += static_cast<double>(point.area);
    }
    ready_.point_levels.push_back({{first, static_cast<std::uint32_t>(ready_.points.size())}, static_cast<float>(sum)});
  }

  /// Where most of the leaves' area is of thin ones.
  void make_lines() {
    std::vector<LeafForm> forms;
    double all = 0, thin = 0;
    for (const Run& leaf : source_.leaves) {
      const auto quads = std::span(source_.quads).subspan(leaf.first, leaf.size());
      forms.push_back(leaf_form(quads, alpha_of(quads)));
      for (const PlantQuad& quad : quads) all += quad_area(quad), thin += forms.back().thin() ? quad_area(quad) : 0;
    }
    if (2 * thin <= all) return;
    std::vector<LineSegment> lines;
    for (const std::uint32_t quad : last_kept_first()) {
      const PlantQuad& of = ready_.leaves[quad];
      lines.push_back(leaf_line(of, forms[leaf_of_[quad]].axis, alpha_of(std::span(&of, 1))));
      lines.back().colour = colour_of(of);
    }
    add_leaf_lines(lines, ready_);
  }

  /// Quads by turns from all cells, those first that cells are the first to lose: so no leaf is both, on the way from
  /// quads to lines.
  std::vector<std::uint32_t> last_kept_first() const {
    std::vector<std::pair<double, std::uint32_t>> ranked;
    for (const LeafCell& cell : ready_.cells)
      for (std::uint32_t q = cell.quads.first; q < cell.quads.last; ++q)
        ranked.emplace_back((cell.quads.last - q - 0.5) / cell.quads.size(), q);
    std::sort(ranked.begin(), ranked.end());
    std::vector<std::uint32_t> order;
    for (const auto& [rank, quad] : ranked) order.push_back(quad);
    return order;
  }

  double leaf_area(const PlantQuad& quad) {
    double sum = 0;
    for (const CloudPoint& point : points_.four(quad, Organ::leaf)) sum += 2 * static_cast<double>(point.area);
    return sum;
  }

  /// Share of the quads that is leaf.
  double alpha_of(std::span<const PlantQuad> quads) {
    double leaf = 0, all = 0;
    for (const PlantQuad& quad : quads) leaf += leaf_area(quad), all += quad_area(quad);
    return all > 0 ? std::min(leaf / all, 1.0) : 0;
  }

  std::uint32_t colour_of(const PlantQuad& quad) {
    const std::array<CloudPoint, 4> four = points_.four(quad, Organ::leaf);
    const PointCloud cloud(four.begin(), four.end());
    const PointCloud one = merged(cloud, std::numeric_limits<float>::infinity());
    return one.empty() ? 0xff000000U : packed(one.front()).colour;
  }

  static constexpr double kLarge = 8;  // times the mean area of quads

  const Plant& plant_;
  const LeafQuads source_;
  const PrepareOptions& options_;
  PreparedPlant& ready_;
  QuadPoints points_;
  std::vector<std::uint32_t> leaf_of_;  // for each of ready_.leaves its terminal
  double mean_area_ = 0;
};

}  // namespace

void prepare_leaves(const Plant& plant, const PrepareOptions& options, PreparedPlant& ready) {
  LeafQuads source = leaf_quads(plant);
  fill_unused(ready.leaf_image, source.quads);  // first: all that is fitted must be to the picture that is drawn
  LeafCloud(plant, std::move(source), options, ready).run(options.progress);
  if (ready.leaves.empty()) ready.cover_m2 = fit_leaf_scale(ready).cover_m2;  // of branches alone
}

}  // namespace manzana::foliage
