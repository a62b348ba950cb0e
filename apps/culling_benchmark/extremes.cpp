#include "apps/culling_benchmark/extremes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "culling/baselines/hard_cases.h"
#include "culling/baselines/naive.h"
#include "culling/baselines/peer.h"
#include "culling/baselines/touching.h"

namespace manzana::culling_benchmark {
namespace {

using namespace baselines;
using culling::BoxD;
using culling::ClipDepth;
using culling::ExactView;
using culling::View;

constexpr double kReach = 1e6;  // metres; no object is farther from the near face

double reach_of(const View& view) { return std::min(view.far_m, kReach); }

/// Half as large as a spread of radii from 5 to 80 m.
Vec3d half_size(Random& random) { return {random.in(5, 80), random.in(5, 80), random.in(5, 80)}; }

std::vector<BoxD> any_boxes(const ExactView& body, double reach, int n, Random& random) {
  std::vector<BoxD> boxes;
  for (int i = 0; i < n; ++i) {
    const Vec3d half = half_size(random);
    const double metres = reach * std::cbrt(random.unit());  // as many in each part of the volume
    const Vec3d at = body.eye + point_inside(body, random, metres) + random.direction() * random.in(0, 240);
    boxes.push_back({at - half, at + half});
  }
  return boxes;
}

std::vector<BoxD> touching_boxes(const ExactView& body, double reach, int n, Random& random) {
  std::vector<BoxD> boxes;
  while (boxes.size() < static_cast<std::size_t>(n)) {
    const Touch at = touch(body, random, 1 + static_cast<int>(random.below(3)), reach);
    const double depth = random.scale(1e-9, 1e-1);
    if (glm::length(at.point) < 2 * kReach) boxes.push_back(box_on(body, at, 2.0 * half_size(random), depth));
  }
  return boxes;
}

/// Each box a block of its own.
City city_of(const std::vector<BoxD>& boxes) {
  City city;
  city.boxes = boxes;
  for (const BoxD& box : boxes) {
    city.blocks.push_back({Vec2d(center(box)), box, enclosing_sphere(box)});
    city.first.push_back(static_cast<std::uint32_t>(city.first.size()));
    city.bounds = merge(city.bounds, box);
  }
  city.kinds.assign(boxes.size(), ObjectKind::building);
  city.triangles.assign(boxes.size(), 1);
  return city;
}

std::vector<bool> kept_by_bqr(const View& view, const std::vector<BoxD>& boxes) {
  const auto peer = find_peer("bqr")->make(city_of(boxes));
  Answer answer;
  peer->query(make_frustum(view), answer);
  std::vector<bool> kept(boxes.size());
  for (const std::uint32_t row : taken(*peer, answer)) kept[row] = true;
  return kept;
}

void count(ExtremesRow& row, const ExactView& truth, const std::vector<BoxD>& boxes, const std::vector<bool>& seen,
           const std::vector<bool>& kept) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    ++row.asked;
    row.seen += seen[i] ? 1U : 0U;
    row.falsely_kept += kept[i] && !seen[i] ? 1U : 0U;
    if (kept[i] || !seen[i]) continue;
    ++row.missed;
    row.deepest_missed_m = std::max(row.deepest_missed_m, reach_into(truth, boxes[i]));
  }
}

void count(FarRow& row, double found_m) {
  ++row.cameras;
  if (!std::isfinite(found_m)) {
    ++row.without;
    return;
  }
  row.inward_m = std::max(row.inward_m, row.far_m - found_m);
  row.outward_m = std::max(row.outward_m, found_m - row.far_m);
}

double far_of_host(const View& view, bool in_float) {
  HostMatrices host = host_matrices(view, ClipDepth::minus_one_to_one);
  if (in_float) host.projection = Mat4d(Mat4(host.projection));
  const culling::FrustumD frustum = make_frustum(host.projection, host.view, host.depth).frustum;
  if (frustum.count <= culling::kFar) return std::numeric_limits<double>::quiet_NaN();
  const culling::PlaneD& plane = frustum.planes[culling::kFar];
  return plane.offset + glm::dot(plane.normal, view.eye - frustum.eye);
}

