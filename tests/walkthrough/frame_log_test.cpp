#include "apps/walkthrough/frame_log.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "apps/walkthrough/headless.h"
#include "apps/walkthrough/summary.h"

using namespace manzana;
using namespace manzana::walkthrough;

namespace {

std::vector<FrameRow> rows_of(int n) {
  std::vector<FrameRow> rows(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    FrameRow& row = rows[static_cast<std::size_t>(i)];
    row.cull_us = 1 + i;
    row.update_us = 1000;
    row.draw_ms = 10 * (i + 1);
    row.triangles = 1000000000000ULL + static_cast<std::uint64_t>(i);
    row.tree_error_px = 2.25;
  }
  return rows;
}

}  // namespace

TEST_CASE("frames.csv: the head as agreed, and a row a frame") {
  CHECK(to_csv({}) ==
        "frame,cull_us,update_us,draw_ms,blocks_visible,buildings_visible,trees_visible,cars_visible,triangles,points,"
        "tree_error_px\n");
  const std::string csv = to_csv(rows_of(3));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 4);
  CHECK(csv.find("\n2,3.00,1000.00,30.000,0,0,0,0,1000000000002,0,2.250\n") != std::string::npos);
}

TEST_CASE("summary.json: holds what was agreed") {
  Options options;
  options.structure = Structure::none;
  Imported city;
  city.report.blocks = 7;
  city.report.objects = 99;
  city.report.seconds = 1.5;
  city.issues = {{"way 1", "x"}};
  city.scene.attribution = "\u00a9 someone";
  const auto rows = rows_of(100);
  const auto json = nlohmann::json::parse(summary_json(options, city, rows, {"GL", "fast", "pina", 123.5}));
  CHECK(json["structure"] == "none");
  CHECK(json["blocks"] == 7);
  CHECK(json["objects"] == 99);
  CHECK(json["buildings"] == 0);
  CHECK(json["trees"] == 0);
  CHECK(json["cars"] == 0);
  CHECK(json["import_s"] == 1.5);
  CHECK(json["issues"] == 1);
  CHECK(json["median"]["cull_us"] == 50);
  CHECK(json["median"]["draw_ms"] == 500);
  CHECK(json["median"]["triangles"] == 1000000000049.0);
  CHECK(json["median"]["frame_ms"] == Approx(501.05));
  CHECK(json["p99"]["draw_ms"] == 990);
  CHECK(json["renderer"] == "GL");
  CHECK(json["quality"] == "fast");
  CHECK(json["path"] == "pina");
  CHECK(json["memory_mb"] == 123.5);
  CHECK(json["attribution"] == "\u00a9 someone");
  CHECK(json["frames"] == 100);
}

TEST_CASE("summary.json: a file name that is no UTF-8 does not spoil it") {
  Options options;
  options.city = "caf\xe9.osm";
  const Imported empty;
  CHECK(nlohmann::json::accept(summary_json(options, empty, {}, {"", "", "", 0})));
}

TEST_CASE("frames spread the whole path") {
  const CameraPath path{"p", {{5, {}}, {15, {}}}};
  CHECK(path_time(path, 0, 300) == 5);
  CHECK(path_time(path, 299, 300) == 15);
  CHECK(path_time(path, 0, 1) == 5);
}
