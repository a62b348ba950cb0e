// Mosaics and groves of a wood by their knobs.
#include "apps/foliage_benchmark/far_side.h"

#include <catch2/catch.hpp>

#include "apps/foliage_benchmark/trade.h"
#include "foliage/far_pack.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"
#include "gl/context.h"
#include "gl/error_log.h"

namespace manzana::foliage_benchmark {
namespace {

/// What a wood of trees so high is drawn as, with an error of a pixel.
class Wood {
 public:
  struct Drawn {
    std::uint64_t near = 0, mosaics = 0, points = 0;  ///< primitives
    Picture picture;
  };
  Drawn draw(const std::optional<FarKnobs>& knobs, double height_px) {
    TradePlan plan = plan_;
    plan.far.heights = {height_px};
    const Sight sight = wood_motifs(plants_, plan).front().sights.front();
    const HowDrawn how = with_far({foliage::Law::ours, 1, knobs}, sight, stage_, &far_);
    Drawn drawn;
    drawn.picture = stage_.draw(sight.runs, sight.shot, how);
    drawn.near = primitives_of(stage_.shown());
    if (knobs) drawn.mosaics = far_->mosaics, drawn.points = far_->points;
    return drawn;
  }

 private:
  TradePlan plan_ = trade_plan(true);
  std::vector<foliage::PreparedPlant> plants_{
      prepare(grow_plant(foliage::builtin_species("shrub"), 1), {.visibility_side = 0})};
  Stage stage_{plants_, make_wood(plants_, plan_)};
  Lazy<FarSide> far_{[this] { return FarSide(plants_, stage_.sites()); }};
};

}  // namespace

TEST_CASE("far side: without mosaics and groves it draws what is near, and with them as its knobs say") {
  const gl::HeadlessContext context;
  gl::ErrorLog log;
  Wood wood;
  const auto near = wood.draw({}, 6), none = wood.draw(FarKnobs{0, {.all = 0}}, 6);
  CHECK(none.mosaics + none.points == 0);
  CHECK(none.picture.texels == near.picture.texels);
  const auto mosaics = wood.draw(FarKnobs{24, {.all = 0}}, 6);
  CHECK(mosaics.near + mosaics.points == 0);
  CHECK(mosaics.mosaics > 0);
  const auto grove = wood.draw(FarKnobs{}, 6), finer = wood.draw(FarKnobs{24, {.points = 1.4}}, 6);
  CHECK(grove.near + grove.mosaics == 0);
  CHECK(grove.points > 0);
  CHECK(finer.points == Approx(2 * grove.points).epsilon(0.05));
  CHECK(wood.draw(FarKnobs{24, {.all = 4}}, 6).points == 0);
  CHECK(wood.draw(FarKnobs{}, 40).mosaics == 0);
  CHECK(wood.draw(FarKnobs{60, {}}, 40).near == 0);
  CHECK(wood.draw(FarKnobs{}, 6).points == grove.points);  // the knobs of another picture are forgotten
  CHECK(log.messages().empty());
}

TEST_CASE("far side: where trees are no mosaics yet a grove takes over at once and nothing is drawn twice") {
  const gl::HeadlessContext context;
  Wood wood;
  bool near = false, grove = false;
  for (double height = 12; height > 6; height -= 0.5) {
    const auto drawn = wood.draw(FarKnobs{0, {}}, height);
    CAPTURE(height);
    CHECK(drawn.mosaics == 0);
    CHECK((drawn.near == 0) != (drawn.points == 0));
    near |= drawn.near > 0, grove |= drawn.points > 0;
  }
  CHECK((near && grove));
}

TEST_CASE("far side: a pack that comes brings nothing of the others anew") {
  const gl::HeadlessContext context;
  std::vector<foliage::PreparedPlant> plants;
  for (const char* species : {"shrub", "conifer"})
    plants.push_back(prepare(grow_plant(foliage::builtin_species(species), 3), {.visibility_side = 0}));
  const Stage stage(plants, sites_of(plants));
  const auto rows = rows_seen_from({0, 0, 0});
  draw::FarTrees far(plants.size(), shaders_with_mask());
  const auto begin_frame = [&] { split_trees(far, {stage.table(), {stage.sites(), rows, {}}}, nullptr); };
  add_pack(far, 0, make_far_pack(plants[0]));
  begin_frame();
  const GLuint first = far.packs[0].drawer->store().colours.name();
  REQUIRE(first != 0);
  add_pack(far, 1, make_far_pack(plants[1]));
  begin_frame();
  CHECK(far.packs[0].drawer->store().colours.name() == first);
  CHECK(far.packs[1].drawer->store().colours.name() != first);
}

}  // namespace manzana::foliage_benchmark
