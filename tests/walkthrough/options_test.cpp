#include "apps/walkthrough/options.h"

#include <catch2/catch.hpp>

using namespace manzana;
using namespace manzana::walkthrough;

namespace {

Parsed parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "manzana-walkthrough");
  return parse_options(static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace

TEST_CASE("options: no argument means the town in a window") {
  const Parsed parsed = parse({});
  REQUIRE(parsed.options);
  CHECK(parsed.options->city == "builtin:town");
  CHECK_FALSE(parsed.options->headless);
  CHECK(parsed.options->path == "tour");
  CHECK(parsed.options->frames == 300);
  CHECK(parsed.options->every == 30);
  CHECK(parsed.options->size.width == 1280);
  CHECK(parsed.options->size.height == 720);
  CHECK(parsed.options->structure == Structure::bqr);
  CHECK(parsed.options->out == "manzana-out");
  CHECK(parsed.options->cars == -1);
}

TEST_CASE("options: every option arrives") {
  const Parsed parsed = parse({"city.osm.pbf", "--headless",
                               "--path",       "pina",
                               "--frames",     "12",
                               "--every",      "5",
                               "--size",       "320x180",
                               "--structure",  "none",
                               "--out",        "somewhere",
                               "--quality",    "accurate",
                               "--seed",       "18446744073709551615",
                               "--cars",       "7",
                               "--plant",      "conifer=a=b.glb",
                               "--plant",      "shrub=c.glb"});
  REQUIRE(parsed.options);
  const Options& o = *parsed.options;
  CHECK(o.city == "city.osm.pbf");
  CHECK(o.headless);
  CHECK(o.path == "pina");
  CHECK(o.frames == 12);
  CHECK(o.every == 5);
  CHECK(o.size.width == 320);
  CHECK(o.size.height == 180);
  CHECK(o.structure == Structure::none);
  CHECK(o.out == "somewhere");
  CHECK(o.quality == "accurate");
  CHECK(o.seed == 18446744073709551615ULL);
  CHECK(o.cars == 7);
  REQUIRE(o.plants.size() == 2);
  CHECK(o.plants[0].species == PlantSpecies::conifer);
  CHECK(o.plants[0].file == "a=b.glb");
  CHECK(o.plants[1].species == PlantSpecies::shrub);
}

TEST_CASE("options: exact culls nothing unless asked to") {
  CHECK(parse({"--quality", "exact"}).options->structure == Structure::none);
  CHECK(parse({"--quality", "exact", "--structure", "bqr"}).options->structure == Structure::bqr);
  CHECK(parse({"--quality", "accurate"}).options->structure == Structure::bqr);
}

TEST_CASE("options: how much of trees is drawn") {
  const Parsed plain = parse({});
  REQUIRE(plain.options);
  CHECK(!plain.options->tree_law);
  CHECK(plain.options->wind);
  CHECK(plain.options->tree_ms == 0);
  CHECK_FALSE(plain.options->tree_error_px);
  const Parsed parsed = parse({"--tree-error", "2.5", "--tree-vertices", "300000", "--tree-ms", "12.5", "--tree-law",
                               "gumbau", "--dispatch", "node", "--no-wind"});
  REQUIRE(parsed.options);
  const Options& o = *parsed.options;
  CHECK(o.tree_error_px == 2.5);
  CHECK(o.tree_vertices == 300000);
  CHECK(o.tree_ms == 12.5);
  CHECK(o.tree_law == foliage::Law::prune);
  CHECK(o.trees_by_node);
  CHECK_FALSE(o.wind);
  for (const char* wrong : {"0", "-1", "nan", "much"}) CHECK(parse({"--tree-error", wrong}).exit_code == 2);
  for (const char* wrong : {"-1", "nan", "soon"}) CHECK(parse({"--tree-ms", wrong}).exit_code == 2);
  CHECK(parse({"--tree-law", "none"}).exit_code == 2);
}

TEST_CASE("options: the sun stands over the horizon") {
  const Parsed low = parse({"--sun", "-90,0"});
  REQUIRE(low.options);
  CHECK(low.options->sun_deg == std::array{-90.0, 0.0});
  CHECK(parse({"--sun", "135,90"}).options);
  for (const char* wrong : {"135,-1", "135,91", "135,nan", "361,20", "135", "1,2,3"})
    CHECK(parse({"--sun", wrong}).exit_code == 2);
  CHECK(parse({"--sun", "135,100"}).text.find("--sun") != std::string::npos);
}

TEST_CASE("options: wrong usage is one line and 2") {
  const std::vector<std::vector<const char*>> wrong = {
      {"--nonsense"},           {"--frames", "0"},        {"--frames", "many"},      {"--frames"},
      {"--every", "-1"},        {"--size", "1280"},       {"--size", "0x100"},       {"--size", "100x100x100"},
      {"--size", "100000x100"}, {"--structure", "rtree"}, {"--quality", "ultra"},    {"--seed", "-1"},
      {"--seed", "x"},          {"--cars", "-1"},         {"--plant", "fern=x.glb"}, {"--plant", "shrub="},
      {"--plant", "x.glb"},     {"one.osm", "two.osm"}};
  for (const auto& arguments : wrong) {
    const Parsed parsed = parse(arguments);
    CAPTURE(arguments.front(), arguments.back(), parsed.text);
    CHECK_FALSE(parsed.options);
    CHECK(parsed.exit_code == 2);
    CHECK(parsed.text.starts_with("manzana-walkthrough: "));
    CHECK(parsed.text.find('\n') == parsed.text.size() - 1);
  }
}

TEST_CASE("options: a message names the option") {
  CHECK(parse({"--size", "big"}).text.find("--size") != std::string::npos);
  CHECK(parse({"--plant", "fern=x.glb"}).text.find("fern=x.glb") != std::string::npos);
}

TEST_CASE("options: help and version are answers, not errors") {
  for (const char* ask : {"--help", "-h", "--version"}) {
    const Parsed parsed = parse({ask});
    CHECK_FALSE(parsed.options);
    CHECK(parsed.exit_code == 0);
    CHECK(parsed.text.find("manzana-walkthrough") != std::string::npos);
  }
  const std::string help = parse({"--help"}).text;
  for (const char* option : {"--headless", "--path", "--frames", "--every", "--size", "--structure", "--out",
                             "--quality", "--seed", "--cars", "--plant", "CITY"})
    CHECK(help.find(option) != std::string::npos);
}

TEST_CASE("options: several cities and lists of trees") {
  const Parsed parsed =
      parse({"a.osm", "--trees", "t.csv", "--add", "b.city.json", "--trees", "u.geojson", "--tree-columns",
             "lat=N,lon=E,species=Baum,height=H,crown=K", "--crs", "EPSG:28992", "--lod", "1.2"});
  REQUIRE(parsed.options);
  const Options& o = *parsed.options;
  CHECK(o.city == "a.osm");
  CHECK(o.more == std::vector<std::string>{"b.city.json"});
  REQUIRE(o.tree_lists.size() == 2);
  CHECK(o.tree_lists[1] == "u.geojson");
  CHECK(o.tree_columns.lat == "N");
  CHECK(o.tree_columns.lon == "E");
  CHECK(o.tree_columns.species == "Baum");
  CHECK(o.tree_columns.height == "H");
  CHECK(o.tree_columns.crown == "K");
  CHECK(o.reference_system == "EPSG:28992");
  CHECK(o.lod == 1.2);
  REQUIRE(parse({"--trees", "t.csv"}).options);
  CHECK(parse({"--trees", "t.csv"}).options->city.empty());
  CHECK(parse({"--trees", "t.csv", "--tree-columns", "tall=H"}).exit_code == 2);
  CHECK(parse({"--lod", "nan"}).exit_code == 2);
}

TEST_CASE("options: what is looked for is named by classes") {
  CHECK(parse({}).options->only == culling::kAllClasses);
  CHECK(parse({"--only", "building20,conifer"}).options->only == classes_named("building20 conifer"));
  const Parsed wrong = parse({"--only", "cow"});
  CHECK(wrong.exit_code == 2);
  CHECK_THAT(wrong.text, Catch::Contains("no class is called 'cow'"));
}
