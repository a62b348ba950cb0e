// Packs of mosaics against the plants that they are of.
#include "apps/foliage_benchmark/packs.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "apps/foliage_benchmark/errors.h"
#include "apps/foliage_benchmark/forest.h"
#include "foliage/far_pack.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/ldm_sampler.h"
#include "foliage/make_ldm.h"
#include "foliage/prepare.h"
#include "gl/context.h"
#include "gl/error_log.h"
#include "tests/foliage/ldm_samples.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::LdmOptions;
using foliage::LdmSides;
using foliage::PreparedPlant;
using Way = Packs::Way;

std::vector<PreparedPlant> plant_named(const char* species) {
  return {prepare(grow_plant(foliage::builtin_species(species), 1), {.visibility_side = 0})};
}

std::vector<foliage::LdmPack> packs_of(const PreparedPlant& plant, const LdmOptions& options = {}, int fine = 4) {
  std::vector<foliage::LdmPack> packs;
  packs.push_back(make_ldm_pack(ldm_ball(plant), options, foliage::LdmSampler(plant, fine)));
  return packs;
}

constexpr double kDegree = 3.14159265358979 / 180;

}  // namespace

TEST_CASE("packs: an opaque card stays opaque between sides and between levels in every way") {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  const auto plants = plant_named("shrub");
  Stage stage(plants, sites_of(plants));
  const Extent extent = extent_of(plants[0]);
  const foliage::Run run{0, 1};
  for (const LdmSides sides : {LdmSides::paper, LdmSides::octahedral}) {
    std::vector<foliage::LdmPack> made;
    made.push_back(make_ldm_pack({Vec3(0, 0, extent.high / 2), static_cast<float>(extent.high)}, {.sides = sides},
                                 foliage::white_card));
    Packs packs(std::move(made));
    for (int i = 0; i < 16; ++i) {
      // Sides change with the angle, levels with the size.
      const Shot shot = shot_of(extent, 17 * i * kDegree, (2 + 5 * i) * kDegree, 150 * std::pow(0.85, i));
      const Sampling sampling = i % 2 == 0 ? Sampling::fine : Sampling::product;
      for (const Way way : {Way::dithered, Way::blended}) {
        const Picture seen = stage.draw(packs.painter(stage, {&run, 1}, shot, way), shot, sampling);
        CAPTURE(i, static_cast<int>(sides), static_cast<int>(way), static_cast<int>(sampling));
        float least = 1, most = 0;
        for (int y = -1; y <= 1; ++y)
          for (int x = -1; x <= 1; ++x) {
            const float w = seen.at(seen.width / 2 + x, seen.height / 2 + y).w;
            least = std::min(least, w), most = std::max(most, w);
          }
        CHECK(least >= 1 - 1.0F / 255);
        CHECK(most <= 1 + 1.0F / 255);
      }
    }
  }
  CHECK(log.messages().empty());
}

TEST_CASE("packs: a crown covers what its leaves do from between the sides") {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  for (const char* species : {"oak", "birch"}) {
    const auto plants = plant_named(species);
    Stage stage(plants, sites_of(plants));
    stage.set_law(foliage::Law::full);
    Packs packs(packs_of(plants[0]));
    const foliage::Run run{0, 1};
    const Extent extent = extent_of(plants[0]);
    double dithered = 0, blended = 0, colour = 0;
    constexpr int kViews = 6;
    for (int i = 0; i < kViews; ++i) {
      const Shot shot = shot_of(extent, 60 * (i + 0.37) * kDegree, (2 + 9 * i) * kDegree, 32);
      const Picture full = stage.draw(run, shot, {});
      const auto error = [&](Way way) {
        return image_error(full, stage.draw(packs.painter(stage, {&run, 1}, shot, way), shot, Sampling::fine));
      };
      const ImageError one = error(Way::dithered), other = error(Way::blended);
      dithered += one.cover / kViews, colour += one.colour / kViews, blended += other.cover / kViews;
      CHECK(one.ssim > 0.8);
    }
    CAPTURE(species, dithered, blended, colour);
    CHECK(dithered == Approx(1).margin(0.02));
    CHECK(dithered == Approx(blended).margin(0.005));  // mosaics hide no less of each other than chance has it
    CHECK(blended == Approx(1).margin(0.02));
    CHECK(colour < 0.005);
  }
  CHECK(log.messages().empty());
}

