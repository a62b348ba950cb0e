// Texts of tags to numbers and colours.
#include "scenegraph/import/osm_values.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

using namespace manzana;

TEST_CASE("lengths as people type them") {
  struct Row {
    const char* text;
    double metres;
  };
  const auto row = GENERATE(
      Row{"12", 12}, Row{"12.5", 12.5}, Row{"12,5", 12.5}, Row{"  9  ", 9}, Row{"12 m", 12}, Row{"12m", 12},
      Row{"1.2 km", 1200}, Row{"40 ft", 12.192}, Row{"40'", 12.192}, Row{"40'6\"", 12.3444}, Row{"40' 6\"", 12.3444},
      Row{"40 ft 6 in", 12.3444}, Row{"6\"", 0.1524}, Row{"1e9", 1e9}, Row{"-5", -5}, Row{"+3", 3}, Row{".5", 0.5},
      Row{"1 mi", 1609.344}, Row{"2.00 Meters", 2}, Row{"30 cm", 0.3}, Row{"1e-12", 1e-12}, Row{"5 ft.", 1.524});
  CAPTURE(row.text);
  const auto metres = parse_length(row.text);
  REQUIRE(metres);
  CHECK(*metres == Approx(row.metres).epsilon(1e-12));
}

TEST_CASE("texts that are no length") {
  const char* text = GENERATE("", " ", "tall", "NaN", "nan", "inf", "-inf", "12;15", "12-15", "1e400", "12 stories",
                              "m", "5 6", "6\" 40'", "1.2.3", "--5", "0x10", "12 m 3 m", "1,000.5", "~12", "e5",
                              "40'-6\"", "999999999999999999999999e999");
  CAPTURE(text);
  CHECK_FALSE(parse_length(text));
}

TEST_CASE("any text gives a finite length or none") {
  CHECK(rc::check("parse_length", [](const std::string& text) {
    const auto metres = parse_length(text);
    RC_ASSERT(!metres || std::isfinite(*metres));
  }));
  CHECK(rc::check("numbers come back", [] {
    const double value = *rc::gen::inRange(-1000000, 1000000) / 64.0;
    RC_ASSERT(parse_number(std::to_string(value)) == value);  // six decimals hold a 64th exactly
  }));
}

TEST_CASE("colours by name and by number") {
  CHECK(parse_colour("red") == 0xff0000u);
  CHECK(parse_colour("Light Grey") == 0xd3d3d3u);
  CHECK(parse_colour("light_grey") == 0xd3d3d3u);
  CHECK(parse_colour("aliceblue") == 0xf0f8ffu);    // the first of the table
  CHECK(parse_colour("yellowgreen") == 0x9acd32u);  // the last
  CHECK(parse_colour("rebeccapurple") == 0x663399u);
  CHECK(parse_colour("#8A2") == 0x88aa22u);
  CHECK(parse_colour("#8Aa2f0") == 0x8aa2f0u);
  CHECK(parse_colour("8aa2f0") == 0x8aa2f0u);
  for (const char* text : {"", "#", "#12", "#12345", "#1234567", "#ggg", "reddish", "abc", "red;blue"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_colour(text));
  }
}

TEST_CASE("every name of the tables is found: they are sorted") {
  for (const char* name :
       {"black", "gold", "maroon", "navy", "tan", "white", "beige", "sienna", "wheat", "grey", "gray"})
    CHECK(parse_colour(name));
  for (const char* name :
       {"adobe", "brick", "concrete", "glass", "wood", "zinc", "roof_tiles", "slate", "stone", "plaster"})
    CHECK(material_colour(name));
  CHECK_FALSE(material_colour("yes"));
}
