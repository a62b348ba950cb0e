// Gumbau 2009: what extraction takes, and what pruned crowns look like.
#include <cmath>

#include "apps/common/markdown.h"
#include "apps/foliage_benchmark/grey_crown.h"
#include "apps/foliage_benchmark/portrait.h"
#include "apps/foliage_benchmark/sheet.h"
#include "apps/foliage_benchmark/stand_in.h"
#include "apps/foliage_benchmark/times_md.h"
#include "foliage/gl/index_list.h"
#include "foliage/prepare.h"

namespace manzana::foliage_benchmark {
namespace {

/// [Gumbau 2009, tables 1 and 2] milliseconds in all at 66, 33 and 15 %.
struct SourceTree {
  const char* name;
  const char* species;  // of ours, that stands for it
  std::uint32_t triangles;
  std::array<double, 3> ms, kernel_ms;
};
constexpr std::array<SourceTree, 4> kTrees{
    {{"Olea europaea", "broadleaf", 32214, {1.48, 1.41, 1.51}, {0.54, 0.50, 0.47}},
     {"Fraxinus ornus", "lime", 57290, {1.96, 1.71, 1.54}, {0.80, 0.61, 0.62}},
     {"Quercus cerris", "oak", 82310, {1.63, 1.42, 1.12}, {0.83, 0.65, 0.53}},
     {"Cedrus atlantica", "conifer", 262084, {2.86, 2.29, 1.75}, {2.23, 1.53, 1.12}}}};
constexpr std::array kShares{0.66, 0.33, 0.15};
constexpr const char* kTable2 = "Gumbau 2009, table 2";
constexpr const char* kFigure7 = "Gumbau 2009, figure 7";
constexpr const char* kFigure8 = "Gumbau 2009, figure 8";

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

/// A tree of the source's, as far as it is asked for.
struct Subject {
  Subject(std::string known_as, std::function<PreparedPlant()> make)
      : name(std::move(known_as)), plant(std::move(make)), portrait([this] { return Portrait(*plant, 256); }) {}
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;
  std::string name;
  Lazy<PreparedPlant> plant;
  Lazy<Portrait> portrait;
};

/// The source's own way: an index for each corner of each leaf that is kept.
void time_list(const Effort& effort, double share, const std::function<void()>& extract, const PreparedPlant& plant,
               TimeRow& row) {
  const foliage::PlantStore store({&plant, 1});
  foliage::IndexList list(store, 0);
  const std::vector<float> lods(list.cells, static_cast<float>(share));
  const auto write = [&] {
    write_list(list, store, lods);
    glFinish();
  };
  set_times(time_pairs(write, extract, effort.seconds(), 7), row);
  row.reference_primitives = 2 * plant.leaves.size();
}

void add_extraction(const Effort& effort, const SourceTree& tree, Subject& subject, Times& times) {
  const auto extract_at = [&](double share) {
    Portrait& portrait = *subject.portrait;
    portrait.use(pruned(*subject.plant, share));
    portrait.stage().extract_only({{portrait.run()}}, portrait.shot(), {});
  };
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    const auto extract = [&, i] { extract_at(kShares[i]); };
    times.add({.table = kTable2, .plant = subject.name, .way = percent(kShares[i]), .reference = "100 %"},
              [&](TimeRow& row) {
                set_times(time_pairs(
                              extract, [&] { extract_at(1); }, effort.seconds(), i),
                          row);
                row.source_value = tree.kernel_ms[i];
                row.reference_primitives = 2 * subject.plant->leaves.size();
              });
    const auto anew = [&, extract] {
      const foliage::PlantStore store({&*subject.plant, 1});
      extract();
    };
    times.add({.table = kTable2,
               .plant = subject.name,
               .way = percent(kShares[i]) + ", buffers made anew",
               .reference = "buffers kept"},
              [&](TimeRow& row) {
                set_times(time_pairs(anew, extract, effort.seconds(), i), row);
                row.source_value = tree.ms[i];
                row.reference_primitives = 2 * subject.plant->leaves.size();
              });
    times.add({.table = kTable2,
               .plant = subject.name,
               .way = percent(kShares[i]) + ", index list",
               .reference = "as forests are, at " + percent(kShares[i])},
              [&, extract](TimeRow& row) { time_list(effort, kShares[i], extract, *subject.plant, row); });
  }
}

void time_processors(const Effort& effort, Subject& subject, TimeRow& row) {
  Portrait& portrait = *subject.portrait;
  portrait.use(pruned(*subject.plant, 0.30));
  const auto eye_rows = rows_seen_from(portrait.shot().view.eye);
  const std::array runs{portrait.run()};
  foliage::Selection selection;
  const auto on_cpu = [&] {
    select(portrait.stage().table(), {portrait.stage().sites(), eye_rows, runs, 1 / portrait.shot().focal_px},
           selection);
  };
  set_times(time_pairs([&] { portrait.stage().extract_only(runs, portrait.shot(), {}); }, on_cpu, effort.seconds(), 9),
            row);
  row.reference_primitives = 2 * subject.plant->leaves.size();
}

constexpr std::array<std::pair<double, double>, 5> kSteps{
    {{0.70, 256}, {0.50, 181}, {0.35, 128}, {0.20, 91}, {0.15, 64}}};

void add_looks(Subject& subject, Times& times) {
  for (const auto& [share, height_px] : kSteps)
    times.add({.table = kFigure7,
               .plant = subject.name,
               .way = percent(share) + " at " + std::to_string(static_cast<int>(height_px)) + " px",
               .reference = "100 %"},
              [&](TimeRow& row) {
                Portrait portrait(*subject.plant, height_px);
                portrait.look(pruned(*subject.plant, share), all_detail(*subject.plant), row);
              });
}

/// Full beside each step, all of one size, so that one sees what is done; the steps' own sizes are in the table.
Picture steps_of(Subject& subject) {
  std::vector<Picture> parts;
  const auto add = [&](const std::string& name, const Detail& detail) {
    const Picture crown = trimmed(subject.portrait->draw(detail, Sampling::product));
    parts.push_back(below(std::array{crown, words(name)}));
  };
  add("full", all_detail(*subject.plant));
  for (const auto& step : kSteps) add(percent(step.first), pruned(*subject.plant, step.first));
  return beside(parts);
}

const std::string kGrey = "gumbau_figure_4.png", kSteps7 = "gumbau_figure_7.png";

void write_figures(const Effort& effort, Subject& subject) {
  if (!std::filesystem::exists(effort.out / kGrey)) write_sheet(effort.out / kGrey, grey_crown(*subject.plant, 256));
  if (!std::filesystem::exists(effort.out / kSteps7)) write_sheet(effort.out / kSteps7, steps_of(subject));
}

apps::Script plot_of(std::span<const TimeRow> rows) {
  const std::string name = "gumbau_figure_8";
  apps::Script script{name, apps::gnuplot_head(name) + "$d << E\n"};
  for (const TimeRow& row : rows)
    if (row.table == kFigure8)
      script.text += apps::to_cell(row.reference_primitives) + "," + apps::to_cell(row.ms) + "," +
                     apps::to_cell(row.reference_ms) + "\n";
  script.text +=
      "E\nset title 'Gumbau 2009, figure 8: choosing 30 % of the leaves of a tree'\nset logscale\n"
      "set xlabel 'leaf triangles of the tree'\nset ylabel 'ms'\n" +
      apps::plot_command({"$d using 1:2 with linespoints title 'GL compute'",
                          "$d using 1:3 with linespoints title 'its twin on one core'"});
  return script;
}

}  // namespace

