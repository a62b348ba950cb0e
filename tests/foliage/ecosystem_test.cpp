#include "foliage/import/ecosystem.h"

#include <cmath>
#include <stdexcept>

#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;
using namespace manzana::foliage;

namespace {

class Files {
 public:
  Files() { write("herb.json", "{}"); }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_.path() / name).parent_path());
    std::ofstream(folder_.path() / name) << text;
  }
  Ecosystem read(const std::string& name) const { return read_ecosystem(folder_.path() / name); }
  std::string complaint(const std::string& text) const {
    write("a.json", text);
    try {
      read("a.json");
    } catch (const std::runtime_error& error) {
      const std::string said = error.what(), file = (folder_.path() / "a.json").string() + ": ";
      return said.starts_with(file) ? said.substr(file.size()) : said;
    }
    return "";
  }

 private:
  TemporaryFolder folder_;
};

std::vector<Placement> flattened(const Ecosystem& ecosystem) {
  std::vector<Placement> out;
  each_plant(
      ecosystem, [](auto, auto&) { return true; }, [&](auto, const Placement& at) { out.push_back(at); });
  return out;
}

}  // namespace

TEST_CASE("ecosystem: nested places are those of the matrices") {
  const Files files;
  files.write("in/one.json", R"({"instances": [{"plant": "herb.json", "at": [1, 0, 0.5], "turn": 30, "scale": 2}]})");
  files.write("two.json", R"({"instances": [{"ecosystem": "in/one.json", "at": [0, 3], "turn": 60, "scale": 0.5},
                                            {"plant": "herb.json#x"}]})");
  files.write("three.json", R"({"instances": [{"ecosystem": "two.json", "at": [10, 20], "turn": -90, "scale": 4}]})");
  const Ecosystem ecosystem = files.read("three.json");
  REQUIRE(ecosystem.nodes.size() == 3);
  CHECK(ecosystem.nodes.back().file == "three.json");
  CHECK(ecosystem.nodes.back().placed == 4);
  REQUIRE(ecosystem.plants.size() == 2);
  CHECK(ecosystem.plants[1].system == "x");
  const auto places = flattened(ecosystem);
  REQUIRE(places.size() == 2);
  // herb (0, 0, 1): one 1, 0, 2.5; two by 60 degrees and half; three by -90 degrees and four times.
  const Vec3d top = places[0](Vec3d(0, 0, 1));
  const double c = std::cos(M_PI / 3) / 2, s = std::sin(M_PI / 3) / 2;
  CHECK(glm::distance(top, Vec3d(10 + 4 * (3 + s), 20 - 4 * c, 4 * 1.25)) < 1e-12);
  CHECK(places[0].turn == Approx(0).margin(1e-12));
  CHECK(places[0].scale == Approx(4));
  CHECK(glm::distance(places[1].position, Vec3d(10, 20, 0)) < 1e-12);
}

TEST_CASE("ecosystem: the meadow holds its plants, the same every time, each file once") {
  const Ecosystem meadow = read_ecosystem(MANZANA_PLANTS "/meadow.json");
  CHECK(meadow.nodes.size() == 2);
  CHECK(meadow.plants.size() == 2);
  const auto places = flattened(meadow);
  CHECK(places.size() == 100 * 14 + 1500);
  double far = 0;
  for (const Placement& at : places) far = std::max(far, glm::length(at.position));
  CHECK(far > 12);
  CHECK(far <= 14);
  CHECK(flattened(read_ecosystem(MANZANA_PLANTS "/meadow.json"))[77].position == places[77].position);
  for (const PlantSource& plant : meadow.plants) check(load_plant(plant).plant);
}

TEST_CASE("ecosystem: balls hold everything within, and what is left out is not looked at") {
  const Ecosystem meadow = read_ecosystem(MANZANA_PLANTS "/meadow.json");
  const std::vector<Ball> plants(2, Ball{{0, 0, 0.3}, 0.5});
  const std::vector<Ball> balls = node_balls(meadow, plants);
  REQUIRE(balls.size() == 2);
  for (const Placement& at : flattened(meadow))
    CHECK(glm::distance(at(plants[0].centre), balls[1].centre) + at.scale * plants[0].radius <=
          balls[1].radius * (1 + 1e-12));
  // Plants whose ball meets x > 5: found by way of the nodes' balls, and one by one.
  const auto meets = [](const Ball& ball, const Placement& at) {
    return at(ball.centre).x + at.scale * ball.radius > 5;
  };
  std::size_t found = 0, looked = 0, expected = 0;
  each_plant(
      meadow, [&](std::uint32_t node, const Placement& at) { return meets(balls[node], at); },
      [&](std::uint32_t plant, const Placement& at) { ++looked, found += meets(plants[plant], at) ? 1 : 0; });
  for (const Placement& at : flattened(meadow)) expected += meets(plants[0], at) ? 1 : 0;
  CHECK(found == expected);
  CHECK(looked < flattened(meadow).size());
  CHECK(node_balls(meadow, std::vector<Ball>(2)).back().radius < 0);
}

