#include "foliage/import/obj_plant.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;
using namespace manzana::foliage;

namespace {

PlantReading examine(const std::string& text) {
  PlantReading reading =
      examine_obj(std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()), "it.obj");
  check(reading.plant);
  return reading;
}

std::string complaint(const std::string& text) {
  try {
    examine(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

void write_part(std::ostringstream& out, const MeshPart& part, const Run& triangles, std::size_t& vertices) {
  for (std::uint32_t i = 3 * triangles.first; i < 3 * triangles.last; ++i) {
    const MeshVertex& v = part.vertices[part.indices[i]];
    out << "v " << v.position.x << ' ' << v.position.z << ' ' << -v.position.y << "\nvt " << v.uv.x << ' ' << 1 - v.uv.y
        << "\nvn " << v.normal.x << ' ' << v.normal.z << ' ' << -v.normal.y << '\n';
  }
  for (std::uint32_t t = 0; t < triangles.size(); ++t, vertices += 3) {
    out << 'f';
    for (std::size_t k = 1; k <= 3; ++k) out << ' ' << vertices + k << '/' << vertices + k << '/' << vertices + k;
    out << '\n';
  }
}

/// A group for each organ, as Xfrog writes it.
std::string as_obj(const Plant& plant, const std::string& bark, const std::string& leaf) {
  std::ostringstream out;
  out.precision(9);
  std::size_t vertices = 0;
  for (std::size_t i = 0; i < plant.branches.size(); ++i) {
    out << "g " << bark << i << "\nusemtl m" << bark << '\n';
    write_part(out, plant.mesh.bark, plant.branches[i].triangles, vertices);
  }
  for (std::size_t i = 0; i < plant.terminals.size(); ++i) {
    out << "g " << leaf << i << "\nusemtl m" << leaf << '\n';
    write_part(out, plant.mesh.leaves, plant.terminals[i].triangles, vertices);
  }
  return out.str();
}

/// From the lowest vertex to the highest.
float extent(const Plant& plant) {
  float low = HUGE_VALF, high = -HUGE_VALF;
  for (const MeshPart* part : {&plant.mesh.bark, &plant.mesh.leaves})
    for (const MeshVertex& v : part->vertices) low = std::min(low, v.position.z), high = std::max(high, v.position.z);
  return high - low;
}

const char* const kTriangle = "v 0 0 0\nv 1 0 0\nv 0 2 0\n";

}  // namespace

TEST_CASE("obj: groups say what is branch and what is leaf") {
  const Plant shrub = grow_plant(builtin_species("shrub"), 2);
  const PlantReading reading = examine(as_obj(shrub, "branch", "leaf"));
  const Plant& plant = reading.plant;
  CHECK(plant.branches.size() == shrub.branches.size());
  CHECK(plant.terminals.size() == shrub.terminals.size());
  CHECK(plant.mesh.bark.triangles() == shrub.mesh.bark.triangles());
  CHECK(plant.mesh.leaves.triangles() == shrub.mesh.leaves.triangles());
  CHECK(extent(plant) == Approx(extent(shrub)).epsilon(1e-5));
  CHECK(reading.taken.branch[static_cast<std::size_t>(Reason::material)] == plant.mesh.bark.triangles());
  CHECK_FALSE(prepare(plant).leaves.empty());
}

TEST_CASE("obj: what no name tells, shape does") {
  const Plant shrub = grow_plant(builtin_species("shrub"), 2);
  const PlantReading reading = examine(as_obj(shrub, "x", "y"));
  const auto of = [](std::size_t a, std::size_t b) { return static_cast<double>(a) / static_cast<double>(b); };
  CHECK(of(reading.plant.mesh.bark.triangles(), shrub.mesh.bark.triangles()) == Approx(1).margin(0.05));
  CHECK(of(reading.plant.mesh.leaves.triangles(), shrub.mesh.leaves.triangles()) == Approx(1).margin(0.05));
}

TEST_CASE("obj: corners in every way of writing them") {
  const std::string rest = "vt 0.25 0.75\nvn 0 0 5\ng leaf\n";
  for (const char* face : {"f 1 2 3", "f -3 -2 -1", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1",
                           "f\t1/-1/-1  2/-1/-1\t3/-1/-1 \r", "f 1 2 \\\n 3", "  f 1 2 3 # a leaf"}) {
    INFO(face);
    const Plant plant = examine(kTriangle + rest + face).plant;
    CHECK(plant.mesh.leaves.triangles() == 1);
    CHECK(measure(plant.mesh).height == Approx(2));
  }
  const Plant plant = examine(kTriangle + rest + "f 1/1/1 2/1/1 3/1/1").plant;
  CHECK(plant.mesh.leaves.vertices[0].uv == Vec2(0.25F, 0.25F));
}

TEST_CASE("obj: polygons of any number of corners") {
  const std::string dart = "v 0 0 0\nv 2 0 0\nv 0.5 0.5 0\nv 0 2 0\ng leaf\nf 1 2 3 4\n";
  const Plant plant = examine(dart).plant;
  CHECK(plant.mesh.leaves.triangles() == 2);
  std::ostringstream round, face;
  for (int i = 0; i < 500; ++i) {
    round << "v " << std::cos(i * 0.012566) << ' ' << 1 + std::sin(i * 0.012566) << " 0\n";
    face << ' ' << i + 1;
  }
  CHECK(examine(round.str() + "g leaf\nf" + face.str()).plant.mesh.leaves.triangles() == 498);
}

TEST_CASE("obj: what is wrong is named by its line") {
  const std::string triangle = kTriangle;
  CHECK(complaint("") == "it.obj: has no triangles");
  CHECK(complaint(triangle) == "it.obj: has no triangles");
  CHECK(complaint(triangle + "f 1 2") == "it.obj: line 4: a face needs three corners");
  CHECK(complaint(triangle + "f 1 2 4") == "it.obj: line 4: there is no vertex 4");
  CHECK(complaint(triangle + "f 1 2 0") == "it.obj: line 4: there is no vertex 0");
  CHECK(complaint(triangle + "f 1 2 -4") == "it.obj: line 4: there is no vertex -4");
  CHECK(complaint(triangle + "f 1 2 -9223372036854775808") ==
        "it.obj: line 4: there is no vertex -9223372036854775808");
  CHECK_THAT(complaint(triangle + "f 1 2 99999999999999999999"), Catch::Contains("line 4: there is no vertex"));
  CHECK(complaint(triangle + "f 1/1 2/1 3/1") == "it.obj: line 4: there is no texture coordinate 1");
  CHECK(complaint(triangle + "f 1//1 2//1 3//1") == "it.obj: line 4: there is no normal 1");
  CHECK(complaint(triangle + "f 1 2 x") == "it.obj: line 4: \"x\" is no corner of a face");
  CHECK(complaint(triangle + "f 1 2 3.5") == "it.obj: line 4: \"3.5\" is no corner of a face");
  CHECK(complaint("v 0 0\n") == "it.obj: line 1: \"\" is no number, or out of range");
  CHECK(complaint("v 0 0 nan\n") == "it.obj: line 1: \"nan\" is no number, or out of range");
  CHECK(complaint("\n#\nv 0 0 1e39\n") == "it.obj: line 3: \"1e39\" is no number, or out of range");
  CHECK(complaint("v 0 0 1,5\n") == "it.obj: line 1: \"1,5\" is no number, or out of range");
  CHECK(complaint("vt inf 0\n") == "it.obj: line 1: \"inf\" is no number, or out of range");
  CHECK(complaint("v 0 0 0 \\\n\nvt 1e7 0\n") == "it.obj: line 3: a texture coordinate is out of range");
  CHECK_FALSE(complaint("v 1 1 1\nf 1 1 1\n").empty());  // of no size
}

TEST_CASE("obj: libraries and textures come from the folder and from nowhere else") {
  const TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& text) {
    std::filesystem::create_directories((folder.path() / name).parent_path());
    std::ofstream(folder.path() / name) << text;
  };
  const auto plant_with = [&](const std::string& head) {
    write("in/plant.obj", head + "\n" + kTriangle + "usemtl green\nf 1 2 3\n");
    return examine_obj(folder.path() / "in/plant.obj");
  };
  write("in/a b.mtl", "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n");
  write("in/sub/leaf.mtl", "newmtl green\nmap_Kd -s 1 1 1 no picture.png\n");
  write("in/out.mtl", "newmtl green\nmap_Kd ..\\secret.png\n");
  write("secret.mtl", "newmtl green\n");
  const PlantReading good = plant_with("mtllib a b.mtl");
  CHECK(good.notes.empty());
  CHECK(good.files == std::vector<std::string>{"a b.mtl"});
  CHECK(good.plant.leaf_image.rgba[0] == 0);
  CHECK(good.plant.leaf_image.rgba[1] == 255);
  CHECK(plant_with("mtllib none.mtl").notes == std::vector<std::string>{"its library none.mtl is absent"});
  CHECK(plant_with("mtllib sub/leaf.mtl").notes == std::vector<std::string>{"its texture picture.png is absent"});
  CHECK_THROWS_WITH(plant_with("mtllib ../secret.mtl"), Catch::EndsWith("refers to ../secret.mtl, outside its folder"));
  CHECK_THROWS_WITH(plant_with("mtllib /etc/passwd"), Catch::Contains("outside its folder"));
  CHECK_THROWS_WITH(plant_with("mtllib out.mtl"), Catch::EndsWith("refers to ../secret.png, outside its folder"));
  std::filesystem::create_symlink(folder.path() / "secret.mtl", folder.path() / "in/link.mtl");
  CHECK_THROWS_WITH(plant_with("mtllib link.mtl"), Catch::Contains("a link that leads outside"));
  CHECK(examine(std::string("mtllib a.mtl\n") + kTriangle + "f 1 2 3\n").files.empty());  // from memory
}

TEST_CASE("obj: files cut or altered anywhere are read or refused") {
  const std::string good = as_obj(grow_plant(builtin_species("shrub"), 2), "branch", "leaf").substr(0, 30'000);
  support::Random random(3);
  for (int i = 0; i < 300; ++i) {
    std::string bad = good.substr(0, random.bits() % good.size());
    for (int k = 0; k < 5 && !bad.empty(); ++k) bad[random.bits() % bad.size()] = static_cast<char>(random.bits());
    complaint(bad);
  }
}
