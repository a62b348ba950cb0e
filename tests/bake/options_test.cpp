#include "apps/bake/options.h"

#include <catch2/catch.hpp>

using namespace manzana::bake;

namespace {

Parsed parsed(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "manzana-bake");
  return parse_options(static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace

TEST_CASE("bake options: a plant, where to, and which L-system") {
  const Parsed plain = parsed({"plant", "oak.glb", "-o", "oak.plant"});
  REQUIRE(plain.options);
  CHECK(plain.options->source.file == "oak.glb");
  CHECK(plain.options->out == "oak.plant");
  const Parsed system = parsed({"plant", "--out", "b.plant", "abop.json#bush"});
  REQUIRE(system.options);
  CHECK(system.options->source.file == "abop.json");
  CHECK(system.options->source.system == "bush");
}

TEST_CASE("bake options: who counts what is seen") {
  CHECK(parsed({"plant", "a.glb", "-o", "a.plant"}).options->visibility == VisibilityBy::best);
  CHECK(parsed({"plant", "a.glb", "-o", "a.plant", "--visibility", "queries"}).options->visibility ==
        VisibilityBy::queries);
  const Parsed wrong = parsed({"plant", "a.glb", "-o", "a.plant", "--visibility", "eye"});
  CHECK(wrong.exit_code == 2);
  CHECK_THAT(wrong.text, Catch::Contains("is none of best, gpu, cpu, queries, none"));
}

TEST_CASE("bake options: help and version are 0, wrong usage is 2 and one line") {
  CHECK(parsed({"--help"}).exit_code == 0);
  CHECK_THAT(parsed({"plant", "--help"}).text, Catch::Contains("FILE#NAME"));
  CHECK_THAT(parsed({"--version"}).text, Catch::StartsWith("manzana-bake "));
  using Arguments = std::vector<const char*>;
  for (const Arguments& wrong : {Arguments{}, Arguments{"tree"}, Arguments{"plant"}, Arguments{"plant", "a.glb"},
                                 Arguments{"plant", "a.glb", "-o"}, Arguments{"plant", "a", "b", "-o", "c"}}) {
    const Parsed reply = parsed(wrong);
    CHECK(reply.exit_code == 2);
    CHECK(std::count(reply.text.begin(), reply.text.end(), '\n') == 1);
  }
}

TEST_CASE("bake options: a city to be imported") {
  const Parsed plain = parsed({"import", "a.osm.pbf", "-o", "a.manzana"});
  REQUIRE(plain.options);
  CHECK(plain.options->command == Command::city);
  CHECK(plain.options->city == "a.osm.pbf");
  CHECK(plain.options->import.cars == -1);
  CHECK(plain.options->import.attributes);
  const Parsed bare = parsed({"import", "a.city.json", "-o", "a.manzana", "--cars", "7", "--no-attributes"});
  REQUIRE(bare.options);
  CHECK(bare.options->import.cars == 7);
  CHECK_FALSE(bare.options->import.attributes);
}
