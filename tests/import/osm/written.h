#pragma once
/// Little OpenStreetMap files for tests, written in place. Positions are metres east and north of (60.168, 24.944).
///   Written osm;
///   osm.way(10, osm.ring({{0, 0}, {20, 0}, {20, 10}, {0, 10}}), {{"building", "yes"}});
///   CityFeatures city = osm.read();
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenegraph/import/osm_file.h"

namespace written {

using Tags = std::vector<std::pair<std::string, std::string>>;
using Refs = std::vector<std::int64_t>;
struct Member {
  std::string type;
  std::int64_t ref = 0;
  std::string role;
};

class Written {
 public:
  explicit Written(std::string attributes = "") : attributes_(std::move(attributes)) {}

  std::int64_t node(double east, double north, const Tags& tags = {}) {
    const std::int64_t id = ++last_node_;
    // Metres a degree at latitude 60.168, by the usual series of the ellipsoid; good to a part in a thousand.
    const double lat = 60.168 + north / 111418.0, lon = 24.944 + east / 55541.0;
    char head[128];
    std::snprintf(head, sizeof head, "<node id=\"%lld\" version=\"1\" lat=\"%.7f\" lon=\"%.7f\">",
                  static_cast<long long>(id), lat, lon);
    body_ += head + text(tags) + "</node>\n";
    return id;
  }

  Refs line(std::initializer_list<std::pair<double, double>> points) {
    Refs refs;
    for (const auto& [east, north] : points) refs.push_back(node(east, north));
    return refs;
  }
  Refs ring(std::initializer_list<std::pair<double, double>> corners) {
    Refs refs = line(corners);
    refs.push_back(refs.front());
    return refs;
  }

  void way(std::int64_t id, const Refs& refs, const Tags& tags) {
    body_ += "<way id=\"" + std::to_string(id) + "\" version=\"1\">";
    for (const std::int64_t ref : refs) body_ += "<nd ref=\"" + std::to_string(ref) + "\"/>";
    body_ += text(tags) + "</way>\n";
  }

  void relation(std::int64_t id, const std::vector<Member>& members, const Tags& tags) {
    body_ += "<relation id=\"" + std::to_string(id) + "\" version=\"1\">";
    for (const Member& m : members)
      body_ += "<member type=\"" + m.type + "\" ref=\"" + std::to_string(m.ref) + "\" role=\"" + m.role + "\"/>";
    body_ += text(tags) + "</relation>\n";
  }

  std::string xml() const {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<osm version=\"0.6\"" + attributes_ + ">\n" + body_ +
           "</osm>\n";
  }
  manzana::CityFeatures read() const { return manzana::read_osm_bytes(xml(), "osm", "written.osm"); }

 private:
  static std::string text(const Tags& tags) {
    std::string out;
    for (const auto& [k, v] : tags) out += "<tag k=\"" + k + "\" v=\"" + v + "\"/>";
    return out;
  }

  std::string attributes_, body_;
  std::int64_t last_node_ = 0;
};

/// The features that came from an object: "way 10" finds "way 10 (building)".
template <class Feature>
std::vector<Feature> from(const std::vector<Feature>& features, const std::string& object) {
  std::vector<Feature> out;
  for (const Feature& f : features) {
    if (f.where == object || f.where.starts_with(object + " ")) out.push_back(f);
  }
  return out;
}

/// Whether an issue of that object says that.
inline bool listed(const manzana::CityFeatures& city, std::string_view where, std::string_view what) {
  return std::ranges::any_of(city.issues, [&](const manzana::Issue& issue) {
    return issue.where.find(where) != std::string::npos && issue.what.find(what) != std::string::npos;
  });
}

}  // namespace written
