// Zhang 2004: what packs of mosaics take, how long they take to make and to draw, and what they look like.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "apps/common/clock.h"
#include "apps/common/markdown.h"
#include "apps/foliage_benchmark/forest.h"
#include "apps/foliage_benchmark/packs.h"
#include "apps/foliage_benchmark/portrait.h"
#include "apps/foliage_benchmark/stand_in.h"
#include "apps/foliage_benchmark/times_md.h"
#include "foliage/ldm_sampler.h"
#include "foliage/make_ldm.h"
#include "foliage/prepare.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::LdmOptions;
using foliage::LdmPack;
using foliage::LdmSides;
using foliage::LdmTally;
using foliage::PreparedPlant;
using Way = Packs::Way;

/// [Zhang 2004, tables 1 and 2]
struct SourceTree {
  const char* name;
  double triangles, adaptive_mib, aware_mib, mosaics_kib, minutes;
};
constexpr std::array<SourceTree, 3> kTrees{
    {{"#0", 19076, 9.66, 7.0, 318, 21}, {"#1", 60059, 8.0, 5.66, 226, 65}, {"#2", 430836, 11.0, 7.66, 294, 290}}};
constexpr double kMiB = 1 << 20, kKiB = 1 << 10, kMsOfMinute = 60000, kSourceForestMs = 150, kSourceTreeMs = 2;
constexpr const char* kTable1 = "Zhang 2004, table 1";
constexpr const char* kTable2 = "Zhang 2004, table 2";
constexpr const char* kOneTree = "Zhang 2004, one tree";
constexpr const char* kErrors = "Zhang 2004, image errors";
constexpr const char* kForest = "Zhang 2004, forest";
constexpr HowDrawn kFine{1, Sampling::fine}, kProduct{1, Sampling::product};

/// A way of making packs and of drawing them.
struct Kind {
  const char* name;
  LdmOptions options;
  int fine;  ///< samples along a side of a pixel that is made
  Way way;
};
const std::array<Kind, 3> kKinds{
    {{"as the source", {.sides = LdmSides::paper}, 1, Way::blended},
     {"dithered", {}, 4, Way::dithered},
     {"dithered, 12 layers, mosaics from 8 px", {.layers = 12, .smallest = 8}, 4, Way::dithered}}};

struct Made {
  std::vector<LdmPack> packs;  ///< one
  LdmTally tally;
  double ms = 0;
};

Made make(const PreparedPlant& plant, const Kind& kind) {
  const auto start = apps::Clock::now();
  Made made;
  made.packs.push_back(
      make_ldm_pack(ldm_ball(plant), kind.options, foliage::LdmSampler(plant, kind.fine), {}, &made.tally));
  made.ms = apps::us_since(start) / 1000;
  return made;
}

/// A broadleaf with about as many triangles in all.
PreparedPlant plant_with(double triangles) {
  const auto bark = static_cast<double>(grow_plant(foliage::builtin_species("broadleaf"), 1).mesh.bark.triangles());
  return prepare(grown_to("broadleaf", std::max(1.0, triangles - bark)), {.visibility_side = 0});
}

double triangles_of(const PreparedPlant& plant) {
  return 2.0 * static_cast<double>(foliage::finest_bark(plant).size() + plant.leaves.size());
}

/// A plant near one of the source's, as far as it is asked for.
struct Subject {
  explicit Subject(const SourceTree& tree)
      : source(tree),
        plant([this] { return plant_with(source.triangles); }),
        by_source([this] { return make(*plant, kKinds[0]); }),
        ours([this] { return make(*plant, kKinds[1]); }) {
    name = std::string(tree.name) + ", " + apps::grouped(tree.triangles) + " triangles";
  }
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;

  const SourceTree& source;
  std::string name;
  Lazy<PreparedPlant> plant;
  Lazy<Made> by_source, ours;
};

void add_bytes(Subject& subject, const Kind& kind, Lazy<Made>& made, bool of_source, Times& times) {
  const auto add = [&](const char* what, double source, auto&& bytes) {
    times.add({.table = kTable1, .plant = subject.name, .way = std::string(kind.name) + ": " + what},
              [&, source, bytes](TimeRow& row) {
                row.bytes = bytes(*made);
                row.reference_primitives = static_cast<std::uint64_t>(triangles_of(*subject.plant));
                if (of_source && source > 0) row.source_value = source;
              });
  };
  const auto page_bytes = [](const Made& m) {
    return foliage::ldm_bytes(static_cast<double>(m.packs[0].pages()) * foliage::kLdmPage * foliage::kLdmPage);
  };
  add("raw textures", 30 * kMiB, [](const Made& m) { return foliage::ldm_bytes(m.tally.raw); });
  add("adaptive, s = 0", subject.source.adaptive_mib * kMiB,
      [](const Made& m) { return foliage::ldm_bytes(m.tally.adaptive); });
  add("occlusion-aware", subject.source.aware_mib * kMiB,
      [](const Made& m) { return foliage::ldm_bytes(m.tally.aware); });
  add("occlusion-aware, whole pages", 0, page_bytes);
  add("the same with depth and normals", 0, [=](const Made& m) { return 2 * page_bytes(m); });
  add("mosaics and blocks", subject.source.mosaics_kib * kKiB,
      [](const Made& m) { return static_cast<double>(m.packs[0].mosaic_bytes()); });
}

