// Packs of mosaics, against what is dumb and sure.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>

#include "foliage/ldm_cover.h"
#include "foliage/ldm_mosaics.h"
#include "foliage/ldm_pages.h"
#include "foliage/ldm_select.h"
#include "foliage/ldm_texture.h"
#include "foliage/ldm_views.h"
#include "tests/foliage/ldm_samples.h"

namespace manzana::foliage {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// The rectangle's mosaic, or those of its quarters, by the letter.
void split_slowly(const LdmPlace& place, const LdmOptions& o, double radius, double distance, int left, int low,
                  int side, std::vector<LdmMosaic>& out) {
  long double alpha = 0, depth = 0, hidden = 0;
  std::set<int> xs, ys;
  std::vector<long double> depths;
  for (int y = low; y < low + side; ++y)
    for (int x = left; x < left + side; ++x) {
      const int px = 32 * place.column + x, py = 32 * place.row + y;
      const LdmTexel& t = place.image.at(place.layer, px, py);
      if (t.colour[3] == 0) continue;
      const long double a = t.colour[3] / 255.0L, d = place.layer + t.depth / 255.0L;
      alpha += a, depth += a * d;
      hidden += a * static_cast<long double>(place.hidden[static_cast<std::size_t>(py * kLdmPixels + px)]);
      xs.insert(x), ys.insert(y), depths.push_back(d);
    }
  if (depths.empty()) return;
  const long double mean = depth / alpha, slab = 2 * radius / place.image.layers;
  long double off = 0;
  for (const long double d : depths) off = std::max(off, std::abs(d - mean));
  const long double away = distance - radius + mean * slab, diff = off * slab;
  const long double moved = diff == 0      ? 0
                            : away <= diff ? kInf
                                           : o.focal_px * diff / std::sqrt(away * away - diff * diff);
  const long double allowed = (1 + static_cast<long double>(o.occlusion) * hidden / alpha) * o.disparity_px;
  if (moved >= allowed && side / 2 >= o.smallest) {
    for (const int dy : {0, side / 2})
      for (const int dx : {0, side / 2}) split_slowly(place, o, radius, distance, left + dx, low + dy, side / 2, out);
    return;
  }
  const auto byte = [](int v) { return static_cast<std::uint8_t>(v); };
  out.push_back({0, static_cast<std::uint16_t>(std::lround(65535 * mean / place.image.layers)), byte(*xs.begin()),
                 byte(*ys.begin()), byte(*xs.rbegin() + 1), byte(*ys.rbegin() + 1)});
}

bool same(const LdmMosaic& a, const LdmMosaic& b) {
  return std::abs(a.depth - b.depth) <= 1 && a.left == b.left && a.low == b.low && a.right == b.right &&
         a.high == b.high;
}

}  // namespace

TEST_CASE("disparity is the most that any direction shows") {
  for (const double d : {1.0, 7.0, 123.0, 1e6})
    for (const double part : {1e-6, 0.01, 0.5, 0.999}) {
      const double diff = part * d, bound = disparity(diff, d, 935);
      const auto moved = [&](long double angle) {
        return 935.0L * diff * std::sin(angle) / (d + diff * std::cos(angle));
      };
      for (int i = 0; i < 10000; ++i) CHECK(moved(i * 3.14159265358979L / 10000) <= bound * (1 + 1e-12L));
      CHECK(static_cast<double>(moved(std::acos(-static_cast<long double>(part)))) == Approx(bound).epsilon(1e-12));
    }
}

TEST_CASE("disparity of nothing is none and from within it is infinite") {
  CHECK(disparity(0, 1, 935) == 0);
  for (const double d : {0.0, 0.5, 1.0}) CHECK(disparity(1, d, 935) == kInf);
  CHECK(disparity(0, 0, 935) == kInf);
  CHECK(std::isfinite(disparity(1, std::nextafter(1.0, 2.0), 935)));
  CHECK(disparity(1, 1e6, 935) == Approx(935e-6).epsilon(1e-9));
}

