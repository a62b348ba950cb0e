// Orthophotos: where their pixels come to lie, whatever they are in, and what is told of those that cannot be used.
#include "scenegraph/import/read_photo.h"

#include <cpl_error.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "tests/import/gis/made_picture.h"
#include "tests/support/temporary_folder.h"

namespace {

using namespace manzana;

const GeoPoint kMiddle{60.17, 24.94, 0};
const culling::BoxD kCity{{-80, -60, 0}, {80, 60, 20}};

/// Up and down by 16 a metre: half a pixel of a metre changes a colour by 8.
int wave(double metres) { return 40 + static_cast<int>(std::lround(16 * std::abs(std::remainder(metres, 20)))); }

/// By metres to the north and to the east on the ground.
std::array<int, 4> known_colour(const GeoPoint& place) {
  return {wave((place.lat_deg - kMiddle.lat_deg) * 111412), wave((place.lon_deg - kMiddle.lon_deg) * 55529), 90, 255};
}

/// The largest difference from what belongs there, in the middle and away from the waves' turns.
int worst(const GroundPhoto& photo, const LocalFrame& frame) {
  const GroundPhoto::Level& level = photo.levels[0];
  int most = 0;
  for (std::uint32_t r = 0; r < level.rows; ++r)
    for (std::uint32_t c = 0; c < level.columns; ++c) {
      const GroundPhoto::Texel& t = level.texels[std::size_t{r} * level.columns + c];
      const Vec2d plan = photo.origin + photo.step * (Vec2d(c, r) + 0.5);
      const auto expected = known_colour(frame.to_geo({plan.x, plan.y, frame.ground_z(plan)}));
      const auto turns = [](int v) { return v < 66 || v > 174; };
      const bool outside = std::abs(plan.x) > 50 || std::abs(plan.y) > 40;
      if (outside || t[3] < 255 || turns(expected[0]) || turns(expected[1])) continue;
      for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(int{t[i]} - expected[i]));
    }
  return most;
}

double share_covered(const GroundPhoto& photo) {
  const auto& texels = photo.levels[0].texels;
  return static_cast<double>(std::ranges::count_if(texels, [](const auto& t) { return t[3] == 255; })) /
         static_cast<double>(texels.size());
}

}  // namespace

TEST_CASE("read photo: pixels lie where they belong in any reference system and turned") {
  const TemporaryFolder folder;
  const LocalFrame frame(kMiddle);
  struct Case {
    std::string system;
    double metres, turned;
  };
  for (const Case& c :
       {Case{"EPSG:32635", 1, 0}, Case{"EPSG:32635", 1, 33}, Case{"EPSG:3067", 0.7, -120}, Case{"EPSG:3857", 2, 0}}) {
    INFO(c.system << " turned by " << c.turned);
    MadePicture picture{.system = c.system};
    picture.to_place = placed_at(kMiddle, c.system, c.metres, c.turned, picture);
    write_picture(folder.path() / "a.tif", picture, c.system, known_colour);
    const GroundPhoto photo = read_ground_photo(folder.path() / "a.tif", frame, kCity, {});
    CHECK(photo.step == Approx(c.system == "EPSG:3857" ? 1 : c.metres).epsilon(0.02));
    CHECK(share_covered(photo) > 0.3);
    CHECK(worst(photo, frame) <= 3);  // rounding, and a wave is not linear in light
  }
}

