// Colours of surfaces: of materials by their themes, and the means of the parts of pictures that they wear.
#include "scenegraph/import/cityjson_looks.h"

#include <catch2/catch.hpp>

#include "apps/common/png.h"
#include "tests/import/cityjson/made.h"
#include "tests/support/data.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;
using made::Json;
using namespace cityjson;

namespace {

using Ring = std::vector<Vec2d>;
const Ring kAll{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

/// Left half 200, 0, 0, right half 0, 0, 100; the upper row of the left half clear.
foliage::Picture two_halves() {
  foliage::Picture picture{4, 4, {}};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      for (const int c : {x < 2 ? 200 : 0, 0, x < 2 ? 0 : 100, x < 2 && y == 0 ? 0 : 255})
        picture.rgba.push_back(static_cast<std::uint8_t>(c));
  return picture;
}

Ring rectangle(double u0, double v0, double u1, double v1) { return {{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}}; }

/// A house whose roof wears all of picture 0, its third face (a wall) the left half of picture 1.
Json textured(const std::string& roof, const std::string& wall) {
  Json json = made::one_building();
  json["appearance"] = {{"textures", {{{"type", "PNG"}, {"image", roof}}, {{"type", "PNG"}, {"image", wall}}}},
                        {"vertices-texture", {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0}, {0.5, 1}}}};
  const auto wears = [](std::initializer_list<int> ring) { return Json::array({Json(ring)}); };
  const Json nothing = Json::array({Json::array({nullptr})});
  json["CityObjects"]["house"]["geometry"][0]["texture"] = {
      {"seen",
       {{"values", Json::array({Json::array(
                       {nothing, wears({0, 0, 1, 2, 3}), wears({1, 0, 4, 5, 3}), nothing, nothing, nothing})})}}}};
  return json;
}

CityFeatures read_in(const Json& json, const std::filesystem::path& folder) {
  return read_cityjson_bytes(json.dump(), false, {}, {}, folder);
}

void write_plain(const std::filesystem::path& file, unsigned char r, unsigned char g, unsigned char b) {
  std::vector<unsigned char> rgb;
  for (int i = 0; i < 64; ++i) rgb.insert(rgb.end(), {r, g, b});
  apps::write_png(file, 8, 8, rgb);
}

}  // namespace

TEST_CASE("the mean of a picture's part is that of its light and of what is not clear") {
  const foliage::Picture picture = two_halves();
  const auto mean = [&](const OnPicture& part) { return mean_colour(picture, part); };
  CHECK(mean({0, Wrap::repeat, {rectangle(0.02, 0.02, 0.48, 0.7)}}) == 0xc80000);
  CHECK(mean({0, Wrap::repeat, {rectangle(0.52, 0, 1, 1)}}) == 0x000064);
  CHECK(mean({0, Wrap::repeat, {rectangle(0, 0.8, 0.4, 1)}}) == kNone);         // clear: v is up
  CHECK(mean({0, Wrap::repeat, {rectangle(0, 0, 1, 0.5)}}) == 0x920047);        // half of the light, not of the bytes
  CHECK(mean({0, Wrap::repeat, {kAll, rectangle(0, 0, 0.5, 1)}}) == 0x000064);  // a hole
  CHECK(mean({0, Wrap::repeat, {rectangle(3.55, -2, 3.95, -1)}}) == 0x000064);
  CHECK(mean({0, Wrap::mirror, {rectangle(1.05, 0, 1.45, 1)}}) == 0x000064);
  CHECK(mean({0, Wrap::clamp, {rectangle(1.05, 0, 1.45, 1)}}) == 0x000064);
  CHECK(mean({0, Wrap::clamp, {rectangle(-9, 0, -8, 0.5)}}) == 0xc80000);
  CHECK(mean({0, Wrap::repeat, {{{0.1, 0.1}, {0.4, 0.1}, {0.2, 0.1}}}}) == 0xc80000);  // a line
  CHECK(mean({0, Wrap::repeat, {}}) == kNone);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(mean({0, Wrap::repeat, {{{0, 0}, {nan, 0}, {1, 1}}}}) == kNone);
  CHECK(mean({0, Wrap::repeat, {rectangle(0, 0, 1e30, 1)}}) == kNone);
}

TEST_CASE("the mean is of what lies beyond the edges too") {
  const foliage::Picture picture = two_halves();
  const auto mean = [&](Wrap wrap, std::uint32_t border) {
    return mean_colour(picture, {0, wrap, {rectangle(1, 0, 3, 0.5)}, border});
  };
  CHECK(mean(Wrap::border, 0xff0000c8) == 0xc80000);
  CHECK(mean(Wrap::border, 0x000000c8) == kNone);
  CHECK(mean(Wrap::none, 0xff0000c8) == kNone);
  CHECK(mean(Wrap::clamp, 0xff0000c8) == 0x000064);
}

