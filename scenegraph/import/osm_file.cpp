#include "scenegraph/import/osm_file.h"

#include <algorithm>
#include <array>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <stdexcept>
#include <unordered_map>

#include "scenegraph/import/osm_xml.h"

namespace manzana {
namespace {

constexpr std::size_t kListed = 100;  // objects with a bad id or place that get an issue each; the rest are summed up

bool is_plant(const osmium::Node& node) {
  const char* natural = node.tags()["natural"];
  return natural != nullptr && (std::string_view(natural) == "tree" || std::string_view(natural) == "shrub");
}

/// Tags lie one after another, each two texts that end with a zero. A PBF file may hide zeros within its texts, and an
/// odd number of them would lead the iteration over tags past their end: libosmium does not look.
bool tags_end_well(const osmium::TagList& tags) {
  if (tags.empty()) return true;
  const auto* first = reinterpret_cast<const char*>(tags.cbegin().operator->());
  const auto* last = reinterpret_cast<const char*>(tags.cend().operator->());
  return std::count(first, last, '\0') % 2 == 0;
}

/// "way 4711".
std::string plain_name(const osmium::OSMObject& object) {
  return std::string(osmium::item_type_to_name(object.type())) + " " + std::to_string(object.id());
}

std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 32; }, ' ');
  return text.substr(0, 200);
}

/// OpenStreetMap's own servers write an address there; empty says that the data are made up and need no credit.
std::string credit_of(const std::string& attribution) {
  return attribution.find("openstreetmap") == std::string::npos ? one_line(attribution) : kOsmCredit;
}

/// Lives for one file.
class Loader {
 public:
  Loader(const osmium::io::File& file, const std::string& name, const Progress& progress)
      : file_(file), name_(name), progress_(progress) {
    std::error_code unknown;
    const auto size = std::filesystem::file_size(file.filename(), unknown);
    size_ = unknown ? 0 : static_cast<double>(size);
  }

  OsmFile run() {
    out_.attribution = kOsmCredit;
    read();
    sort_nodes();
    index_objects();
    sum_up();
    return std::move(out_);
  }

 private:
  void read() {
    try {
      file_.format() == osmium::io::file_format::xml ? read_xml() : read_pbf();
    } catch (const std::exception& error) {
      throw std::runtime_error(name_ + ": " + one_line(error.what()) + place());
    }
  }

  void read_xml() {
    XmlSink sink;
    sink.object = [&](const osmium::OSMObject& object) { take(object); };
    sink.issue = [&](Issue issue) { note_bad(std::move(issue)); };
    sink.attribution = [&](const std::string& credit) { out_.attribution = credit_of(credit); };
    sink.bytes = [&](std::size_t offset) { tell(static_cast<double>(offset)); };
    read_osm_xml(file_, sink);
  }

  void read_pbf() {
    osmium::io::Reader reader(file_, osmium::osm_entity_bits::nwr, osmium::io::read_meta::no);
    while (osmium::memory::Buffer buffer = reader.read()) {
      bytes_ = reader.offset();
      tell(static_cast<double>(bytes_));
      for (const osmium::OSMObject& object : buffer.select<osmium::OSMObject>()) take(object);
    }
    reader.close();
  }

  void tell(double offset) {
    const double fraction = size_ > 0 ? std::min(offset / size_, 1.0) : 0;
    if (!progress_ || fraction < told_ + 0.01) return;
    told_ = fraction;
    progress_("reading", fraction);
  }

  void take(const osmium::OSMObject& object) {
    if (object.deleted()) return;
    if (!tags_end_well(object.tags())) return note_bad({plain_name(object), "its tags are damaged"});
    if (object.type() == osmium::item_type::node) return take(static_cast<const osmium::Node&>(object));
    keep(object);
  }

  void take(const osmium::Node& node) {
    if (!node.location().valid()) {
      return note_bad({where_of(node), "its place is not on the Earth"});
    }
    out_.nodes.push_back({node.id(), node.location()});
    if (!node.tags().empty() && is_plant(node)) keep(node);
  }

  void keep(const osmium::OSMObject& object) {
    out_.objects.add_item(object);
    out_.objects.commit();
  }

  void note_bad(Issue issue) {
    if (++bad_ <= kListed) out_.issues.push_back(std::move(issue));
  }

  void sum_up() {
    const std::size_t listed = std::min(bad_, kListed) + std::min(doubles_, kListed);
    if (bad_ + doubles_ > listed)
      out_.issues.push_back({"file", std::to_string(bad_ + doubles_ - listed) + " more of these"});
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
    if (++doubles_ > kListed) return;
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

  /// Of a file in blobs: how much was read. The XML reader says line and column itself.
  std::string place() const { return bytes_ == 0 ? "" : ", within the first " + std::to_string(bytes_) + " bytes"; }

  const osmium::io::File& file_;
  const std::string& name_;
  const Progress& progress_;
  OsmFile out_;
  double size_ = 0, told_ = -1;
  std::size_t bytes_ = 0, bad_ = 0, doubles_ = 0;
};

}  // namespace

const OsmNode* OsmFile::find(std::int64_t id) const {
  const auto at = std::ranges::lower_bound(nodes, id, {}, &OsmNode::id);
  return at != nodes.end() && at->id == id ? &*at : nullptr;
}

OsmFile load_osm(const osmium::io::File& file, const std::string& name, const Progress& progress) {
  return Loader(file, name, progress).run();
}

std::string source_of(const osmium::OSMObject& object) {
  return std::string(osmium::item_type_to_name(object.type())) + "/" + std::to_string(object.id());
}

std::string where_of(const osmium::OSMObject& object) {
  static constexpr std::array<const char*, 9> kKeys{"building", "building:part", "highway", "waterway", "natural",
                                                    "landuse",  "leisure",       "amenity", "place"};
  const std::string where = plain_name(object);
  const auto key = std::ranges::find_if(kKeys, [&](const char* k) { return object.tags().has_key(k); });
  return key == kKeys.end() ? where : where + " (" + *key + ")";
}

}  // namespace manzana