void add_gumbau(const Effort& effort, std::span<const foliage::PreparedPlant> plants, Times& times) {
  for (const SourceTree& tree : kTrees) {
    Subject subject(effort.quick ? plants.front().name : std::string(tree.name) + " (" + tree.species + ")",
                    [&] { return effort.quick ? plants.front() : prepare(grown_to(tree.species, tree.triangles)); });
    add_extraction(effort, tree, subject, times);
    times.add(
        {.table = kFigure8, .plant = subject.name, .way = "GL compute, 30 %", .reference = "its twin on one core"},
        [&](TimeRow& row) { time_processors(effort, subject, row); });
    const bool last = &tree == &kTrees.back() || effort.quick;
    if (last) add_looks(subject, times);
    if (last) times.draw([&] { write_figures(effort, subject); });
    if (last) break;
  }
  times.plots.push_back(plot_of(times.rows));
  times.text +=
      "## Gumbau 2009: Modelo multiresolución para la copa de los árboles\n\n"
      "Species of our own with as many leaves as the source's trees stand for them (in a quick run: the first plant). "
      "Table 2: extraction of one tree, against all of its leaves; `source` is milliseconds on a GeForce 8800 GT, "
      "without and with its buffers' set-up; `index list` is its own way of extraction.\n\n" +
      rows_md(times.rows, kTable2) +
      "Figure 4: how much of each cell can be seen, white is all: from the camera, and from its left, the camera to "
      "the "
      "right.\n\n![visibility](" +
      kGrey +
      ")\n\nFigure 7: leaves pruned and scaled to keep the crown's cover, by distance as the source has "
      "them.\n\n![pruned](" +
      kSteps7 + ")\n\n" + rows_md(times.rows, kFigure7) + "Figure 8: the same choice on both processors.\n\n" +
      rows_md(times.rows, kFigure8);
}

}  // namespace manzana::foliage_benchmark