TEST_CASE("a block is as coarse as its difference allows") {
  const LdmImage image = blobs(1, 9, 200);
  for (int at = 0; at < 64; ++at) {
    LdmSquare block{kLdmBlock, {}};
    for (int y = 0; y < kLdmBlock; ++y)
      for (int x = 0; x < kLdmBlock; ++x) block.texels.push_back(image.at(0, at % 8 * 32 + x, at / 8 * 32 + y));
    const auto pyramid = ldm_pyramid(block);
    REQUIRE(pyramid.size() == 6);
    CHECK(colour_difference(pyramid, 0) == 0);
    for (const double delta : {0.0, 1.0, 5.0, 10.0, 30.0, 1000.0}) {
      const int m = coarsest_level(pyramid, delta);
      CHECK(colour_difference(pyramid, m) <= delta);
      if (m < 5) CHECK(colour_difference(pyramid, m + 1) > delta);
    }
    const auto alpha = [](const LdmSquare& s) {
      double sum = 0;
      for (const LdmTexel& t : s.texels) sum += t.colour[3];
      return sum / static_cast<double>(s.texels.size());
    };
    for (const LdmSquare& level : pyramid) CHECK(std::abs(alpha(level) - alpha(block)) < 1.5);  // of 255
  }
}

TEST_CASE("what is hidden may be coarser") {
  LdmOptions options;
  CHECK(allowed_delta(0, options) == 10);
  CHECK(allowed_delta(1, options) == 30);
  options.occlusion = 0;
  CHECK(allowed_delta(1, options) == 10);
  LdmTally plain, aware;
  pack_of_blobs({.occlusion = 0}, &plain);
  pack_of_blobs({}, &aware);
  CHECK(plain.aware == plain.adaptive);
  CHECK(aware.adaptive == plain.adaptive);
  CHECK(aware.aware < aware.adaptive);
  CHECK(aware.raw == 18.0 * (6 * 256 * 256 + 6 * 64 * 64 + (3 + 1) * 32 * 32));
}

TEST_CASE("normals of texels come back") {
  support::Random random(8);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 n = random_direction(random);
    const auto packed = pack_ldm_normal(n);
    CHECK(glm::dot(unpack_ldm_normal(packed[0], packed[1]), n) > 0.9995F);
  }
}

TEST_CASE("a block is split as brute force splits it") {
  const LdmImage image = blobs(6, 5, 400);
  std::vector<float> hidden(kLdmPixels * kLdmPixels);
  support::Random random(2);
  for (float& h : hidden) h = static_cast<float>(random.within(0, 1));
  std::size_t all = 0;
  for (const int smallest : {1, 4, 16})
    for (const float eta : {0.5F, 6.0F})
      for (const double distance : {12.0, 48.0, 1e4})
        for (int at = 0; at < 6 * 64; at += 5) {
          const LdmPlace place{image, at % 6, at / 6 % 8, at / 48, hidden};
          const LdmOptions options{.smallest = smallest, .disparity_px = eta};
          const auto mosaics = split_block(place, options, 6, distance);
          std::vector<LdmMosaic> expected;
          split_slowly(place, options, 6, distance, 0, 0, kLdmBlock, expected);
          REQUIRE(mosaics.size() == expected.size());
          CHECK(std::equal(mosaics.begin(), mosaics.end(), expected.begin(), same));
          all += mosaics.size();
        }
  CHECK(all > 3000);
}

TEST_CASE("mosaics of a level hold every visible pixel once") {
  std::vector<LdmImage> images;
  const auto sample = [&](const ParallelView&, int layers) {
    images.push_back(blobs(layers, images.size() + 1));
    return images.back();
  };
  const LdmPack pack = make_ldm_pack({Vec3(0), 6}, {.sides = LdmSides::paper}, sample);
  for (std::size_t s = 0; s < pack.sides.size(); ++s) {
    double visible = 0;
    for (const LdmTexel& texel : images[s].texels) visible += texel.colour[3] > 0 ? 1 : 0;
    for (int level = 0; level < level_count(pack.options); ++level) {
      const Run run = pack.sides[s].mosaics[static_cast<std::size_t>(level)];
      std::set<std::array<int, 3>> pixels;
      double held = 0, area = 0;
      for (std::uint32_t i = run.first; i < run.last; ++i) {
        const LdmMosaic& m = pack.mosaics[i];
        if (i > run.first) CHECK(m.depth <= pack.mosaics[i - 1].depth);
        for (int y = m.low; y < m.high; ++y)
          for (int x = m.left; x < m.right; ++x) {
            const LdmBlock& b = pack.blocks[m.block];
            pixels.insert({m.block, x, y});
            ++area;
            for (int layer = 0; layer < 6; ++layer) {
              const double front = 65535.0 * layer / 6, back = 65535.0 * (layer + 1) / 6;
              if (m.depth < front - 1 || m.depth > back + 1) continue;
              held += images[s].at(layer, b.column * 32 + x, b.row * 32 + y).colour[3] > 0 ? 1 : 0;
            }
          }
      }
      CHECK(static_cast<double>(pixels.size()) == area);  // none twice
      CHECK(held >= visible);
    }
  }
}

