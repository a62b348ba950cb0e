// One village in every container: the features are the same.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <osmium/io/any_compression.hpp>
#include <osmium/io/pbf_output.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/writer.hpp>
#include <osmium/io/xml_input.hpp>
#include <osmium/io/xml_output.hpp>

#include "tests/import/osm/written.h"

using namespace manzana;

namespace {

struct Container {
  const char *ending, *format;
};

std::filesystem::path written_as(const Container& container) {
  const auto path =
      std::filesystem::temp_directory_path() / ("manzana-village-" + std::to_string(::getpid()) + container.ending);
  osmium::io::Reader reader(VILLAGE_FILE);
  osmium::io::Writer writer(osmium::io::File(path.string(), container.format), osmium::io::overwrite::allow);
  while (osmium::memory::Buffer buffer = reader.read()) writer(std::move(buffer));
  writer.close();
  return path;
}

bool alike(const BuildingFeature& a, const BuildingFeature& b) {
  return a.where == b.where && a.footprint.outer == b.footprint.outer && a.footprint.holes == b.footprint.holes &&
         a.height == b.height && a.roof == b.roof && a.wall_rgb == b.wall_rgb && a.roof_rgb == b.roof_rgb;
}
bool alike(const StreetFeature& a, const StreetFeature& b) {
  return a.where == b.where && a.line == b.line && a.nodes == b.nodes && a.width == b.width && a.kind == b.kind;
}
bool alike(const TreeFeature& a, const TreeFeature& b) { return a.position == b.position && a.height == b.height; }
bool alike(const AreaFeature& a, const AreaFeature& b) { return a.where == b.where && a.shape.outer == b.shape.outer; }

template <class Features>
void check_alike(const Features& a, const Features& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!alike(a[i], b[i])) FAIL_CHECK("row " << i);
}

}  // namespace

TEST_CASE("plain, gzip, bzip2, and PBF with every kind of blob hold the same village") {
  const auto container = GENERATE(
      Container{".osm", "osm"}, Container{".osm.gz", "osm.gz"}, Container{".osm.bz2", "osm.bz2"},
      Container{".none.osm.pbf", "pbf,pbf_compression=none"}, Container{".zlib.osm.pbf", "pbf,pbf_compression=zlib"},
      Container{".lz4.osm.pbf", "pbf,pbf_compression=lz4"}, Container{".ways.osm.pbf", "pbf,pbf_dense_nodes=false"});
  CAPTURE(container.ending);
  const auto path = written_as(container);
  const CityFeatures as_xml = read_osm(VILLAGE_FILE, {}), city = read_osm(path, {});
  std::filesystem::remove(path);
  check_alike(city.buildings, as_xml.buildings);
  check_alike(city.streets, as_xml.streets);
  check_alike(city.trees, as_xml.trees);
  check_alike(city.areas, as_xml.areas);
  CHECK(city.issues.size() == as_xml.issues.size());
  CHECK(city.attribution == "© OpenStreetMap contributors");  // what the containers do not carry is assumed
}

TEST_CASE("a zero hidden in a text of a PBF file costs one object") {
  written::Written osm;
  osm.node(0, 0, {{"natural", "tree"}, {"note", "QQQQ"}});
  osm.node(9, 0, {{"natural", "tree"}});
  const auto path =
      std::filesystem::temp_directory_path() / ("manzana-zero-" + std::to_string(::getpid()) + ".osm.pbf");
  {
    const std::string xml = osm.xml();
    osmium::io::Reader reader(osmium::io::File(xml.data(), xml.size(), "osm"));
    osmium::io::Writer writer(osmium::io::File(path.string(), "pbf,pbf_compression=none"),
                              osmium::io::overwrite::allow);
    while (osmium::memory::Buffer buffer = reader.read()) writer(std::move(buffer));
    writer.close();
  }
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(path);
  const std::size_t at = bytes.find("QQQQ");
  REQUIRE(at != std::string::npos);
  bytes[at + 1] = '\0';
  const CityFeatures city = read_osm_bytes(bytes, "pbf", "zero");
  CHECK(city.trees.size() == 1);
  CHECK(written::listed(city, "node 1", "tags are damaged"));
}

TEST_CASE("the credit: OpenStreetMap's unless the file names another or says that it needs none") {
  CHECK(written::Written().read().attribution == "© OpenStreetMap contributors");
  CHECK(written::Written(" attribution='http://www.openstreetmap.org/copyright'").read().attribution ==
        "© OpenStreetMap contributors");
  CHECK(written::Written(" attribution='Town of X'").read().attribution == "Town of X");
  CHECK(written::Written(" attribution=''").read().attribution.empty());
}

TEST_CASE("a big file is read in its time") {
  // A tenth of the million nodes that must be read and built in 10 s.
  written::Written osm;
  for (int i = 0; i < 25000; ++i) {
    const double x = i % 160 * 30, y = i / 160 * 30;
    osm.way(i + 1, osm.ring({{x, y}, {x + 15, y}, {x + 15, y + 12}, {x, y + 12}}), {{"building", "yes"}});
  }
  const std::string xml = osm.xml();
  const std::clock_t start = std::clock();  // of the processor: other programs do not count
  const CityFeatures city = read_osm_bytes(xml, "osm", "grid");
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  CHECK(city.buildings.size() == 25000);
  WARN("100 000 nodes, 25 000 buildings: " << seconds << " s");
#ifdef NDEBUG  // sanitizers and debugging have their own price
  CHECK(seconds < 1);
#endif
}