TEST_CASE("packs: four samples a pixel cover as much as many do") {
  const gl::HeadlessContext context;
  for (const char* species : {"broadleaf", "oak"}) {
    const auto plants = plant_named(species);
    Stage stage(plants, sites_of(plants));
    Packs packs(packs_of(plants[0]));
    const foliage::Run run{0, 1};
    for (const double height_px : {16.0, 32.0}) {
      double four = 0, many = 0;
      for (int i = 0; i < 6; ++i) {
        const Shot shot = shot_of(extent_of(plants[0]), 60 * (i + 0.37) * kDegree, (2 + 9 * i) * kDegree, height_px);
        const auto cover = [&](Sampling sampling) {
          double sum = 0;
          for (const Vec4& texel :
               stage.draw(packs.painter(stage, {&run, 1}, shot, Way::dithered), shot, sampling).texels)
            sum += static_cast<double>(texel.w);
          return sum;
        };
        four += cover(Sampling::product), many += cover(Sampling::fine);
      }
      CAPTURE(species, height_px);
      CHECK(four / many == Approx(1).margin(0.02));
    }
  }
}

TEST_CASE("packs: crowns of a few pixels cover as much with the product's samples as with many") {
  const gl::HeadlessContext context;
  constexpr std::uint32_t kTrees = 144;
  for (const char* species : {"conifer", "birch"}) {
    const auto plants = plant_named(species);
    Stage stage(plants, make_forest(plants, kTrees, 2.5 * closed_spacing(plants), 5));
    Packs packs(packs_of(plants[0], foliage::kFarPack, 2));
    const foliage::Run run{0, kTrees};
    for (const double down : {0.1, 1.0, 20.0})
      for (const double height_px : {10.0, 6.0, 4.0, 2.5}) {
        const Vec3d forward(1, 0, -down);
        Shot shot = screen_shot(Vec3d(0), forward, 240);
        shot.view.eye =
            -(shot.focal_px * static_cast<double>(plants[0].height_m) / height_px) * glm::normalize(forward);
        shot.fine = 16;
        const auto cover = [&](Sampling sampling) {
          double sum = 0;
          for (const Vec4& texel :
               stage.draw(packs.painter(stage, {&run, 1}, shot, Way::dithered), shot, sampling).texels)
            sum += static_cast<double>(texel.w);
          return sum;
        };
        const double fine = cover(Sampling::fine);
        CAPTURE(species, down, height_px, fine);
        CHECK(cover(Sampling::product) / fine == Approx(1).margin(0.1));
        CHECK(cover(Sampling::single) / fine == Approx(1).margin(0.12));
      }
  }
}

TEST_CASE("packs: another sun lights another side") {
  const gl::HeadlessContext context;
  const auto plants = plant_named("oak");
  Stage stage(plants, sites_of(plants));
  stage.set_law(foliage::Law::full);
  Packs packs(packs_of(plants[0], {}, 1));
  const foliage::Run run{0, 1};
  Shot shot = shot_of(extent_of(plants[0]), 0.2, 0.1, 64);
  const auto left_less_right = [](const Picture& p) {
    double sum = 0, all = 0;
    for (int y = 0; y < p.height; ++y)
      for (int x = 0; x < p.width; ++x) {
        const auto light = static_cast<double>(p.at(x, y).g);
        sum += x < p.width / 2 ? light : -light;
        all += light;
      }
    return sum / all;
  };
  // Seen from +x, +y is to the right.
  std::array<double, 2> full{}, packed{};
  for (std::size_t i = 0; i < 2; ++i) {
    shot.sun = Vec3d(0.2, i == 0 ? -1 : 1, 0.3);
    full[i] = left_less_right(stage.draw(run, shot, {}));
    packed[i] = left_less_right(stage.draw(packs.painter(stage, {&run, 1}, shot, Way::dithered), shot, Sampling::fine));
  }
  CAPTURE(full[0], full[1], packed[0], packed[1]);
  CHECK(packed[0] - packed[1] > 0.1);
  CHECK(packed[0] - packed[1] == Approx(full[0] - full[1]).epsilon(0.25));
}

TEST_CASE("packs: at the source's settings bytes stay within their gates") {
  const gl::HeadlessContext context;
  const auto plants = plant_named("birch");
  foliage::LdmTally tally;
  const auto pack =
      make_ldm_pack(ldm_ball(plants[0]), {.sides = LdmSides::paper}, foliage::LdmSampler(plants[0], 1), {}, &tally);
  CHECK(foliage::ldm_bytes(tally.raw) == 30.0 * 1024 * 1024);
  CHECK(tally.aware <= tally.adaptive);
  CHECK(foliage::ldm_bytes(static_cast<double>(pack.pages()) * foliage::kLdmPage * foliage::kLdmPage) < 8e6);
  CHECK(pack.mosaic_bytes() < 400e3);
}

}  // namespace manzana::foliage_benchmark