void add_preparing(Subject& subject, const Kind& kind, Lazy<Made>& made, bool of_source, Times& times) {
  times.add({.table = kTable2, .plant = subject.name, .way = kind.name}, [&, of_source](TimeRow& row) {
    row.reference_primitives = static_cast<std::uint64_t>(triangles_of(*subject.plant));
    row.ms = made->ms;
    if (of_source) row.source_value = subject.source.minutes * kMsOfMinute;
  });
}

/// Mosaics, errors and times of one way, of a plant so high.
void add_one(const Effort& effort, Subject& subject, const Kind& kind, Lazy<Made>& made, double height_px,
             Times& times) {
  times.add({.table = kOneTree,
             .plant = subject.name,
             .way = std::string(kind.name) + " at " + std::to_string(std::lround(height_px)) + " px",
             .reference = "all detail"},
            [&, height_px](TimeRow& row) {
              Portrait portrait(*subject.plant, height_px);
              Stage& stage = portrait.stage();
              const foliage::Run run = portrait.run();
              Packs packs(made->packs);
              const Paint paint = packs.painter(stage, {&run, 1}, portrait.shot(), kind.way);
              const Picture full = portrait.draw(all_detail(*subject.plant), Sampling::fine);
              const ImageError error = image_error(full, stage.draw(paint, portrait.shot(), Sampling::fine));
              row.primitives = 2 * packs.mosaics();
              row.reference_primitives = static_cast<std::uint64_t>(triangles_of(*subject.plant));
              set_errors(error, row);
              set_times(
                  time_pairs([&] { stage.draw_only(paint, portrait.shot(), Sampling::product); },
                             [&] { stage.draw_only({{run}}, portrait.shot(), kProduct); }, effort.seconds() / 4, 1),
                  row);
              row.source_value = kSourceTreeMs;
            });
}

/// Of one plant from some sides, beside the floor that sampling sets.
class Errors {
 public:
  Errors(const Effort& effort, const PreparedPlant& plant, Times& times)
      : views_(effort.quick ? 2 : 6), plant_(plant), times_(times) {}

  void add(double height_px, bool finer) {
    const std::string at = " at " + std::to_string(std::lround(height_px)) + " px";
    add("all detail, 4 samples" + at, height_px, [](Stage& stage, const Shot& shot, TimeRow&) {
      return stage.draw(foliage::Run{0, 1}, shot, kProduct);
    });
    for (std::size_t i = 0; i < (finer ? kKinds.size() : 2); ++i)
      for (const Sampling sampling : {Sampling::fine, Sampling::product}) {
        const std::string name = sampling == Sampling::fine ? ", finely sampled" : ", 4 samples";
        add(kKinds[i].name + name + at, height_px, [this, i, sampling](Stage& stage, const Shot& shot, TimeRow& row) {
          const foliage::Run run{0, 1};
          Picture seen = stage.draw(packs_[i]->painter(stage, {&run, 1}, shot, kKinds[i].way), shot, sampling);
          row.primitives = row.primitives.value_or(0) + 2 * packs_[i]->mosaics() / static_cast<std::uint64_t>(views_);
          return seen;
        });
      }
  }

 private:
  using Draw = std::function<Picture(Stage&, const Shot&, TimeRow&)>;

  void add(const std::string& way, double height_px, const Draw& draw) {
    times_.add({.table = kErrors, .plant = plant_.name, .way = way, .reference = "all detail, finely sampled"},
               [&](TimeRow& row) { measure(height_px, draw, row); });
  }

  void measure(double height_px, const Draw& draw, TimeRow& row) {
    constexpr std::array kElevationsDeg{2.0, 20.0, 45.0};
    constexpr double kDegree = std::numbers::pi / 180;
    ImageError sum{0, 0, 0, 0, 0, 0, 0};
    stage_->set_law(foliage::Law::full);
    for (int view = 0; view < views_; ++view) {
      const double elevation = kElevationsDeg[static_cast<std::size_t>(view) % kElevationsDeg.size()];
      const Shot shot = shot_of(extent_of(plant_), 360.0 * view / views_ * kDegree, elevation * kDegree, height_px);
      const ImageError error = image_error(stage_->draw(foliage::Run{0, 1}, shot, kFine), draw(*stage_, shot, row));
      for (const auto member : {&ImageError::cover, &ImageError::colour, &ImageError::ssim, &ImageError::gmsd})
        sum.*member += error.*member / views_;
    }
    set_errors(sum, row);
  }

  int views_;
  const PreparedPlant& plant_;
  Times& times_;
  Lazy<Stage> stage_{[this] { return Stage({&plant_, 1}, sites_of({&plant_, 1})); }};
  std::array<Lazy<Packs>, 3> packs_{{packs_of(0), packs_of(1), packs_of(2)}};

