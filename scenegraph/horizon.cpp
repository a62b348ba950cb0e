#include "scenegraph/horizon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace manzana {

using culling::LeafRun;
using culling::ObjectRun;

namespace {

constexpr std::size_t kColumns = 4096;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What floats may be wrong by: of elevations and distances, relative.
constexpr float kMargin = 2e-3F;
constexpr float kMostMargin = 0.5F;  // of walls that lean against L's up, as they do far from its middle
constexpr float kLeastAway = 0.1F;   // metres of the eye from a wall's plane: nearer ones are seen from the side

/// Rises with the angle of p, from 0 to 4 in a turn: no arc tangent is needed.
float turn_of(const Vec2& p) {
  const float t = p.x / (std::abs(p.x) + std::abs(p.y));
  return p.y >= 0 ? 1 - t : 3 + t;
}

Vec2 direction_of(double turn) {
  const double x = turn <= 2 ? 1 - turn : turn - 3, y = turn <= 2 ? 1 - std::abs(x) : std::abs(x) - 1;
  return Vec2(glm::normalize(Vec2d(x, y)));
}

constexpr float kColumnsATurn = static_cast<float>(kColumns) / 4;

std::size_t wrapped(std::int64_t column) {
  return static_cast<std::size_t>((column % static_cast<std::int64_t>(kColumns) + static_cast<std::int64_t>(kColumns)) %
                                  static_cast<std::int64_t>(kColumns));
}

/// From `from`, counter-clockwise, -2 to 2.
float turned(float from, float to) {
  const float t = to - from;
  return t > 2 ? t - 4 : t < -2 ? t + 4 : t;
}

bool is_band(const Horizon::Column& c) { return c.low < c.high; }

/// What both cover.
Horizon::Column both(const Horizon::Column& a, const Horizon::Column& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high), std::max(a.farthest, b.farthest)};
}

float plan_distance(const Vec3& min, const Vec3& max) {
  const Vec2 nearest(std::max({min.x, -max.x, 0.0F}), std::max({min.y, -max.y, 0.0F}));
  return glm::length(nearest);
}

void append(std::vector<ObjectRun>& runs, const ObjectRun& run) {
  if (!runs.empty() && runs.back().last == run.first)
    runs.back().last = run.last;
  else
    runs.push_back(run);
}

template <class Near>
void put_nearest_first(std::vector<Near>& all) {
  std::sort(all.begin(), all.end(), [](const Near& a, const Near& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.number < b.number;
  });
}

void put_in_order(std::vector<ObjectRun>& runs) {
  std::sort(runs.begin(), runs.end(), [](const ObjectRun& a, const ObjectRun& b) { return a.first < b.first; });
  std::size_t n = 0;
  for (const ObjectRun& run : runs) {
    if (n > 0 && runs[n - 1].last == run.first)
      runs[n - 1].last = run.last;
    else
      runs[n++] = run;
  }
  runs.resize(n);
}

/// Of an object of the tree, in L; all of space where no layer has it.
culling::BoxD box_of(const Scene& scene, std::uint32_t object) {
  for (const LayerTable* table : {&scene.trees.table, &scene.buildings.table, &scene.surfaces.table}) {
    const std::uint32_t row = table->row_first[object];
    if (row == table->row_first[object + 1]) continue;
    return {Vec3d(table->boxes[row].min) + scene.tree.origin, Vec3d(table->boxes[row].max) + scene.tree.origin};
  }
  return {Vec3d(-kInfinity), Vec3d(kInfinity)};
}

bool all_there(const LayerTable& table, std::span<const ObjectRun> objects, const Horizon::IsThere& there) {
  return std::ranges::all_of(objects, [&](const ObjectRun& run) {
    const ObjectRun rows = table.rows(run);
    for (std::uint32_t row = rows.first; row < rows.last; ++row)
      if (!there(row)) return false;
    return true;
  });
}

}  // namespace