TEST_CASE("coarser pictures cover as much as finer ones from the front") {
  const LdmImage image = blobs(6, 3, 300);
  const auto covered = [](const LdmImage& picture) {
    double sum = 0;
    for (int y = 0; y < picture.pixels; ++y)
      for (int x = 0; x < picture.pixels; ++x) {
        double open = 1;
        for (int layer = 0; layer < picture.layers; ++layer) open *= 1 - picture.at(layer, x, y).colour[3] / 255.0;
        sum += (1 - open) / (picture.pixels * picture.pixels);
      }
    return sum;
  };
  const LdmImage flat = coarser(image, 4, 6), halves = coarser(image, 1, 3);
  CHECK(flat.pixels == 64);
  CHECK(covered(flat) == Approx(covered(image)).margin(1e-3));
  CHECK(covered(halves) == Approx(covered(image)).margin(1e-3));
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      const LdmTexel &first = image.at(1, x, y), &merged = halves.at(0, x, y);
      if (image.at(0, x, y).colour[3] > 0 || first.colour[3] != 255) continue;
      CHECK(std::abs(merged.colour[1] - first.colour[1]) <= 1);  // what is behind is hidden
      CHECK(std::abs(merged.depth - (255 + first.depth) / 3) <= 1);
    }
}

TEST_CASE("a side covers from itself what its picture does however much it grows") {
  const LdmPack pack = pack_of_blobs();
  const LdmAlphas alphas(pack);
  for (const std::uint32_t side : {0U, 7U, 17U}) {
    const LdmImage image = blobs(6, side + 1);
    double covered = 0;
    for (std::size_t i = 0; i < image.index(1, 0, 0); ++i) {
      double open = 1;
      for (int layer = 0; layer < 6; ++layer) open *= 1 - image.texels[image.index(layer, 0, 0) + i].colour[3] / 255.0;
      covered += (1 - open) / (kLdmPixels * kLdmPixels);
    }
    for (const auto& [level, pixels] : {std::pair{0, 256}, {1, 100}, {3, 64}, {4, 64}, {5, 32}})
      CHECK(ldm_cover(pack, alphas, side, level, Vec3d(pack.sides[side].towards), 0.7F, pixels) ==
            Approx(covered).epsilon(0.03));
  }
}

TEST_CASE("mosaics grow until a level covers from between its sides what is asked") {
  LdmPack pack = pack_of_blobs();
  const LdmAlphas alphas(pack);
  constexpr float kAsked = 0.45F;
  std::vector<LdmSeenFrom> seen;
  const auto cover_of = [&](const Vec3d& to_eye, float grown) {
    const LdmWeights weights = ldm_weights(pack, Vec3(to_eye));
    double cover = 0;
    for (std::size_t i = 0; i < 3; ++i)
      cover += static_cast<double>(weights.weight[i]) * ldm_cover(pack, alphas, weights.side[i], 4, to_eye, grown, 41);
    return cover;
  };
  for (const Vec3d& to_eye : ldm_fitting_directions()) seen.push_back({to_eye, cover_of(to_eye, kAsked)});
  fit_grown(pack, seen);
  double covers = 0, asked = 0;
  for (const LdmSeenFrom& one : seen) covers += cover_of(one.to_eye, pack.grown[4]), asked += one.cover;
  CHECK(covers == Approx(asked).epsilon(0.005));
  CHECK(pack.grown[4] > 0.2F);
  CHECK(pack_of_blobs({.sides = LdmSides::paper}).grown[4] == 0);
}