TEST_CASE("read photo: degrees and world files of pictures without a reference system") {
  const TemporaryFolder folder;
  const LocalFrame frame(kMiddle);
  MadePicture degrees{.system = "EPSG:4326"};
  degrees.to_place = {kMiddle.lon_deg - 150 / 55529.0,  1 / 55529.0, 0,
                      kMiddle.lat_deg + 100 / 111412.0, 0,           -1 / 111412.0};
  write_picture(folder.path() / "a.tif", degrees, "EPSG:4326", known_colour);
  CHECK(worst(read_ground_photo(folder.path() / "a.tif", frame, kCity, {}), frame) <= 3);

  MadePicture world{.driver = "PNG"};
  world.to_place = placed_at(kMiddle, "EPSG:32635", 1, 0, world);
  write_picture(folder.path() / "a.png", world, "EPSG:32635", known_colour);
  CHECK(std::filesystem::exists(folder.path() / "a.wld"));
  std::filesystem::remove(folder.path() / "a.png.aux.xml");
  CHECK(worst(read_ground_photo(folder.path() / "a.png", frame, kCity, "EPSG:32635"), frame) <= 3);
  CHECK_THROWS_WITH(read_ground_photo(folder.path() / "a.png", frame, kCity, {}),
                    Catch::EndsWith("does not reach the city"));
}

TEST_CASE("read photo: alpha and no data leave the ground as it is") {
  const TemporaryFolder folder;
  const LocalFrame frame(kMiddle);
  const auto half = [](const GeoPoint& p) {
    const int here = p.lon_deg < kMiddle.lon_deg ? 0 : 255;
    return std::array<int, 4>{here / 2, 10, 10, here};
  };
  for (const int bands : {3, 4}) {
    MadePicture picture{.system = "EPSG:32635", .bands = bands, .void_value = bands == 3 ? 0.0 : -1.0};
    picture.to_place = placed_at(kMiddle, "EPSG:32635", 1, 0, picture);
    write_picture(folder.path() / "a.tif", picture, "EPSG:32635", half);
    const GroundPhoto photo = read_ground_photo(folder.path() / "a.tif", frame, kCity, {});
    CHECK(share_covered(photo) == Approx(0.46).margin(0.02));  // half of a picture that leans in its frame
    const double of_all = 0.46 * 255 * static_cast<double>(photo.levels[0].texels.size()) / (512 * 512);
    CHECK(photo.levels.back().texels[0][3] == Approx(of_all).margin(3));
    CHECK(photo.levels.back().texels.size() == 1);
  }
}

TEST_CASE("read photo: what cannot be used is told") {
  const TemporaryFolder folder;
  const LocalFrame frame(kMiddle);
  const auto message = [&](const char* name, const char* end) {
    const auto file = folder.path() / name;
    INFO(name);
    CHECK_THROWS_WITH(read_ground_photo(file, frame, kCity, {}),
                      Catch::StartsWith(file.string() + ": ") && Catch::Contains(end));
  };
  message("none.tif", "no such file");
  std::ofstream(folder.path() / "no.tif") << "II*";
  message("no.tif", "cannot be read");
  MadePicture picture{.system = "EPSG:32635"};
  picture.to_place = placed_at({61, 20, 0}, "EPSG:32635", 1, 0, picture);
  write_picture(folder.path() / "far.tif", picture, "EPSG:32635", known_colour);
  message("far.tif", "does not reach the city");
  picture.to_place = {};
  picture.system = {};
  write_picture(folder.path() / "nowhere.tif", picture, "EPSG:32635", known_colour);
  message("nowhere.tif", "does not say where it lies");
}

TEST_CASE("read photo: a file that is cut short is told, and GDAL prints nothing of its own") {
  static int messages;
  messages = 0;
  const TemporaryFolder folder;
  const auto file = folder.path() / "cut.tif";
  MadePicture picture{.system = "EPSG:32635"};
  picture.to_place = placed_at(kMiddle, "EPSG:32635", 1, 0, picture);
  write_picture(file, picture, "EPSG:32635", known_colour);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const CPLErrorHandler before = CPLSetErrorHandler([](CPLErr, CPLErrorNum, const char*) { ++messages; });
  CHECK_THROWS_WITH(read_ground_photo(file, LocalFrame(kMiddle), kCity, {}), Catch::StartsWith(file.string() + ": "));
  CPLSetErrorHandler(before);
  CHECK(messages == 0);
}
