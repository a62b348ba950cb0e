// Every broken file ends with features and issues, or with one line; soon.
#include <catch2/catch.hpp>
#include <chrono>

#include "tests/import/cityjson/made.h"
#include "tests/support/data.h"

using namespace manzana;

namespace {

constexpr double kSecondsAllowed = 5;

struct Expected {
  const char* file;
  const char* error;  ///< part of the line; null: read
  std::size_t constructions;
  const char* what;  ///< of an issue
};

}  // namespace

TEST_CASE("broken CityJSON ends as it should") {
  // clang-format off
  const auto expected = GENERATE(
      Expected{"3dgi-invalid_missing_type.json", "no \"type\"", 0, nullptr},
      Expected{"3dgi-invalid_out_of_range_vertex_index.json", nullptr, 0, "vertex 99, and there are 3"},
      Expected{"bad-transform.city.json", "transform.scale", 0, nullptr},
      Expected{"cut-in-half.city.json", "line 1, column 3967", 0, nullptr},
      Expected{"cut-line.city.jsonl", nullptr, 2, "no JSON"},
      Expected{"deep-nesting.city.json", "nested deeper", 0, nullptr},
      Expected{"degenerate-ring.city.json", nullptr, 1, nullptr},  // told when it is triangulated
      Expected{"future-version.city.json", "CityJSON 9.7", 0, nullptr},
      Expected{"huge-coordinates.city.json", nullptr, 0, "not finite"},
      Expected{"nan.city.json", "line 1, column 4655", 0, nullptr},
      Expected{"no-crs.city.json", nullptr, 1, "no reference system"},
      Expected{"no-header.city.jsonl", "line 1 is no header", 0, nullptr},
      Expected{"parent-cycle.city.json", nullptr, 1, "parents go round"},
      Expected{"unknown-crs.city.json", "EPSG:999999", 0, nullptr},
      Expected{"vertex-index-negative.city.json", nullptr, 0, "vertex -1"},
      Expected{"vertex-index-out-of-range.city.json", nullptr, 0, "vertex 1000000"});
  // clang-format on
  CAPTURE(expected.file);
  const auto file = data_file(std::string("broken/cityjson/") + expected.file);
  if (!file) return;
  const auto start = std::chrono::steady_clock::now();
  std::string error;
  CityFeatures city;
  try {
    city = read_city(file->string(), {}, {});
  } catch (const std::runtime_error& e) {
    error = e.what();
  }
  CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < kSecondsAllowed);
  CAPTURE(error);
  REQUIRE(error.empty() == (expected.error == nullptr));
  if (expected.error != nullptr) {
    CHECK(error.starts_with(file->string() + ": "));
    CHECK(error.find(expected.error) != std::string::npos);
    CHECK(error.find('\n') == std::string::npos);
    return;
  }
  CHECK(city.constructions.size() == expected.constructions);
  if (expected.what != nullptr) CHECK(made::listed(city, "", expected.what));
}

TEST_CASE("no broken file of CityJSON is forgotten") {
  const auto folder = data_file("broken/cityjson");
  if (!folder) return;
  const auto files = std::distance(std::filesystem::directory_iterator(*folder), {});
  CHECK(files == 16);
}

TEST_CASE("a degenerate ring is told when its building is made") {
  const auto file = data_file("broken/cityjson/degenerate-ring.city.json");
  if (!file) return;
  const Imported city = import_city(file->string(), {}, {});
  CHECK(city.scene.buildings.table.size() == 1);
  REQUIRE(city.issues.size() == 1);
  CHECK(city.issues[0].what == "1 faces without area");
}