Horizon::Horizon(const Scene& scene) : columns_(kColumns), walls_(scene.buildings.table.size()) {
  for (std::size_t i = 0; i <= kColumns; ++i) edges_.push_back(direction_of(4.0 * static_cast<double>(i) / kColumns));
  const culling::BqrTree& tree = scene.tree;
  for (std::uint32_t b = 0; b < tree.blocks(); ++b) {
    culling::BoxD box = lane_box(tree.nodes[tree.place[b] / culling::kLanes], tree.place[b] % culling::kLanes);
    box.min += tree.origin;
    box.max += tree.origin;
    boxes_.push_back(box);
  }
  near_.reserve(boxes_.size());
}

const std::vector<UprightWall>& Horizon::walls_of(const Scene& scene, std::uint32_t building) {
  auto& walls = walls_[building];
  if (!walls) walls = upright_walls(scene, building);
  return *walls;
}

void Horizon::list_blocks(const VisibleSets& sets) {
  near_.clear();
  for (const LeafRun& run : sets.blocks())
    for (std::uint32_t b = run.first; b < run.last; ++b)
      near_.push_back({plan_distance(Vec3(boxes_[b].min - eye_), Vec3(boxes_[b].max - eye_)), b, run.planes});
  put_nearest_first(near_);
}

void Horizon::hide(const Scene& scene, const Eye& eye, VisibleSets& sets) {
  eye_ = eye.at;
  near_plane_ = {Vec3(eye.near.normal), static_cast<float>(eye.near.offset)};
  sets.kept = sets.awaited = false;
  list_blocks(sets);
  sets.kept = true;
  sweep(scene, sets, {});
}

void Horizon::reveal(const Scene& scene, VisibleSets& sets, const IsThere& there) {
  sets.awaited = !all_there(scene.buildings.table, sets.kept_objects, there);
  if (!sets.awaited) return;
  sets.coming_objects.swap(sets.kept_objects);
  sweep(scene, sets, there);
}

void Horizon::sweep(const Scene& scene, VisibleSets& sets, const IsThere& there) {
  std::fill(columns_.begin(), columns_.end(), Column{});
  sets.kept_blocks.clear();
  sets.kept_objects.clear();
  for (const Near& near : near_) {
    if (hidden(boxes_[near.number])) continue;
    sets.kept_blocks.push_back({near.number, near.number + 1, near.planes});
    keep_objects(scene, near.number, sets, there);
  }
  put_in_order(sets.kept_objects);
}

/// Of a block that is not hidden as a whole, from near to far, those objects that are not. All of a wood or a meadow
/// before which no wall stands.
void Horizon::keep_objects(const Scene& scene, std::uint32_t block, VisibleSets& sets, const IsThere& there) {
  const auto runs = sets.answer.objects().first(sets.city_runs);
  const ObjectRun all = scene.tree.block_objects[block];
  const LayerTable& buildings = scene.buildings.table;
  bool ask = may_hide_part(boxes_[block]);
  auto run = std::partition_point(runs.begin(), runs.end(), [&](const ObjectRun& r) { return r.last <= all.first; });
  const auto within = [&](const ObjectRun& r) {
    return ObjectRun{std::max(r.first, all.first), std::min(r.last, all.last)};
  };
  for (auto r = run; !ask && r != runs.end() && r->first < all.last; ++r) {
    const ObjectRun rows = buildings.rows(within(*r));
    ask = rows.first < rows.last;
  }
  objects_.clear();
  for (; run != runs.end() && run->first < all.last; ++run) {
    const ObjectRun part = within(*run);
    if (!ask) append(sets.kept_objects, part);
    for (std::uint32_t i = part.first; ask && i < part.last; ++i) {
      const culling::BoxD box = box_of(scene, i);
      objects_.push_back({plan_distance(Vec3(box.min - eye_), Vec3(box.max - eye_)), i, 0});
    }
  }
  keep_nearest_first(scene, block, sets, there);
}