  Lazy<Packs> packs_of(std::size_t kind) {
    return Lazy<Packs>([this, kind] { return Packs(make(plant_, kKinds[kind]).packs); });
  }
};

/// Packs of many trees against our law's triangles and points, in turn.
class PackForest {
 public:
  PackForest(std::span<const PreparedPlant> species, std::vector<foliage::TreeSite> sites)
      : extents_(extents_of(species)), stage_(species, sites, {.quads = 1U << 22}), packs_(packs_of(species)) {}

  void measure(const Shot& shot, double seconds, TimeRow& row) {
    const auto runs = in_view(stage_, extents_, shot);
    const Paint paint = packs_.painter(stage_, runs, shot, Way::dithered);
    stage_.set_law(foliage::Law::ours);
    row.covered_px = static_cast<double>(covered(stage_.draw(paint, shot, Sampling::product)));
    row.trees = trees_of(runs);
    row.primitives = 2 * packs_.mosaics();
    stage_.draw_only(runs, shot, kProduct);
    row.reference_primitives = primitives_of(stage_.shown());
    set_times(time_pairs([&] { stage_.draw_only(paint, shot, Sampling::product); },
                         [&] { stage_.draw_only(runs, shot, kProduct); }, seconds, 1),
              row);
    row.source_value = kSourceForestMs;
  }

 private:
  static std::vector<LdmPack> packs_of(std::span<const PreparedPlant> species) {
    std::vector<LdmPack> packs;
    for (const PreparedPlant& plant : species) packs.push_back(std::move(make(plant, kKinds[1]).packs[0]));
    return packs;
  }

  std::vector<Extent> extents_;
  Stage stage_;
  Packs packs_;
};

void add_forest(const Effort& effort, std::span<const PreparedPlant> plants, Times& times) {
  const auto species = plants.first(std::min<std::size_t>(plants.size(), 7));
  const std::uint32_t trees = effort.quick ? 200 : 4000;
  const double spacing = closed_spacing(species), half = spacing * std::sqrt(trees) / 2;
  Lazy<PackForest> forest([&] { return PackForest(species, make_forest(species, trees, spacing, 3)); });
  int frame = 0;
  for (const Shot& shot :
       forest_path(half, effort.quick ? 2 : 6, effort.screen_height(), static_cast<double>(species.front().height_m)))
    times.add({.table = kForest,
               .plant = std::to_string(species.size()) + " species",
               .way = "dithered, frame " + std::to_string(frame++),
               .reference = "triangles and points by our law"},
              [&](TimeRow& row) { forest->measure(shot, effort.quick ? 0 : 2, row); });
}

void add_text(Times& times) {
  times.text +=
      "## Zhang 2004: LDM-Pack\n\nBroadleaves with about as many triangles as the source's trees. \"As the source\": "
      "15 sides, 6 layers of 256 x 256, one sample a pixel, blended between sides; \"dithered\": 18 sides, 16 samples "
      "a pixel, each sample of the screen shows one side, mosaics turn to the eye.\n\nTable 1: bytes of textures with "
      "mip levels, 4 a texel, and of the mosaics of all sides and levels.\n\n" +
      rows_md(times.rows, kTable1) + "Table 2: milliseconds to make a pack of a prepared plant; the source's too.\n\n" +
      rows_md(times.rows, kTable2) +
      "One tree: each mosaic is two triangles (the source: 500 to 1 000 mosaics, 2 ms); errors finely sampled.\n\n" +
      rows_md(times.rows, kOneTree) +
      "Errors, means over sides, beside what four samples a pixel do to all detail.\n\n" +
      rows_md(times.rows, kErrors) +
      "Many trees along a path over the forest and into it (the source: 4 000 trees of 7 species, 100 to 200 ms).\n\n" +
      rows_md(times.rows, kForest);
}

}  // namespace

void add_zhang(const Effort& effort, std::span<const PreparedPlant> plants, Times& times) {
  for (const SourceTree& tree : std::span(kTrees).first(effort.quick ? 1 : kTrees.size())) {
    Subject subject(tree);
    for (const auto& [kind, made] : {std::pair{&kKinds[0], &subject.by_source}, {&kKinds[1], &subject.ours}}) {
      add_bytes(subject, *kind, *made, kind == &kKinds[0], times);
      add_preparing(subject, *kind, *made, kind == &kKinds[0], times);
      for (const double height_px : {256.0, 64.0, 16.0}) add_one(effort, subject, *kind, *made, height_px, times);
    }
  }
  for (const PreparedPlant& plant : plants.first(std::min<std::size_t>(plants.size(), effort.quick ? 1 : 3))) {
    Errors errors(effort, plant, times);
    for (const double height_px : {256.0, 128.0, 64.0, 32.0, 16.0})
      if (!effort.quick || height_px == 64 || height_px == 16) errors.add(height_px, !effort.quick);
  }
  add_forest(effort, plants, times);
  add_text(times);
}

}  // namespace manzana::foliage_benchmark
