#include "foliage/import/species.h"

#include <catch2/catch.hpp>
#include <stdexcept>

using namespace manzana::foliage;

TEST_CASE("presets are read whole") {
  for (const std::string_view name : kSpeciesNames) CHECK(builtin_species(name).name == name);
  const SpeciesParams conifer = builtin_species("conifer");
  CHECK(conifer.levels == 2);
  CHECK(conifer.stems[1].branches == 96);
  CHECK(conifer.leaf_shape == "needle");
}

TEST_CASE("species JSON is read with defaults for what is absent") {
  const SpeciesParams s = parse_species(R"({"scale": 7.5, "leaf_rgb": "#0102fF", "stems": [{}, {"branches": 3}]})");
  CHECK(s.scale == 7.5F);
  CHECK(s.leaf_rgb == 0x0102ffU);
  CHECK(s.stems[1].branches == 3);
  CHECK(s.stems[1].taper == StemParams{}.taper);
  CHECK(s.levels == SpeciesParams{}.levels);
}

TEST_CASE("species errors name the key") {
  const struct {
    const char *json, *says;
  } cases[] = {
      {"", "species: "},
      {"[1]", "is not an object"},
      {"{\"scale\": 1", "species: "},
      {R"({"scael": 1})", "scael: unknown key"},
      {R"({"scale": "tall"})", "scale: is not a number"},
      {R"({"levels": 2.5})", "levels: is not a whole number"},
      {R"({"levels": 99999999999})", "levels: is out of range"},
      {R"({"levels": 18446744073709551615})", "levels: is out of range"},
      {R"({"name": 4})", "name: is not a string"},
      {R"({"leaf_rgb": "green"})", "leaf_rgb: is not a colour"},
      {R"({"leaf_rgb": "#12345g"})", "leaf_rgb: is not a colour"},
      {R"({"stems": {}})", "stems: is not an array"},
      {R"({"stems": [{}, {}, {}, {}, {}]})", "stems: has more than 4"},
      {R"({"stems": [{}, 3]})", "stems[1]: is not an object"},
      {R"({"stems": [{}, {}, {"curv": 1}]})", "stems[2].curv: unknown key"},
      {R"({"stems": [{"curve_res": true}]})", "stems[0].curve_res: is not a whole number"},
  };
  for (const auto& c : cases) {
    INFO(c.json);
    CHECK_THROWS_WITH(parse_species(c.json), Catch::Contains(c.says));
    CHECK_THROWS_AS(parse_species(c.json), std::runtime_error);
  }
}