/// Of objects_.
void Horizon::keep_nearest_first(const Scene& scene, std::uint32_t block, VisibleSets& sets, const IsThere& there) {
  put_nearest_first(objects_);
  for (const Near& object : objects_) {
    const culling::BoxD box = box_of(scene, object.number);
    if (hidden(box)) continue;
    append(sets.kept_objects, {object.number, object.number + 1});
    const ObjectRun rows = scene.buildings.table.rows({object.number, object.number + 1});
    if (box.max.z > eye_.z && (!there || (rows.first < rows.last && there(rows.first)))) add_walls(scene, block, rows);
  }
}

void Horizon::hide_cars(VisibleSets& sets) const {
  std::erase_if(sets.cars, [&](const CarState& car) {
    return hidden({car.position - Vec3d(kCarRadius), car.position + Vec3d(kCarRadius)});
  });
}

/// All round where the eye is over, under or in the box.
Horizon::Sight Horizon::sight_of(const culling::BoxD& box) const {
  const Vec3 min(box.min - eye_), max(box.max - eye_);
  const float nearest = plan_distance(min, max),
              farthest = glm::length(glm::max(glm::abs(Vec2(min)), glm::abs(Vec2(max))));
  constexpr float kSteep = std::numeric_limits<float>::infinity();
  if (nearest <= 0) return {0, static_cast<std::int64_t>(kColumns) - 1, -kSteep, kSteep, 0};
  const float middle = turn_of(Vec2(min + max) / 2.0F);
  float right = 0, left = 0;
  for (const Vec2& corner : {Vec2(min), Vec2(max), Vec2(min.x, max.y), Vec2(max.x, min.y)}) {
    const float t = turned(middle, turn_of(corner));
    right = std::min(right, t), left = std::max(left, t);
  }
  return {static_cast<std::int64_t>(std::floor((middle + right) * kColumnsATurn - 0.01F)),
          static_cast<std::int64_t>(std::floor((middle + left) * kColumnsATurn + 0.01F)),
          min.z / (min.z < 0 ? nearest : farthest), max.z / (max.z > 0 ? nearest : farthest), nearest};
}

bool Horizon::hidden(const culling::BoxD& box) const {
  const Sight sight = sight_of(box);
  for (std::int64_t i = sight.first; i <= sight.last; ++i) {
    const Column& c = columns_[wrapped(i)];
    if (!(c.high >= sight.high && c.low <= sight.low && c.farthest <= sight.nearest)) return false;
  }
  return true;
}

/// Something in it may be hidden.
bool Horizon::may_hide_part(const culling::BoxD& box) const {
  const Sight sight = sight_of(box);
  for (std::int64_t i = sight.first; i <= sight.last; ++i)
    if (is_band(columns_[wrapped(i)])) return true;
  return false;
}

void Horizon::add_walls(const Scene& scene, std::uint32_t block, const ObjectRun& buildings) {
  const Vec3 offset(scene.blocks[block].origin - eye_);
  const float lean = glm::length(Vec2(Vec2d(scene.blocks[block].axes[2])));
  const auto hides = [&](const UprightWall& w) {
    const Vec2 a = w.a + Vec2(offset), b = w.b + Vec2(offset);
    return a.x * b.y - a.y * b.x < 0 && w.top + offset.z > 0 && w.bottom + offset.z < 0;
  };
  const auto add_all = [&](std::span<const UprightWall> joined) {  // of a ring, none is torn in its middle
    const bool ring = joined.front().a == joined.back().b;
    const auto start = ring ? std::ranges::find_if_not(joined, hides) - joined.begin() : 0;
    chain_.clear();
    for (std::size_t n = 0; n < joined.size(); ++n) {
      const UprightWall& wall = joined[(static_cast<std::size_t>(start) + n) % joined.size()];
      if (hides(wall))
        chain_.push_back(wall);
      else
        add_chain(offset, lean), chain_.clear();
    }
    add_chain(offset, lean);
  };
  for (std::uint32_t row = buildings.first; row < buildings.last; ++row) {
    const std::span<const UprightWall> walls = walls_of(scene, row);
    for (std::size_t i = 0, end = 0; i < walls.size(); i = end) {
      for (end = i + 1; end < walls.size() && walls[end].joined;) ++end;
      add_all(walls.subspan(i, end - i));
    }
  }
}

