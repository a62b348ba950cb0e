#include "foliage/import/lsystem.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/support/data.h"
#include "tests/support/temporary_folder.h"

using namespace manzana::foliage;

namespace {

LSystem system_of(std::string axiom, std::map<char, std::string> rules) {
  return {"test", std::move(axiom), std::move(rules), 90, 0, {}};
}

}  // namespace

TEST_CASE("L-systems of the book grow as it says") {
  const auto file = data_file("treeparam/lsystems.json");
  if (!file) return;
  const std::string text = read_all(*file);
  const auto expected = nlohmann::json::parse(text);
  const auto systems = parse_lsystems(text);
  CHECK(systems.size() == 5);
  for (const LSystem& system : systems) {
    INFO(system.name);
    const auto& entry = expected[system.name];
    CHECK(system.steps == entry["n"]);
    for (const auto& row : entry["expected"]) {
      const std::string string = derive(system, row["n"]);
      CHECK(string.size() == row["length"]);
      CHECK(std::count(string.begin(), string.end(), 'F') == row["F"]);
      CHECK(std::count(string.begin(), string.end(), '[') == row["brackets"]);
      CHECK(std::count(string.begin(), string.end(), ']') == row["brackets"]);
    }
  }
}

TEST_CASE("L-systems replace all symbols at once and keep those without a rule") {
  const LSystem algae = system_of("b", {{'a', "ab"}, {'b', "a"}});  // ABOP, section 1.2
  CHECK(derive(algae, 0) == "b");
  CHECK(derive(algae, 5) == "abaababa");
  CHECK(derive(system_of("a+[c]", {{'a', ""}}), 3) == "+[c]");
}

TEST_CASE("L-systems that explode are refused before they grow") {
  const auto said = [](const LSystem& system, int steps) {
    try {
      derive(system, steps);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(said(system_of("F", {{'F', "FF"}}), 30) ==
        "test: grows to 2097152 symbols in step 21 of 30; all steps together may have 4000000");
  CHECK_THAT(said(system_of("F", {{'F', std::string(64, 'F')}}), 30), Catch::Contains("grows to 16777216 symbols"));
  CHECK_THAT(said(system_of(std::string(5'000'000, 'F'), {}), 0), Catch::Contains("the axiom has 5000000 symbols"));
  CHECK_THAT(said(system_of(std::string(5000, 'F'), {}), 1000), Catch::Contains("in step"));
  CHECK(said(system_of("F", {{'F', "G"}, {'G', "F"}}), 1000).empty());
  CHECK(said(system_of("F", {{'F', "FF"}}), 20).empty());
}

TEST_CASE("L-system errors name the place") {
  const struct {
    const char *json, *says;
  } cases[] = {
      {"", "parse error"},
      {"[]", "no object of L-systems"},
      {R"({"a": 1})", "a: is not an object"},
      {R"({"a": {"rules": {}, "angle": 1, "n": 1}})", "a.axiom: is missing"},
      {R"({"a": {"axiom": "F", "n": 1}})", "a.angle: is missing"},
      {R"({"a": {"axiom": "F", "angle": 1}})", "a.n: is missing"},
      {R"({"a": {"axiom": 3, "angle": 1, "n": 1}})", "a.axiom: is not a string"},
      {R"({"a": {"axiom": "F", "angle": "NaN", "n": 1}})", "a.angle: is not a number"},
      {R"({"a": {"axiom": "F", "angle": 361, "n": 1}})", "a.angle: is out of range"},
      {R"({"a": {"axiom": "F", "angle": 1e999, "n": 1}})", "a"},
      {R"({"a": {"axiom": "F", "angle": 1, "n": -2}})", "a.n: is out of range"},
      {R"({"a": {"axiom": "F", "angle": 1, "n": 1001}})", "a.n: is out of range"},
      {R"({"a": {"axiom": "F", "angle": 1, "n": 1.5}})", "a.n: is not a whole number"},
      {R"({"a": {"axiom": "F", "angel": 1, "angle": 1, "n": 1}})", "a.angel: unknown key"},
      {R"({"a": {"axiom": "F]]]F", "rules": {"F": "F[F"}, "angle": "NaN", "n": -2}})",
       "a.axiom: ] without a [ before it, at symbol 2"},
      {R"({"a": {"axiom": "F", "rules": {"F": "F[[F]"}, "angle": 1, "n": 1}})", "a.rules.F: 1 [ without a ]"},
      {R"({"a": {"axiom": "F", "rules": {"FF": "F"}, "angle": 1, "n": 1}})", "a.rules.FF: is no symbol"},
      {R"({"a": {"axiom": "F", "rules": {"[": "F"}, "angle": 1, "n": 1}})", "a.rules.[: is no symbol"},
      {R"({"a": {"axiom": "F", "rules": {"F": 1}, "angle": 1, "n": 1}})", "a.rules.F: is not a string"},
      {R"({"a": {"axiom": "F", "rules": [], "angle": 1, "n": 1}})", "a.rules: is not an object"},
      {R"-({"a": {"axiom": "F(2)", "angle": 1, "n": 1}})-", "a.axiom: parameters are not read"},
      {R"({"a": {"axiom": "F\n", "angle": 1, "n": 1}})", "a.axiom: holds what is no printable ASCII, at symbol 2"},
      {R"({"a": {"axiom": "F", "angle": 1, "n": 1, "height_m": 0}})", "a.height_m: is out of range"},
      {R"({"a": {"axiom": "F", "angle": 1, "n": 1, "narrowing": 2}})", "a.narrowing: is out of range"},
      {R"({"a": {"axiom": "F", "angle": 1, "n": 1, "colours": []}})", "a.colours: holds none"},
      {R"({"a": {"axiom": "F", "angle": 1, "n": 1, "colours": ["red"]}})", "a.colours[0]: is not a colour"},
  };
  for (const auto& c : cases) {
    INFO(c.json);
    CHECK_THROWS_WITH(parse_lsystems(c.json), Catch::Contains(c.says));
    CHECK_THROWS_AS(parse_lsystems(c.json), std::runtime_error);
  }
}
