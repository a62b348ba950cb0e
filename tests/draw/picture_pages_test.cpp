// Pictures on the device: places that never overlap, bytes within a limit, what goes first, and how fine they must be.
#include "scenegraph/draw/picture_pages.h"

#include <catch2/catch.hpp>
#include <random>

#include "gl/context.h"
#include "gl/error_log.h"

namespace manzana::draw {
namespace {

bool apart(const Square& a, const Square& b) {
  return a.page != b.page || a.x + a.side <= b.x || b.x + b.side <= a.x || a.y + a.side <= b.y || b.y + b.side <= a.y;
}

/// So many pictures of 256 x 256, worn once each.
Pictures made(std::uint32_t n) {
  Pictures pictures;
  for (std::uint32_t p = 0; p < n; ++p) {
    pictures.encoded.push_back({{}, "", {}, 256, 256, {0, 0, 256, 256}});
    pictures.textures.push_back({p, Wrap::repeat, 0});
  }
  return pictures;
}

PictureSquare plain(std::uint32_t side) {
  PictureSquare square{{side, side, std::vector<GroundPhoto::Texel>(std::size_t{side} * side, {9, 99, 199, 255})}};
  add_levels(square);
  return square;
}

constexpr std::size_t kPage = 256 * 256 * 4 * 4 / 3;

/// One picture of a camera that sees these, about so many pixels a side.
void look(PicturePages& pages, std::initializer_list<std::uint32_t> seen, double pixels) {
  pages.begin();
  for (const std::uint32_t p : seen) pages.see(p, pixels);
  pages.end();
}
std::size_t give(PicturePages& pages) {
  std::size_t given = 0;
  for (const PictureWanted& w : std::vector(pages.wanted().begin(), pages.wanted().end()))
    given += pages.add(w, plain(w.side)) ? 1 : 0;
  return given;
}

}  // namespace

TEST_CASE("squares never overlap and all that was given back is whole pages again") {
  SquareRoom room(64);
  room.grow(3);
  std::mt19937 random(7);
  std::vector<Square> taken;
  for (int i = 0; i < 4000; ++i) {
    if (random() % 3 != 0) {
      const auto square = room.take(1U << random() % 7);
      if (!square) continue;
      CHECK(square->x % square->side == 0);
      CHECK(square->y % square->side == 0);
      CHECK(square->x + square->side <= 64);
      for (const Square& other : taken) REQUIRE(apart(*square, other));
      taken.push_back(*square);
    } else if (!taken.empty()) {
      std::swap(taken[random() % taken.size()], taken.back());
      room.give(taken.back());
      taken.pop_back();
    }
  }
  for (const Square& square : taken) room.give(square);
  for (int page = 0; page < 3; ++page) CHECK(room.take(64));
  CHECK(!room.take(1));
}

TEST_CASE("pictures: each comes as large as it is seen and larger when it is seen from nearer") {
  const gl::HeadlessContext context;
  gl::ErrorLog errors;
  PicturePages pages(made(2), PicturePages::kMostBytes);
  look(pages, {0}, 20);
  REQUIRE(pages.wanted().size() == 1);
  CHECK(pages.wanted()[0] == PictureWanted{0, 32});
  CHECK(!pages.holds(0));
  CHECK(give(pages) == 1);
  CHECK(pages.holds(0));
  look(pages, {0}, 32);
  CHECK(pages.wanted().empty());
  look(pages, {0, 1}, 1e9);
  CHECK(give(pages) == 2);
  look(pages, {0, 1}, 5);
  CHECK(pages.wanted().empty());
  CHECK(!pages.add({0, 16}, plain(16)));  // came too late
  look(pages, {0}, std::numeric_limits<double>::infinity());
  CHECK(pages.wanted().empty());
  CHECK(errors.messages().empty());
}

TEST_CASE("pictures: bytes stay within the limit and what was not seen for longest makes room") {
  const gl::HeadlessContext context;
  gl::ErrorLog errors;
  constexpr std::size_t kMost = 4 * kPage + 1000;
  PicturePages pages(made(40), kMost);
  for (const std::uint32_t p : {0U, 1U, 2U, 3U, 0U, 4U}) {
    look(pages, {p}, 256);
    give(pages);
    CHECK(pages.holds(p));
    CHECK(pages.device_bytes() <= kMost + 40 * sizeof(glsl::WornData));
  }
  CHECK(pages.holds(0));   // seen again before there was no room
  CHECK(!pages.holds(1));  // seen before all others
  CHECK(errors.messages().empty());
}

TEST_CASE("pictures: where all that is seen needs more than there is all of it is coarser and there") {
  const gl::HeadlessContext context;
  gl::ErrorLog errors;
  const Pictures pictures = made(12);
  PicturePages pages(pictures, 4 * kPage + 1000);
  look(pages, {0, 1, 2}, 256);
  CHECK(give(pages) == 3);
  for (int i = 0; i < 2; ++i) {
    look(pages, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, 256);
    for (const PictureWanted& w : pages.wanted()) CHECK(w.side == 128);
    give(pages);
  }
  for (std::uint32_t p = 0; p < 12; ++p) CHECK(pages.holds(p));
  CHECK(pages.device_bytes() <= 4 * kPage + 1000 + 12 * sizeof(glsl::WornData));
  CHECK(errors.messages().empty());
}

TEST_CASE("pictures: one that finds no place of its size stays as fine as there is a place for") {
  const gl::HeadlessContext context;
  PicturePages pages(made(16), kPage + 1000);
  for (std::uint32_t p = 0; p < 16; ++p) {  // a sixteenth of the page each
    look(pages, {p}, 64);
    REQUIRE(give(pages) == 1);
  }
  pages.begin();
  for (const std::uint32_t p : {0U, 4U, 8U, 12U}) pages.see(p, 64);  // one in each quarter
  pages.see(1, 128);
  pages.end();
  REQUIRE(pages.wanted().size() == 1);
  give(pages);
  CHECK(pages.holds(1));
  for (const std::uint32_t p : {0U, 4U, 8U, 12U}) CHECK(pages.holds(p));
}

TEST_CASE("pictures: of a piece's buildings each is as fine as it is near") {
  const gl::HeadlessContext context;
  Scene scene;
  scene.pictures = made(2);
  CityMesh mesh;
  for (std::uint32_t row = 0; row < 2; ++row) {  // a triangle of 10 m each, that wears half a picture of 10 m
    const float x = 1000.0F * static_cast<float>(row);
    for (const Vec2 at : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.vertices.push_back({{x + 10 * at.x, 0, 10 * at.y}, 0, 0, at, 0});
      mesh.textures.push_back(row + 1);
    }
    scene.buildings.table.boxes.push_back({{x, 0, 0}, {x + 10, 0, 10}});
  }
  scene.buildings.mesh.vertices.own() = mesh.vertices;
  scene.buildings.mesh.indices.own() = mesh.indices;
  scene.buildings.mesh.textures.own() = mesh.textures;
  scene.buildings.index_first = {0, 3, 6};
  LayerPieces pieces(scene.buildings, Vec3d(0));
  REQUIRE(pieces.count == 1);
  const std::vector<Worn> worn = worn_by(mesh_of(scene.buildings, pieces, 0), 0);
  REQUIRE(worn.size() == 2);
  CHECK(worn[1].row == 1);
  CHECK(worn[1].metres == Approx(10));
  pieces.held[0].emplace().worn = worn;
  pieces.in_sight = {0};
  PicturePages pages(scene.pictures, PicturePages::kMostBytes);
  pages.begin();
  see(pages, scene, pieces, {.eye = {0, -50, 0}, .pixel_at_1m = 0.001});
  pages.end();
  // 10 m are 200 pixels 50 m away, and 10 pixels a kilometre away.
  CHECK(std::vector(pages.wanted().begin(), pages.wanted().end()) == std::vector<PictureWanted>{{0, 256}, {1, 16}});
}

}  // namespace manzana::draw
