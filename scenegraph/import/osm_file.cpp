#include "scenegraph/import/osm_file.h"

#include <algorithm>
#include <array>
#include <osmium/io/any_compression.hpp>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/xml_input.hpp>
#include <stdexcept>
#include <unordered_map>

namespace manzana {
namespace {

constexpr std::size_t kListedNodes = 100;  // bad nodes that get an issue each; the rest are summed up

bool is_plant(const osmium::Node& node) {
  const char* natural = node.tags()["natural"];
  return natural != nullptr && (std::string_view(natural) == "tree" || std::string_view(natural) == "shrub");
}

/// Lives for one file.
class Loader {
 public:
  Loader(const osmium::io::File& file, const std::string& name, const Progress& progress)
      : file_(file), name_(name), progress_(progress) {}

  OsmFile run() {
    out_.attribution = kOsmCredit;
    read();
    sum_up_bad_nodes();
    sort_nodes();
    index_objects();
    return std::move(out_);
  }

 private:
  void read() {
    std::size_t offset = 0;
    try {
      osmium::io::Reader reader(file_, osmium::osm_entity_bits::nwr, osmium::io::read_meta::no);
      while (osmium::memory::Buffer buffer = reader.read()) {
        offset = reader.offset();
        tell(static_cast<double>(offset), static_cast<double>(reader.file_size()));
        for (const osmium::OSMObject& object : buffer.select<osmium::OSMObject>()) take(object);
      }
      reader.close();
    } catch (const std::exception& error) {
      throw std::runtime_error(name_ + ": " + one_line(error.what()) + place(error, offset));
    }
  }

  void tell(double offset, double size) {
    const double fraction = size > 0 ? std::min(offset / size, 1.0) : 0;
    if (!progress_ || fraction < told_ + 0.01) return;
    told_ = fraction;
    progress_("reading", fraction);
  }

  void take(const osmium::OSMObject& object) {
    if (object.deleted()) return;
    if (object.type() == osmium::item_type::node) return take(static_cast<const osmium::Node&>(object));
    keep(object);
  }

  void take(const osmium::Node& node) {
    if (!node.location().valid()) {
      if (++bad_nodes_ <= kListedNodes) out_.issues.push_back({where_of(node), "its place is not on the Earth"});
      return;
    }
    out_.nodes.push_back({node.id(), node.location()});
    if (!node.tags().empty() && is_plant(node)) keep(node);
  }

  void keep(const osmium::OSMObject& object) {
    out_.objects.add_item(object);
    out_.objects.commit();
  }

  void sum_up_bad_nodes() {
    if (bad_nodes_ <= kListedNodes) return;
    out_.issues.push_back({"nodes", std::to_string(bad_nodes_ - kListedNodes) + " more are not on the Earth"});
  }

  /// By id; of several with one id the last of the file stays.
  void sort_nodes() {
    auto& nodes = out_.nodes;
    const auto by_id = [](const OsmNode& a, const OsmNode& b) { return a.id < b.id; };
    if (!std::ranges::is_sorted(nodes, by_id)) std::stable_sort(nodes.begin(), nodes.end(), by_id);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (kept > 0 && nodes[kept - 1].id == nodes[i].id) {
        tell_double("node", nodes[i].id);
        --kept;
      }
      nodes[kept++] = nodes[i];
    }
    nodes.resize(kept);
  }

  void tell_double(const std::string& kind, std::int64_t id) {
    if (++doubles_ > kListedNodes) return;
    out_.issues.push_back({kind + " " + std::to_string(id), "id is used more than once: the last one counts"});
  }

  void index_objects() {
    index(out_.plants, "");
    index(out_.ways, "way");
    index(out_.relations, "relation");
  }

  /// Rows of one kind, the last of those with one id. A plant that is there twice was told of with the nodes.
  template <class Object>
  void index(std::vector<const Object*>& rows, const std::string& kind) {
    std::unordered_map<std::int64_t, std::size_t> row_of;
    for (const Object& object : std::as_const(out_.objects).select<Object>()) {
      const auto [at, fresh] = row_of.try_emplace(object.id(), rows.size());
      if (fresh) {
        rows.push_back(&object);
        continue;
      }
      rows[at->second] = &object;
      if (!kind.empty()) tell_double(kind, object.id());
    }
  }

  static std::string one_line(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return static_cast<unsigned char>(c) < 32; }, ' ');
    return text.substr(0, 200);
  }

  /// The XML reader's messages say line and column; for the others, how far the file was read.
  std::string place(const std::exception& error, std::size_t offset) const {
    if (dynamic_cast<const osmium::xml_error*>(&error) != nullptr || offset == 0) return "";
    return " (within the " + std::to_string(offset) + " bytes read)";
  }

  const osmium::io::File& file_;
  const std::string& name_;
  const Progress& progress_;
  OsmFile out_;
  double told_ = -1;
  std::size_t bad_nodes_ = 0, doubles_ = 0;
};

}  // namespace

const OsmNode* OsmFile::find(std::int64_t id) const {
  const auto at = std::ranges::lower_bound(nodes, id, {}, &OsmNode::id);
  return at != nodes.end() && at->id == id ? &*at : nullptr;
}

OsmFile load_osm(const osmium::io::File& file, const std::string& name, const Progress& progress) {
  return Loader(file, name, progress).run();
}

std::string where_of(const osmium::OSMObject& object) {
  static constexpr std::array<const char*, 9> kKeys{"building", "building:part", "highway", "waterway", "natural",
                                                    "landuse",  "leisure",       "amenity", "place"};
  std::string where = std::string(osmium::item_type_to_name(object.type())) + " " + std::to_string(object.id());
  const auto key = std::ranges::find_if(kKeys, [&](const char* k) { return object.tags().has_key(k); });
  return key == kKeys.end() ? where : where + " (" + *key + ")";
}

}  // namespace manzana
