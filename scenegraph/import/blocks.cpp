#include "scenegraph/import/blocks.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "scenegraph/import/fallback_cells.h"
#include "scenegraph/import/street_faces.h"

namespace manzana {
namespace {

constexpr double kBesideStreet = 1.0;    // metres from the carriageway's edge to where a half-street looks for its face
constexpr double kWidestStreet = 60.0;   // metres: a width beyond is a mistake, and would jump over the block
constexpr std::uint32_t kHeavyFace = 8;  // times fallback_weight: a face with more objects is cut into cells

// Where the middle of an edge is, and the unit direction of its points there.
struct Middle {
  Vec2d position, direction;
};

Middle middle_of(const StreetEdge& edge) {
  double rest = 0.5 * edge.length;
  for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
    const Vec2d a(edge.points[i]), b(edge.points[i + 1]);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (rest <= length || i + 2 == edge.points.size())
      return {glm::mix(a, b, std::min(1.0, rest / length)), (b - a) / length};
    rest -= length;
  }
  return {Vec2d(edge.points[0]), {1, 0}};
}

bool driven(const StreetGraph& graph, std::size_t half) {
  const StreetFeature& street = graph.streets[graph.edges[half / 2].street];
  return carries_traffic(street.kind) && !(street.one_way && half % 2 == 1);
}

class Planner {
 public:
  Planner(const StreetGraph& graph, const StreetFaces& faces, std::span<const Vec2d> centers,
          const BlockOptions& options)
      : graph_(graph), options_(options), objects_(centers.size()), faces_(faces) {
    assert(std::all_of(centers.begin(), centers.end(), [](const Vec2d& p) { return std::isfinite(p.x + p.y); }));
    points_.assign(centers.begin(), centers.end());
    for (const StreetEdge& edge : graph.edges) add_kerbs(edge);
  }

  BlockPlan run() {
    ground_faces();
    cut_into_cells();
    keep_used();
    return number();
  }

 private:
  // Along the points, then against them. Right-hand traffic has its kerb on the right.
  void add_kerbs(const StreetEdge& edge) {
    const double width = graph_.streets[edge.street].width;
    const double side = 0.5 * std::clamp(width > 0 ? width : 0.0, 0.0, kWidestStreet) + kBesideStreet;
    const Middle middle = middle_of(edge);
    const Vec2d right = (options_.left_hand_traffic ? -side : side) * Vec2d(middle.direction.y, -middle.direction.x);
    points_.push_back(middle.position + right);
    points_.push_back(middle.position - right);
  }

  // A ground is a face or a cell; the first ones are the faces.
  void ground_faces() {
    for (const StreetFace& face : faces_.faces()) grounds_.push_back({face.centroid.center, false});
    ground_.reserve(points_.size());
    for (const Vec2d& p : points_) ground_.push_back(faces_.locate(p));
  }

  bool open_country(std::uint32_t face, std::uint32_t objects) const {
    return faces_.faces()[face].box.size() > options_.face_size || objects > kHeavyFace * options_.fallback_weight;
  }

  void cut_into_cells() {
    const auto faces = static_cast<std::uint32_t>(faces_.faces().size());
    std::vector<std::uint32_t> weight(faces, 0);
    for (std::size_t i = 0; i < objects_; ++i)
      if (ground_[i] != kNoFace) ++weight[ground_[i]];
    std::vector<std::vector<std::uint32_t>> groups(faces + 1);  // the last: those in no face
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (ground_[i] == kNoFace)
        groups[faces].push_back(i);
      else if (open_country(ground_[i], weight[ground_[i]]))
        groups[ground_[i]].push_back(i);
    }
    for (const auto& group : groups) cut(group);
  }

  void cut(const std::vector<std::uint32_t>& group) {
    std::vector<Vec2d> members;
    members.reserve(group.size());
    for (std::uint32_t i : group) members.push_back(points_[i]);
    const FallbackCells cells =
        fallback_cells(members, {.weight = options_.fallback_weight, .size = options_.fallback_size});
    const auto first = static_cast<std::uint32_t>(grounds_.size());
    for (const PlanBox& cell : cells.cells) grounds_.push_back({cell.center(), true});
    for (std::size_t k = 0; k < group.size(); ++k) ground_[group[k]] = first + cells.of[k];
  }

  std::uint32_t& half_ground(std::size_t half) { return ground_[objects_ + half]; }

  // A direction that nobody drives makes no block: it goes to the block beyond the kerb, or across the street. Only
  // where there is neither, a block is made of it.
  void keep_used() {
    const std::size_t halves = points_.size() - objects_;
    kept_.assign(grounds_.size(), false);
    for (std::size_t i = 0; i < objects_; ++i) kept_[ground_[i]] = true;
    for (std::size_t h = 0; h < halves; ++h)
      if (driven(graph_, h)) kept_[half_ground(h)] = true;
    for (std::size_t h = 0; h < halves; ++h) {
      if (!kept_[half_ground(h)] && kept_[half_ground(h ^ 1U)]) half_ground(h) = half_ground(h ^ 1U);
      kept_[half_ground(h)] = true;
    }
  }

  BlockPlan number() const {
    BlockPlan plan;
    std::vector<std::uint32_t> row(grounds_.size(), 0);
    for (std::size_t g = 0; g < grounds_.size(); ++g) {
      row[g] = static_cast<std::uint32_t>(plan.blocks.size());
      if (kept_[g]) plan.blocks.push_back(grounds_[g]);
    }
    for (std::size_t i = 0; i < points_.size(); ++i)
      (i < objects_ ? plan.of : plan.half_streets).push_back(row[ground_[i]]);
    return plan;
  }

  const StreetGraph& graph_;
  BlockOptions options_;
  std::size_t objects_;
  const StreetFaces& faces_;
  std::vector<Vec2d> points_;          // centres of objects, then where each half-street looks for its face
  std::vector<std::uint32_t> ground_;  // a row a point
  std::vector<BlockGround> grounds_;
  std::vector<bool> kept_;
};

}  // namespace

BlockPlan find_blocks(const StreetGraph& graph, std::span<const Vec2d> centers, const BlockOptions& options) {
  return find_blocks(graph, StreetFaces(graph), centers, options);
}

BlockPlan find_blocks(const StreetGraph& graph, const StreetFaces& faces, std::span<const Vec2d> centers,
                      const BlockOptions& options) {
  return Planner(graph, faces, centers, options).run();
}

}  // namespace manzana