TEST_CASE("surfaces get the colour of the picture that they wear and keep theirs where there is none") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "looks");
  write_plain(folder.path() / "looks/roof.png", 10, 200, 30);
  const CityFeatures city = read_in(textured("looks/roof.png", "looks/wall.png"), folder.path());
  REQUIRE(city.constructions.size() == 1);
  const auto& faces = city.constructions[0].faces;
  CHECK(faces[1].rgb == 0x0ac81e);
  CHECK(faces[1].kind == Material::roof);
  CHECK(faces[2].rgb == faces[3].rgb);  // wall.png is absent
  CHECK(made::listed(city, "appearance", "1 of 2 pictures"));

  write_plain(folder.path() / "looks/wall.png", 1, 2, 3);
  CHECK(read_in(textured("looks/roof.png", "looks/wall.png"), folder.path()).constructions[0].faces[2].rgb == 0x010203);
  const CityFeatures alone = made::read(textured("looks/roof.png", "looks/wall.png"));
  CHECK(alone.constructions[0].faces[1].rgb != 0x0ac81e);
  CHECK(made::listed(alone, "texture", "read without others"));
}

TEST_CASE("pictures outside the folder are not read nor those that are none") {
  const TemporaryFolder folder;
  const auto inner = folder.path() / "inner";
  std::filesystem::create_directories(inner);
  write_plain(folder.path() / "secret.png", 9, 9, 9);
  std::filesystem::create_symlink(folder.path() / "secret.png", inner / "link.png");
  const std::string outside = (folder.path() / "secret.png").string();
  for (const std::string& image : {std::string("../secret.png"), outside, std::string("link.png")}) {
    const CityFeatures city = read_in(textured(image, image), inner);
    CAPTURE(image);
    CHECK(city.constructions[0].faces[1].rgb != 0x090909);
    CHECK(made::listed(city, "texture", "outside its folder"));
  }
  std::ofstream(inner / "text.png") << "no picture";
  CHECK(made::listed(read_in(textured("text.png", "text.png"), inner), "texture", "neither PNG nor JPEG"));
}

TEST_CASE("of several themes each surface has the default's or else the first that says something") {
  Json json = made::one_building();
  json["appearance"] = {{"default-theme-material", "winter"},
                        {"materials",
                         {{{"diffuseColor", {1.0, 0.0, 0.0}}},
                          {{"diffuseColor", {0.0, 1.0, 0.0}}},
                          {{"diffuseColor", {0.0, 0.0, 1.0}}},
                          {{"diffuseColor", "red"}}}}};
  json["CityObjects"]["house"]["geometry"][0]["material"] = {
      {"autumn", {{"values", {{0, 0, nullptr, nullptr, 3, nullptr}}}}},
      {"summer", {{"value", 1}}},
      {"winter", {{"values", {{2, nullptr, nullptr, 2, nullptr, nullptr}}}}}};
  const CityFeatures city = made::read(json);
  const auto& faces = city.constructions.at(0).faces;
  const std::vector<std::uint32_t> expected{0x0000ff, 0xff0000, 0x00ff00, 0x0000ff, 0x00ff00, 0x00ff00};
  for (std::size_t f = 0; f < faces.size(); ++f) CHECK(faces[f].rgb == expected[f]);
  CHECK(made::listed(city, "material 3", "diffuseColor"));
}