TEST_CASE("squares in pages lie on their own multiples and never on each other") {
  support::Random random(6);
  std::vector<int> sides;
  std::size_t area = 0;
  for (int i = 0; i < 3000; ++i) {
    sides.push_back(1 << random.below(6));
    area += static_cast<std::size_t>(sides.back() * sides.back());
  }
  const auto places = pack_pages(sides, 512);
  std::set<std::array<std::uint32_t, 3>> texels;
  std::uint32_t pages = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto [page, x, y] = places[i];
    pages = std::max(pages, page + 1);
    CHECK((x % sides[i] == 0 && y % sides[i] == 0 && x + sides[i] <= 512 && y + sides[i] <= 512));
    for (int dy = 0; dy < sides[i]; ++dy)
      for (int dx = 0; dx < sides[i]; ++dx)
        texels.insert({page, x + static_cast<std::uint32_t>(dx), y + static_cast<std::uint32_t>(dy)});
  }
  CHECK(texels.size() == area);
  CHECK(pages == (area + 512 * 512 - 1) / (512 * 512));
  CHECK(pack_pages({}, 512).empty());
}

TEST_CASE("a plant of nothing is a pack of nothing") {
  const LdmPack pack =
      make_ldm_pack(ldm_ball(PreparedPlant{}), {}, [](const ParallelView&, int layers) { return LdmImage(layers); });
  CHECK(pack.mosaics.empty());
  CHECK(pack.pages() == 0);
  CHECK(pack.sides.size() == 18);
}

TEST_CASE("a pack of far levels alone is the far levels of a whole one") {
  constexpr int kNearest = 4;
  const LdmPack whole = pack_of_blobs(), far = pack_of_blobs({.nearest = kNearest});
  CHECK(5 * far.pages() < whole.pages());
  for (std::size_t side = 0; side < far.sides.size(); ++side)
    for (std::size_t level = 0; level < kLdmLevels; ++level) {
      const Run a = whole.sides[side].mosaics[level], b = far.sides[side].mosaics[level];
      CHECK(b.size() == (level < kNearest ? 0 : a.size()));
    }
  CHECK(far.grown[5] == whole.grown[5]);
  CHECK(ldm_ring(far, 1).level == kNearest);
  CHECK(ldm_ring(far, 1e9).level == kLdmLevels - 1);
}

TEST_CASE("packs that would be drawn from elsewhere are refused") {
  const LdmPack good = pack_of_blobs();
  const auto refuses = [&](auto&& spoil) {
    LdmPack bad = good;
    spoil(bad);
    CHECK_THROWS_AS(check(bad), std::invalid_argument);
  };
  CHECK_NOTHROW(check(good));
  refuses([](LdmPack& p) { p.grown[2] = std::nanf(""); });
  refuses([](LdmPack& p) { p.radius = std::nanf(""); });
  refuses([](LdmPack& p) { p.sides.pop_back(); });
  refuses([](LdmPack& p) { p.sides[3].mosaics[1].last = 1U << 30; });
  refuses([](LdmPack& p) { p.sides[3].up.x = std::nanf(""); });
  refuses([](LdmPack& p) { p.blocks[5].page = 255; });
  refuses([](LdmPack& p) { p.blocks[5].shrink = 6; });
  refuses([](LdmPack& p) { p.blocks[5].x = 255; });
  refuses([](LdmPack& p) { p.blocks[5].pixel = 255; });
  refuses([](LdmPack& p) { p.mosaics[5].right = 33; });
  refuses([](LdmPack& p) { p.mosaics[5].left = p.mosaics[5].right; });
  refuses([](LdmPack& p) { p.mosaics[5].block = 65535; });
  refuses([](LdmPack& p) { p.colour.pop_back(); });
  refuses([](LdmPack& p) { p.options.layers = 0; });
  refuses([](LdmPack& p) { p.options.nearest = kLdmLevels; });
  CHECK_THROWS_AS(pack_of_blobs({.layers = 0}), std::invalid_argument);
  CHECK_THROWS_AS(pack_of_blobs({.nearest_radii = 1}), std::invalid_argument);
}

}  // namespace manzana::foliage