/// Whether any of an upright line of the wall lies before the near plane.
bool Horizon::is_cut(const Vec2& at, const UprightWall& wall, float up, float lean) const {
  constexpr float kClose = 0.01F;  // metres
  const Vec3& n = near_plane_.normal;
  const float z = (n.z > 0 ? wall.bottom : wall.top) + up;
  return n.x * at.x + n.y * at.y + n.z * z + near_plane_.offset < kClose + lean;
}

/// Of a wall that goes on to both sides of the column.
Horizon::Column Horizon::seen_in(std::size_t column, const UprightWall& wall, const Facing& facing, float up) const {
  const float u = glm::dot(facing.normal, edges_[column]), v = glm::dot(facing.normal, edges_[column + 1]);
  const float slant = std::min(u, v) / facing.away, nearest = facing.away / std::max(u, v);
  const auto cut = [&](std::size_t edge, float part) {
    return is_cut(edges_[edge] * (facing.away / part), wall, up, facing.lean);
  };
  const float margin = kMargin + facing.lean / facing.away;
  const bool seen =
      facing.away > kLeastAway && nearest > static_cast<float>(kNearest) && slant > 0 && margin < kMostMargin;
  if (!seen || cut(column, u) || cut(column + 1, v)) return {};
  return {(wall.bottom + up) * slant * (1 - margin), (wall.top + up) * slant * (1 - margin), (1 + margin) / slant};
}

/// Walls that continue each other, clockwise about the eye. Columns at both ends are covered in part, and so not at
/// all.
void Horizon::add_chain(const Vec3& offset, float lean) {
  if (chain_.empty()) return;
  const Vec2 at(offset);
  const auto lean_of = [&](const UprightWall& wall) { return lean * std::max(-wall.bottom, wall.top); };
  // In columns: at most kColumnsATurn for a radian.
  const auto slack = [&](const UprightWall& wall, const Vec2& end) {
    return (wall.slack + lean_of(wall)) / glm::length(end + at) * kColumnsATurn;
  };
  const auto column_of = [](float columns) { return static_cast<std::int64_t>(std::floor(columns)); };
  const auto span_of = [&](const UprightWall& wall) {
    return turned(turn_of(wall.a + at), turn_of(wall.b + at)) * kColumnsATurn;
  };
  float now = turn_of(chain_.front().a + at) * kColumnsATurn, end = now;
  for (const UprightWall& wall : chain_) end += span_of(wall);
  const std::int64_t begin = column_of(now - slack(chain_.front(), chain_.front().a));
  const std::int64_t stop = column_of(end + slack(chain_.back(), chain_.back().b));
  std::int64_t open = begin;  // the column that the wall before ended in
  Column so_far;
  for (const UprightWall& wall : chain_) {
    const float next = now + span_of(wall);
    const Vec2 along = glm::normalize(wall.b - wall.a), normal(-along.y, along.x);
    const Facing facing{normal, glm::dot(normal, wall.a + at), lean_of(wall)};
    const std::int64_t last = std::max(column_of(next), stop);
    for (std::int64_t i = std::min(column_of(now), begin); i >= last; --i) {
      const std::size_t column = wrapped(i);
      const Column seen = seen_in(column, wall, facing, offset.z), with = i == open ? both(seen, so_far) : seen;
      if (i == last)
        open = i, so_far = with;
      else
        cover(column, with);
    }
    now = next;
  }
}

/// Nearer walls have been there before: what hides already stays, and a wall that rises from it makes it higher.
void Horizon::cover(std::size_t column, const Column& with) {
  Column& c = columns_[column];
  if (!is_band(with)) return;
  if (!is_band(c))
    c = with;
  else if ((with.low < c.low || with.high > c.high) && with.low <= c.high && with.high >= c.low)
    c = {std::min(c.low, with.low), std::max(c.high, with.high), std::max(c.farthest, with.farthest)};
}

}  // namespace manzana