TEST_CASE("features of a sequence have looks of their own and templates those of the header") {
  Json header = made::city();
  header["appearance"] = {{"materials", {{{"diffuseColor", {1.0, 0.0, 0.0}}}}}};
  Json shape = made::solid();
  shape["material"] = {{"", {{"value", 0}}}};
  header["geometry-templates"] = {{"templates", {shape}},
                                  {"vertices-templates", made::box_vertices({0, 0, 0}, {4, 4, 4})}};
  Json feature = {{"type", "CityJSONFeature"}, {"id", "own"}, {"CityObjects", Json::object()}};
  feature["vertices"] = made::box_vertices({691000, 5334000, 412}, {691010, 5334008, 418});
  feature["appearance"] = {{"materials", {{{"diffuseColor", {0.0, 1.0, 0.0}}}}}};
  Json geometry = made::solid();
  geometry["material"] = {{"", {{"value", 0}}}};
  feature["CityObjects"]["own"] = {{"type", "Building"}, {"geometry", {geometry}}};
  feature["CityObjects"]["placed"] = {
      {"type", "OtherConstruction"},
      {"geometry",
       {{{"type", "GeometryInstance"},
         {"template", 0},
         {"boundaries", {0}},
         {"transformationMatrix", {1, 0, 0, 30, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}}}};
  const CityFeatures city = read_cityjson_bytes(header.dump() + "\n" + feature.dump() + "\n", true, {}, {});
  REQUIRE(city.constructions.size() == 2);
  CHECK(city.constructions[0].faces[2].rgb == 0x00ff00);
  CHECK(city.constructions[1].faces[2].rgb == 0xff0000);
}

TEST_CASE("the one picture that lies beside Rotterdam colours the surface that wears it") {
  const auto file = data_file("citymodel/rotterdam-textured/rotterdam_subset.json");
  if (!file) return;
  const CityFeatures city = read_cityjson(*file, {.reference_system = "EPSG:28992"}, {});
  CHECK(made::listed(city, "appearance", "73 of 74 pictures"));
  const CityFeatures plain = made::read(Json::parse(std::ifstream(*file)), {.reference_system = "EPSG:28992"});
  std::size_t other = 0;
  for (std::size_t w = 0; w < city.constructions.size(); ++w)
    for (std::size_t f = 0; f < city.constructions[w].faces.size(); ++f)
      other += city.constructions[w].faces[f].rgb != plain.constructions[w].faces[f].rgb ? 1 : 0;
  CHECK(other == 1);
}

TEST_CASE("corners know their place on the picture that is there once however it is named") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "looks");
  write_plain(folder.path() / "looks/wall.png", 10, 200, 30);
  Json json = textured("looks/wall.png", "./looks/../looks/wall.png");
  json["appearance"]["textures"][1]["wrapMode"] = "border";
  json["appearance"]["textures"][1]["borderColor"] = {0, 1, 0.2, 0.4};
  json["appearance"]["vertices-texture"][5] = {0.5, 1.5};
  const CityFeatures city = read_in(json, folder.path());
  REQUIRE(city.pictures.encoded.size() == 1);
  CHECK(city.pictures.encoded[0].name == "looks/wall.png");
  CHECK(city.pictures.encoded[0].width == 8);
  CHECK(city.pictures.encoded[0].worn == PicturePart{0, 0, 8, 8});
  const std::vector<Texture> expected{{0, Wrap::clamp, 0}, {0, Wrap::border, 0x6633ff00}};
  CHECK(city.pictures.textures == expected);
  const ConstructionFeature& house = city.constructions.at(0);
  const std::vector<std::uint32_t> worn{0, 1, 2, 0, 0, 0};
  for (std::size_t f = 0; f < worn.size(); ++f) CHECK(house.faces[f].texture == worn[f]);
  REQUIRE(house.uv.size() == house.corners.size());
  const std::vector<Vec2> places{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {0.5, 0}, {0.5, 1.5}, {0, 1}};
  for (std::size_t i = 0; i < places.size(); ++i) CHECK(house.uv[4 + i] == places[i]);
}

TEST_CASE("places keep to their corners where a ring names a vertex twice") {
  const TemporaryFolder folder;
  write_plain(folder.path() / "a.png", 1, 2, 3);
  Json json = textured("a.png", "a.png");
  json["CityObjects"]["house"]["geometry"][0]["boundaries"][0][1] = {{4, 5, 5, 7, 6, 4}};
  auto& values = json["CityObjects"]["house"]["geometry"][0]["texture"]["seen"]["values"];
  values[0][1] = {{0, 0, 1, 4, 2, 3, 0}};
  const ConstructionFeature house = read_in(json, folder.path()).constructions.at(0);
  const std::vector<Vec2> places{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (std::size_t i = 0; i < 4; ++i) CHECK(house.uv[4 + i] == places[i]);
  values[0][1] = {{0, 0, 1, 2}};  // fewer places than corners: no picture, but its mean
  const ConstructionFeature other = read_in(json, folder.path()).constructions.at(0);
  CHECK(other.faces[1].texture == 0);
  CHECK(other.faces[1].rgb == 0x010203);
  values[0][1] = {{0, 0, 1, 2, 3, 6, 0}};  // there is no place 6
  CHECK(read_in(json, folder.path()).constructions.at(0).faces[1].texture == 0);
  json["appearance"]["vertices-texture"][2] = {1e300, 0};
  values[0][1] = {{0, 0, 1, 4, 2, 3, 0}};
  CHECK(read_in(json, folder.path()).constructions.at(0).faces[1].texture == 0);
}

TEST_CASE("of a picture the part that is worn is kept with a pixel around it") {
  const TemporaryFolder folder;
  write_plain(folder.path() / "a.png", 1, 2, 3);
  Json json = textured("absent.png", "a.png");
  json["appearance"]["vertices-texture"] = {{0.5, 0.25}, {1, 0}, {1, 1}, {0.5, 0.375}, {0.75, 0.25}, {0.75, 0.375}};
  CHECK(read_in(json, folder.path()).pictures.encoded.at(0).worn == PicturePart{3, 4, 4, 3});
}
