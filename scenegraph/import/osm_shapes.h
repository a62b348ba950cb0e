#pragma once
/// From OpenStreetMap's node references to shapes in plan: lines, rings, and polygons with holes that relations put
/// together from ways.
#include <functional>
#include <unordered_map>

#include "scenegraph/import/osm_file.h"

namespace manzana {

/// A way's nodes that exist, in order, without repetitions.
struct OsmLine {
  std::vector<Vec2d> points;
  std::vector<std::int64_t> nodes;
  std::size_t missing = 0;  ///< nodes that the file lacks
};

/// A closed way or a multipolygon: several shapes where it has several outer rings.
struct OsmArea {
  std::string where;
  std::uint64_t id = 0;
  bool relation = false;
  const osmium::TagList* tags = nullptr;
  std::vector<Polygon> shapes;
  std::string source() const { return (relation ? "relation/" : "way/") + std::to_string(id); }
};

class OsmShapes {
 public:
  explicit OsmShapes(const OsmFile& file);
  const LocalFrame& frame() const { return frame_; }
  /// None when the file lacks it, or it lies farther than kReach from the anchor.
  std::optional<Vec2d> position(std::int64_t node) const;
  Vec2d position(const osmium::Location& legal) const;
  OsmLine line(const osmium::WayNodeList& refs) const;

  /// Closed ways and multipolygon relations whose tags are `wanted`, in the order of the file, ways first. A relation
  /// without wanted tags takes those of its first outer way that has some (as was usual until 2016). A way that gave
  /// its tags, or says with the same key what its relation says, is not an area of its own.
  std::vector<OsmArea> areas(const std::function<bool(const osmium::TagList&)>& wanted,
                             std::vector<Issue>& issues) const;

 private:
  const OsmFile& file_;
  std::unordered_map<std::int64_t, const osmium::Way*> way_of_;
  LocalFrame frame_;
};

/// Objects farther from the centre of the data than this are strays: left out.
inline constexpr double kReach = 300e3;  // metres; a plan is of no use far beyond the horizon

/// Twice the signed area, counter-clockwise positive; square metres.
double twice_area(std::span<const Vec2d> ring);
/// Without regard to direction, holes taken off, square metres.
double area_of(const Polygon& shape);
/// Even-odd rule; points on the border may go either way.
bool contains(std::span<const Vec2d> ring, const Vec2d& p);

}  // namespace manzana