TEST_CASE("ecosystem: what is wrong is named by its file and place") {
  const Files files;
  files.write("b.json", R"({"instances": [{"ecosystem": "a.json"}]})");
  files.write("c.json", R"({"instances": [{"plant": "herb.json", "scal": 2}]})");
  const auto with = [&](const std::string& instance) { return files.complaint("{\"instances\": [" + instance + "]}"); };
  CHECK(with("").empty());
  CHECK(files.complaint("{}").empty());
  CHECK(files.complaint("[]") == "the whole: is not an object");
  CHECK(with("{}") == "instances[0]: names neither a plant nor an ecosystem, or both");
  CHECK(with(R"({"plant": "a", "ecosystem": "b"})") == "instances[0]: names neither a plant nor an ecosystem, or both");
  CHECK(with(R"({"plant": "none.json"})") == "refers to the plant none.json, which is absent");
  CHECK(with(R"({"plant": "../herb.json"})") == "refers to ../herb.json, outside its folder");
  CHECK(with(R"({"ecosystem": "/etc/passwd"})") == "refers to /etc/passwd, outside its folder");
  CHECK(with(R"({"ecosystem": "none.json"})") == "none.json: no such file");
  CHECK(with(R"({"ecosystem": "a.json"})") == "refers to a.json, which leads back to it");
  CHECK(with(R"({"ecosystem": "b.json"})") == "b.json: refers to a.json, which leads back to it");
  CHECK(with(R"({"ecosystem": "c.json"})") == "c.json: instances[0].scal: unknown key");
  CHECK(with(R"({"plant": "herb.json", "at": [1]})") == "instances[0].at: is not two or three numbers");
  CHECK(with(R"({"plant": "herb.json", "at": [1, "2"]})") == "instances[0].at: is not a number");
  CHECK(with(R"({"plant": "herb.json", "at": [1, 1e7]})") == "instances[0].at: is out of range");
  CHECK(with(R"({"plant": "herb.json", "scale": 0})") == "instances[0].scale: is out of range");
  CHECK(with(R"({"plant": "herb.json", "scatter": {"count": 3}})") == "instances[0].scatter.radius: is missing");
  CHECK(with(R"({"plant": "herb.json", "scatter": {"count": -3, "radius": 1}})") ==
        "instances[0].scatter.count: is out of range");
}

TEST_CASE("ecosystem: chains that are too deep or too many are refused before they are flattened") {
  const Files files;
  const auto name = [](int i) { return std::string("n").append(std::to_string(i)).append(".json"); };
  const auto chain = [&](int length, const std::string& last, int count) {
    for (int i = 1; i < length; ++i) {
      std::ostringstream text;
      text << R"({"instances": [{"ecosystem": ")" << name(i + 1) << R"(", "scatter": {"count": )" << count
           << R"(, "radius": 1}}]})";
      files.write(name(i), text.str());
    }
    files.write(name(length), "{\"instances\": [" + last + "]}");
    return files.complaint(R"({"instances": [{"ecosystem": "n1.json"}]})");
  };
  CHECK(chain(62, R"({"plant": "herb.json"})", 1).empty());
  CHECK_THAT(chain(64, R"({"plant": "herb.json"})", 1), Catch::EndsWith("nested deeper than 64"));
  CHECK_THAT(chain(20, R"({"plant": "herb.json"})", 100), Catch::EndsWith("more than 16000000 plants in all"));
  const std::string many = R"({"plant": "herb.json", "scatter": {"count": 1000000, "radius": 1}})";
  CHECK(chain(2, many, 1) == "n2.json: instances[0]: more than 1000000 instances in all files together");
  CHECK_THAT(chain(20, "", 100), Catch::EndsWith("more than 16000000 plants in all"));  // of nothing, over and over
}