/// One place and one pair of depths, all fields of view.
struct Part {
  std::vector<ExtremesRow> rows;
  std::vector<FarRow> far;
};

/// The rows of one kind of camera: two a way, ours first.
std::vector<ExtremesRow> empty_rows(const Place& place, const Depths& depths, double fov_deg) {
  std::vector<ExtremesRow> rows;
  const auto add = [&](std::string_view way, std::string_view precision) {
    for (const char* objects : {"any", "touching"})
      rows.push_back({std::string(place.name), depths.near_m, depths.far_m, fov_deg, std::string(way),
                      std::string(precision), objects});
  };
  add("bqr", "float with margins");
  for (const NaiveWay& way : naive_ways()) add(way.slug, way.precision);
  return rows;
}

std::vector<FarRow> empty_far_rows(const Place& place, const Depths& depths) {
  std::vector<FarRow> rows;
  if (!std::isfinite(depths.far_m)) return rows;
  const auto add = [&](std::string_view way, std::string_view precision) {
    rows.push_back({std::string(place.name), depths.near_m, depths.far_m, std::string(way), std::string(precision)});
  };
  add("bqr, host's matrices", "double");
  add("bqr, host's matrices", "float");
  for (const NaiveWay& way : naive_ways()) add(way.slug, way.precision);
  return rows;
}

void ask_all(const View& view, const ExtremesOptions& options, Random& random, std::span<ExtremesRow> rows) {
  const ExactView truth = make_exact(view);
  const std::array sorts{any_boxes(truth, reach_of(view), options.objects, random),
                         touching_boxes(truth, reach_of(view), options.objects, random)};
  for (std::size_t sort = 0; sort < sorts.size(); ++sort) {
    const std::vector<BoxD>& boxes = sorts[sort];
    std::vector<bool> seen;
    for (const BoxD& box : boxes) seen.push_back(exactly_overlaps(truth, box));
    count(rows[sort], truth, boxes, seen, kept_by_bqr(view, boxes));
    for (std::size_t way = 0; way < naive_ways().size(); ++way)
      count(rows[2 * (way + 1) + sort], truth, boxes, seen, naive_ways()[way].kept(view, boxes));
  }
}

void ask_far(const View& view, std::span<FarRow> rows) {
  if (rows.empty()) return;
  count(rows[0], far_of_host(view, false));
  count(rows[1], far_of_host(view, true));
  for (std::size_t way = 0; way < naive_ways().size(); ++way) count(rows[way + 2], naive_ways()[way].far_m(view));
}

Part run_part(const Place& place, const Depths& depths, const ExtremesOptions& options, std::uint64_t seed) {
  Part part{{}, empty_far_rows(place, depths)};
  Random random(seed);
  for (const double fov_deg : kFieldsDeg) {
    auto rows = empty_rows(place, depths, fov_deg);
    for (int i = 0; i < options.cameras; ++i) {
      const Vec3d eye = place.at + random.direction() * random.in(0, 100);
      const View view = culling::look(eye, random.direction(), {0, 0, 1}, glm::radians(fov_deg), 16.0 / 9,
                                      depths.near_m, depths.far_m);
      ask_all(view, options, random, rows);
      ask_far(view, part.far);
    }
    part.rows.insert(part.rows.end(), rows.begin(), rows.end());
  }
  return part;
}

}  // namespace

Extremes run_extremes(const ExtremesOptions& options, const std::function<void(double)>& progress) {
  std::vector<Part> parts(kPlaces.size() * kDepths.size());
  std::mutex telling;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    parts[i] = run_part(kPlaces[i / kDepths.size()], kDepths[i % kDepths.size()], options, hash_bits(options.seed, i));
    const std::scoped_lock one_at_a_time(telling);
    progress(static_cast<double>(++done) / static_cast<double>(parts.size()));
  });
  Extremes all{options, {}, {}};
  for (const Part& part : parts) {
    all.rows.insert(all.rows.end(), part.rows.begin(), part.rows.end());
    all.far.insert(all.far.end(), part.far.begin(), part.far.end());
  }
  return all;
}

}  // namespace manzana::culling_benchmark
