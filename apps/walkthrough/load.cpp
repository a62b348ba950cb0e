#include "apps/walkthrough/load.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cstdio>

#include "apps/common/progress_bar.h"
#include "foliage/generate.h"
#include "foliage/import/load_plant.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"

namespace manzana::walkthrough {
namespace {

constexpr std::array<const char*, 3> kSpecies{"broadleaf", "conifer", "shrub"};
static_assert(kSpecies.size() == static_cast<std::size_t>(PlantKind::count));

const std::filesystem::path* file_for(const Options& options, PlantKind kind) {
  const std::filesystem::path* file = nullptr;
  for (const PlantFile& plant : options.plants)
    if (plant.kind == kind) file = &plant.file;  // the last one counts
  return file;
}

/// Texts from files may hold anything: control characters would break lines and terminals.
std::string printable(std::string text) {
  for (char& c : text) c = static_cast<unsigned char>(c) < 32 || c == 127 ? ' ' : c;
  return text;
}

/// Kept prepared from one start to the next.
foliage::PreparedPlant load_file(const std::filesystem::path& file, const foliage::PrepareOptions& how) {
  const auto tell = [](const std::string& line) { std::fprintf(stderr, "%s\n", printable(line).c_str()); };
  return foliage::load_or_prepare({file}, foliage::default_cache_folder(), how, tell);
}

}  // namespace

Imported load_city(const Options& options) {
  apps::ProgressBar bar(stderr);
  const ImportOptions how{.seed = options.seed, .cars = options.cars};
  return import_city(options.city, how, [&](std::string_view stage, double fraction) { bar.show(stage, fraction); });
}

std::vector<foliage::PreparedPlant> load_plants(const Options& options) {
  std::vector<foliage::PreparedPlant> plants(kSpecies.size());
  foliage::PrepareOptions how;
  const bool asks = options.tree_law == foliage::Law::prune || options.tree_law == foliage::Law::ramp;
  if (!asks) how.visibility_side = 0;  // the others do not ask for it
  tbb::parallel_for(std::size_t{0}, kSpecies.size(), [&](std::size_t kind) {
    const auto* file = file_for(options, static_cast<PlantKind>(kind));
    plants[kind] =
        file != nullptr
            ? load_file(*file, how)
            : foliage::prepare(foliage::grow_plant(foliage::builtin_species(kSpecies[kind]), options.seed), how);
  });
  return plants;
}

std::string report_line(const Imported& city) {
  const ImportReport& r = city.report;
  char line[320];
  std::snprintf(line, sizeof line,
                "%zu blocks (%zu fallback), %zu objects (%zu in fallback blocks), objects per block: median %zu, "
                "largest %zu; %u buildings, %u trees, %u cars; import %.2f s",
                r.blocks, r.fallback_blocks, r.objects, r.fallback_objects, r.objects_median, r.objects_largest,
                city.scene.buildings.table.size(), city.scene.trees.table.size(), city.scene.traffic.cars(), r.seconds);
  return line;
}

std::string issue_lines(const std::vector<Issue>& issues, std::size_t most) {
  if (issues.empty()) return {};
  std::string lines = std::to_string(issues.size()) + " issues\n";
  for (std::size_t i = 0; i < std::min(most, issues.size()); ++i)
    lines += "  " + printable(issues[i].where) + ": " + printable(issues[i].what) + "\n";
  if (issues.size() > most) lines += "  ...\n";
  return lines;
}

std::string issue_table(const std::vector<Issue>& issues) {
  std::string table;
  for (const Issue& issue : issues) table += printable(issue.where) + "\t" + printable(issue.what) + "\n";
  return table;
}

}  // namespace manzana::walkthrough
