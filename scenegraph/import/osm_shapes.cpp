#include "scenegraph/import/osm_shapes.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/import/osm_rings.h"

namespace manzana {
namespace {

GeoPoint geo(const osmium::Location& at) { return {at.lat_without_check(), at.lon_without_check(), 0}; }

LocalFrame frame_of(const OsmFile& file) {
  std::vector<GeoPoint> points;
  points.reserve(file.nodes.size());
  for (const OsmNode& node : file.nodes) points.push_back(geo(node.at));
  return LocalFrame(center_of(points));
}

/// The key by which tags make an area, for telling whether a way only repeats its relation.
const char* main_key(const osmium::TagList& tags) {
  for (const char* key : {"building", "building:part", "natural", "landuse", "leisure", "waterway", "highway"}) {
    if (tags.has_key(key)) return key;
  }
  return "";
}

/// Lives for one call of OsmShapes::areas.
class AreaCollector {
 public:
  using Wanted = std::function<bool(const osmium::TagList&)>;
  using Ways = std::unordered_map<std::int64_t, const osmium::Way*>;
  AreaCollector(const OsmFile& file, const OsmShapes& shapes, const Ways& ways, const Wanted& wanted,
                std::vector<Issue>& issues)
      : file_(file), shapes_(shapes), ways_(ways), wanted_(wanted), issues_(issues) {}

  std::vector<OsmArea> run() {
    std::vector<OsmArea> of_relations;
    for (const osmium::Relation* relation : file_.relations) take(*relation, of_relations);
    std::vector<OsmArea> out;
    for (const osmium::Way* way : file_.ways) take(*way, out);
    std::ranges::move(of_relations, std::back_inserter(out));
    return out;
  }

 private:
  void take(const osmium::Relation& relation, std::vector<OsmArea>& out) {
    const char* type = relation.tags()["type"];
    if (type == nullptr || (std::string_view(type) != "multipolygon" && std::string_view(type) != "boundary")) return;
    const osmium::TagList* tags = tags_of(relation);
    if (tags == nullptr) return;
    OsmArea area{where_of(relation), static_cast<std::uint64_t>(relation.id()), true, tags, {}};
    MemberWays members = members_of(relation, area.where);
    area.shapes = assemble_rings(members, area.where, issues_);
    if (!area.shapes.empty()) out.push_back(std::move(area));
  }

  /// The relation's own tags if wanted, else an outer way's; null: neither. Notes the ways that say the same.
  const osmium::TagList* tags_of(const osmium::Relation& relation) {
    const osmium::TagList* tags = wanted_(relation.tags()) ? &relation.tags() : nullptr;
    const bool borrowed = tags == nullptr;
    for (const osmium::RelationMember& member : relation.members()) {
      const osmium::Way* way = outer_way(member);
      if (way == nullptr || !wanted_(way->tags())) continue;
      if (tags == nullptr && way->tags().size() > 0) tags = &way->tags();
      const bool repeats = tags != nullptr && std::string_view(main_key(*tags)) == main_key(way->tags());
      if (repeats && (borrowed || way->is_closed())) spoken_for_[way->id()] = true;
    }
    return tags;
  }

  const osmium::Way* outer_way(const osmium::RelationMember& member) const {
    if (member.type() != osmium::item_type::way || std::string_view(member.role()) == "inner") return nullptr;
    const auto at = ways_.find(member.ref());
    return at == ways_.end() ? nullptr : at->second;
  }

  MemberWays members_of(const osmium::Relation& relation, const std::string& where) const {
    MemberWays out;
    std::size_t missing_ways = 0, missing_nodes = 0;
    for (const osmium::RelationMember& member : relation.members()) {
      if (member.type() != osmium::item_type::way) continue;
      const auto at = ways_.find(member.ref());
      if (at == ways_.end()) {
        ++missing_ways;
        continue;
      }
      OsmLine line = shapes_.line(at->second->nodes());
      missing_nodes += line.missing;
      auto& side = std::string_view(member.role()) == "inner" ? out.inner : out.outer;
      if (line.points.size() > 1) side.push_back({std::move(line), at->second->is_closed()});
    }
    if (missing_ways > 0) issues_.push_back({where, std::to_string(missing_ways) + " member ways are not in the file"});
    if (missing_nodes > 0) issues_.push_back({where, std::to_string(missing_nodes) + " nodes are not in the file"});
    return out;
  }

  void take(const osmium::Way& way, std::vector<OsmArea>& out) {
    if (way.tags().empty() || !wanted_(way.tags()) || spoken_for_.contains(way.id())) return;
    OsmArea area{where_of(way), static_cast<std::uint64_t>(way.id()), false, &way.tags(), {}};
    OsmLine line = shapes_.line(way.nodes());
    if (const char* why = unusable(way, line)) {
      issues_.push_back({area.where, why});
      return;
    }
    if (line.missing > 0) issues_.push_back({area.where, std::to_string(line.missing) + " nodes are not in the file"});
    area.shapes.push_back({std::move(line.points), {}});
    out.push_back(std::move(area));
  }

  static const char* unusable(const osmium::Way& way, OsmLine& line) {
    if (way.nodes().size() < 2 || !way.is_closed()) return "ring is not closed";
    clean_ring(line.points);
    if (line.points.size() < 3) return "fewer than three corners";
    return has_width(line.points) ? nullptr : "ring has no area";
  }

  const OsmFile& file_;
  const OsmShapes& shapes_;
  const Ways& ways_;
  const Wanted& wanted_;
  std::vector<Issue>& issues_;
  std::unordered_map<std::int64_t, bool> spoken_for_;
};

}  // namespace

OsmShapes::OsmShapes(const OsmFile& file) : file_(file), frame_(frame_of(file)) {
  way_of_.reserve(file.ways.size());
  for (const osmium::Way* way : file.ways) way_of_.emplace(way->id(), way);
}

Vec2d OsmShapes::position(const osmium::Location& legal) const {
  const Vec3d p = frame_.to_local(geo(legal));
  return {p.x, p.y};
}

std::optional<Vec2d> OsmShapes::position(std::int64_t node) const {
  const OsmNode* found = file_.find(node);
  if (found == nullptr) return std::nullopt;
  const Vec3d p = frame_.to_local(geo(found->at));
  if (!(glm::length(p) <= kReach)) return std::nullopt;
  return Vec2d{p.x, p.y};
}

OsmLine OsmShapes::line(const osmium::WayNodeList& refs) const {
  OsmLine out;
  out.points.reserve(refs.size());
  out.nodes.reserve(refs.size());
  for (const osmium::NodeRef& ref : refs) {
    const auto p = position(ref.ref());
    out.missing += p ? 0 : 1;
    if (!p || (!out.nodes.empty() && out.nodes.back() == ref.ref())) continue;
    out.points.push_back(*p);
    out.nodes.push_back(ref.ref());
  }
  return out;
}

std::vector<OsmArea> OsmShapes::areas(const std::function<bool(const osmium::TagList&)>& wanted,
                                      std::vector<Issue>& issues) const {
  return AreaCollector(file_, *this, way_of_, wanted, issues).run();
}

double twice_area(std::span<const Vec2d> ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {  // from the first corner, so that far rings lose no digits
    const Vec2d a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

double area_of(const Polygon& shape) {
  double area = std::abs(twice_area(shape.outer));
  for (const auto& hole : shape.holes) area -= std::abs(twice_area(hole));
  return std::max(area / 2, 0.0);
}

bool contains(std::span<const Vec2d> ring, const Vec2d& p) {
  bool in = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2d &a = ring[i], &b = ring[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) in = !in;
  }
  return in;
}

}  // namespace manzana
