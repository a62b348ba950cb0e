#include "foliage/import/turtle.h"

#include <algorithm>
#include <stdexcept>

#include "tests/foliage/plant_checks.h"
#include "tests/support/data.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;
using namespace manzana::foliage;

namespace {

/// One step is one metre where the string rises to `height`.
Plant drawn(const std::string& axiom, double height, double angle = 90) {
  LSystem system{"test", axiom, {}, angle, 0, {}};
  system.look.height_m = height;
  system.look.radius_m = 0.01;
  Plant plant = grow_plant(system);
  check(plant);
  return plant;
}

Vec3 tip(const Plant& plant, std::size_t branch) {
  return plant.centre_lines[plant.branches[branch].line.last - 1].position;
}

bool near(const Vec3& a, const Vec3& b) { return glm::distance(a, b) < 1e-5F; }

std::string complaint(const std::string& axiom) {
  try {
    drawn(axiom, 1);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

double leaf_area(const Plant& plant) {
  double sum = 0;
  const auto& leaves = plant.mesh.leaves;
  for (std::size_t i = 0; i + 2 < leaves.indices.size(); i += 3) {
    const Vec3 a = leaves.vertices[leaves.indices[i]].position;
    sum += 0.5 * static_cast<double>(glm::length(glm::cross(leaves.vertices[leaves.indices[i + 1]].position - a,
                                                            leaves.vertices[leaves.indices[i + 2]].position - a)));
  }
  return sum;
}

}  // namespace

TEST_CASE("turtle: it turns, pitches and rolls as its words say") {
  // At the start: heading up, left along x, up along y.
  CHECK(near(tip(drawn("F", 1), 0), {0, 0, 1}));
  CHECK(near(tip(drawn("F+F", 1), 0), {1, 0, 1}));
  CHECK(near(tip(drawn("F-F", 1), 0), {-1, 0, 1}));
  CHECK(near(tip(drawn("F^F", 1), 0), {0, 1, 1}));
  CHECK(near(tip(drawn("F&F", 1), 0), {0, -1, 1}));
  CHECK(near(tip(drawn("F\\+F", 1), 0), {0, -1, 1}));  // the left side goes down
  CHECK(near(tip(drawn("F/+F", 1), 0), {0, 1, 1}));
  CHECK(near(tip(drawn("FF+F|F|F", 2), 0), {1, 0, 2}));
  CHECK(near(tip(drawn("F&/$+F", 1), 0), {1, 0, 1}));  // level again, so left is across the heading
}

TEST_CASE("turtle: branches have their parents, levels and centre lines") {
  const Plant plant = drawn("FF[+F[+F]]F[-F]-F", 3);
  REQUIRE(plant.branches.size() == 4);
  CHECK(plant.branches[0].parent == -1);
  CHECK(plant.branches[1].parent == 0);
  CHECK(plant.branches[2].parent == 1);
  CHECK(plant.branches[3].parent == 0);
  const auto level = [&](std::size_t i) { return plant.branches[i].level; };
  CHECK((level(0) == 0 && level(1) == 1 && level(2) == 2 && level(3) == 1));
  CHECK(near(tip(plant, 0), {-1, 0, 3}));
  CHECK(near(plant.centre_lines[plant.branches[1].line.first].position, {0, 0, 2}));
  CHECK(near(tip(plant, 1), {1.01F, 0, 2}));  // its tip forks: capped by its radius
  CHECK(near(tip(plant, 2), {1, 0, 1}));
  CHECK(plant.branches[0].line.size() == 3);  // what is straight is one piece
}

TEST_CASE("turtle: a gap begins another branch of the same level") {
  const Plant plant = drawn("F[fF]fF", 3);
  REQUIRE(plant.branches.size() == 3);
  CHECK(plant.branches[1].level == 1);
  CHECK(plant.branches[2].level == 0);
  CHECK(plant.branches[2].parent == 0);
}

TEST_CASE("turtle: the diameter narrows within a branch and only there") {
  const Plant plant = drawn("F[!F]F!F", 3);
  const auto radius_at = [&](std::size_t branch, std::uint32_t i) {
    return plant.centre_lines[plant.branches[branch].line.first + i].radius;
  };
  CHECK(radius_at(0, 0) == Approx(0.01));
  CHECK(radius_at(0, 1) == Approx(0.007));
  CHECK(radius_at(1, 0) == Approx(0.007));
}

TEST_CASE("turtle: polygons are terminals on their branch") {
  const Plant plant = drawn("F[+F{+f+f+f}]{.f+f+f.}~L~K", 2);
  REQUIRE(plant.terminals.size() == 4);
  CHECK(plant.terminals[0].branch == 1);
  CHECK(plant.terminals[1].branch == 0);
  CHECK(plant.terminals[2].organ == Organ::leaf);
  CHECK(plant.terminals[3].organ == Organ::flower);
  CHECK(plant.branches.size() == 2);
  CHECK(leaf_area(drawn("F{.f+f+f+f}", 2)) == Approx(1));
  CHECK(leaf_area(drawn("F{[++G.][+G.]G.}", 2)) == Approx(1));  // vertices from inside brackets
  CHECK(drawn("F{f}{}{ff|f}", 2).terminals.empty());            // without area
}

TEST_CASE("turtle: colours go on and stay at the last") {
  LSystem system{"test", "F~L'~L''''~L", {}, 90, 0, {}};
  system.look.colours = {0xff0000, 0x00ff00};
  const Plant plant = grow_plant(system);
  const auto colour = [&](std::size_t terminal) {
    const MeshPart& leaves = plant.mesh.leaves;
    const Vec2 uv = leaves.vertices[leaves.indices[3 * plant.terminals[terminal].triangles.first]].uv;
    const auto texel = static_cast<std::size_t>(uv.x * 256);
    return plant.leaf_image.rgba[4 * texel] > 128 ? 'r' : 'g';
  };
  CHECK((colour(0) == 'r' && colour(1) == 'g' && colour(2) == 'g'));
}

TEST_CASE("turtle: percent drops the rest of the branch") {
  CHECK(drawn("F[+F%F[F]F]F", 2).branches.size() == 2);
  CHECK(drawn("F%[+F]", 1).branches.size() == 1);
}

TEST_CASE("turtle: what cannot be drawn is refused in one line") {
  CHECK(complaint("F]") == "test: symbol 2: ] without a [");
  CHECK(complaint("[F") == "test: symbol 3: [ without a ]");
  CHECK(complaint("F}") == "test: symbol 2: } without a {");
  CHECK(complaint("{f+f") == "test: symbol 5: { without a }");
  CHECK(complaint("F~A") == "test: symbol 3: there is no surface ~A, only ~L and ~K");
  CHECK_THAT(complaint("F~"), Catch::Contains("there is no surface"));
  CHECK(complaint("+[X]") == "test: its string draws nothing");
  CHECK_THAT(complaint(std::string(20'000, '[') + std::string(20'000, ']')), Catch::Contains("nested deeper"));
  std::string zigzag;
  for (int i = 0; i < 200'000; ++i) zigzag += "F+F-";
  CHECK_THAT(complaint(zigzag), Catch::Contains("more than 1000000 vertices"));
  CHECK(complaint("F+F+F+F").empty());  // it ends where it began
}

TEST_CASE("turtle: nine thousand nested brackets are drawn") {
  std::string string;
  for (int i = 0; i < 9000; ++i) string += "F[+";
  const Plant plant = drawn(string + "F" + std::string(9000, ']'), 1, 1);
  CHECK(plant.branches.size() == 9001);
  CHECK(plant.branches.back().level == 9000);
}

TEST_CASE("turtle: the plants of the book") {
  const auto file = data_file("treeparam/lsystems.json");
  if (!file) return;
  for (const LSystem& system : parse_lsystems(read_all(*file))) {
    INFO(system.name);
    const Plant plant = grow_plant(system);
    check(plant);
    float top = 0;
    for (const CentrePoint& p : plant.centre_lines) top = std::max(top, p.position.z);
    CHECK(top == Approx(1).epsilon(0.05));  // caps
    const std::string string = derive(system, system.steps);
    CHECK(plant.terminals.size() == static_cast<std::size_t>(std::count(string.begin(), string.end(), '{')));
    CHECK(plant.branches.size() <= static_cast<std::size_t>(std::count(string.begin(), string.end(), '[')) + 1);
  }
}

TEST_CASE("turtle: the herb has a hundred and six lines, and grass has blades that bend") {
  const auto read = [](const char* name) {
    return grow_plant(parse_lsystems(read_all(std::string(MANZANA_PLANTS "/") + name)).at(0));
  };
  const auto lines = [](const Plant& plant) {
    std::size_t pieces = 0;
    for (const Branch& branch : plant.branches) pieces += branch.line.size() - 1;
    return pieces;
  };
  const Plant herb = read("herb.json"), grass = read("grass.json");
  check(herb);
  check(grass);
  CHECK(lines(herb) == 106);
  CHECK(herb.terminals.size() > 100);
  CHECK(std::count_if(herb.terminals.begin(), herb.terminals.end(),
                      [](const Terminal& t) { return t.organ == Organ::flower; }) > 10);
  CHECK(grass.terminals.empty());
  CHECK(grass.branches.size() == 21);
  CHECK(lines(grass) == 84);
}
