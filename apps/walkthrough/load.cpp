#include "apps/walkthrough/load.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <mutex>
#include <numeric>

#include "apps/common/progress_bar.h"
#include "foliage/import/species.h"
#include "scenegraph/import/baked_city.h"
#include "scenegraph/import/cityjson.h"
#include "scenegraph/import/ecosystem_features.h"
#include "scenegraph/import/read_photo.h"
#include "scenegraph/import/terrain.h"
#include "scenegraph/import/tree_species.h"

namespace manzana::walkthrough {
namespace {

static_assert(foliage::kSpeciesNames.size() == kPlantSpecies);

/// The last of that species counts; else the last that stands for its kind.
const std::filesystem::path* file_for(const Options& options, PlantSpecies species) {
  const std::filesystem::path *own = nullptr, *of_kind = nullptr;
  for (const PlantFile& plant : options.plants) {
    if (plant.species == species) own = &plant.file;
    if (plant.species == plain_species(kind_of(species))) of_kind = &plant.file;
  }
  return own != nullptr ? own : of_kind;
}

/// Texts from files may hold anything: control characters would break lines and terminals.
std::string printable(std::string text) {
  for (char& c : text) c = static_cast<unsigned char>(c) < 32 || c == 127 ? ' ' : c;
  return text;
}

void tell(const std::string& line) { std::fprintf(stderr, "%s\n", printable(line).c_str()); }

/// The mean of what several tasks have done, whichever thread tells.
class SharedBar {
 public:
  SharedBar(std::string_view stage, std::size_t tasks) : bar_(stderr), stage_(stage), done_(tasks, 0) {}
  void tell(std::size_t task, double done) {
    const std::scoped_lock lock(mutex_);
    done_[task] = std::max(done_[task], done);
    bar_.show(stage_, std::accumulate(done_.begin(), done_.end(), 0.0) / static_cast<double>(done_.size()));
  }

 private:
  std::mutex mutex_;
  apps::ProgressBar bar_;
  std::string stage_;
  std::vector<double> done_;
};

/// load(which, how) of many, side by side.
template <class Load>
void load_each(const Options& options, std::span<const std::size_t> which, Load&& load) {
  SharedBar bar("plants", which.size());
  const bool asks = options.tree_law == foliage::Law::prune || options.tree_law == foliage::Law::ramp;
  tbb::parallel_for(std::size_t{0}, which.size(), [&](std::size_t task) {
    foliage::PrepareOptions how;
    if (!asks) how.visibility_side = 0;  // the others do not ask for it
    how.progress = [&bar, task](double done) { bar.tell(task, done); };
    load(which[task], how);
    bar.tell(task, 1);
  });
}

std::vector<std::size_t> species_where(const auto& holds) {
  std::vector<std::size_t> those;
  for (std::size_t i = 0; i < kPlantSpecies; ++i)
    if (holds(i)) those.push_back(i);
  return those;
}

bool has_file(const Options& options, std::size_t species) {
  return file_for(options, static_cast<PlantSpecies>(species)) != nullptr;
}

bool is_ecosystem(const std::string& city) {
  return std::filesystem::path(city).extension() == ".json" && !is_cityjson(city);
}

CityFeatures load_ecosystem(const Options& options, Plants& plants) {
  const foliage::Ecosystem ecosystem = foliage::read_ecosystem(options.city);
  std::vector<std::size_t> all(ecosystem.plants.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  plants.resize(kPlantSpecies + all.size());
  load_each(options, all, [&](std::size_t i, const foliage::PrepareOptions& how) {
    plants[kPlantSpecies + i] =
        foliage::load_or_prepare(ecosystem.plants[i], foliage::default_cache_folder(), how, tell);
  });
  return ecosystem_features(ecosystem, std::span(plants).subspan(kPlantSpecies));
}

/// With a terrain none is: read_city() says what is wrong with those that are baked.
bool is_scene(const Options& options, const std::string& city) { return is_baked(city) && options.terrain.empty(); }

std::vector<Imported> load_scenes(const Options& options) {
  std::vector<Imported> scenes;
  if (is_scene(options, options.city)) scenes.push_back(read_baked(options.city));
  for (const std::string& city : options.more)
    if (is_scene(options, city)) scenes.push_back(read_baked(city));
  return scenes;
}

/// Of everything else; none: there is nothing else.
std::optional<CityFeatures> load_features(const Options& options, const ImportOptions& how, const Progress& show,
                                          Plants& plants) {
  std::optional<CityFeatures> all;
  const auto add = [&](CityFeatures more) { all ? merge(*all, std::move(more)) : void(all = std::move(more)); };
  if (is_ecosystem(options.city))
    add(load_ecosystem(options, plants));
  else if (!options.city.empty() && !is_scene(options, options.city))
    add(read_city(options.city, how, show));
  for (const std::string& city : options.more)
    if (!is_scene(options, city)) add(read_city(city, how, show));
  for (const auto& list : options.tree_lists) add(read_tree_list(list, options.tree_columns, how));
  return all;
}

/// Without its photo.
Imported load_plain_city(const Options& options, Plants& plants) {
  const ImportOptions how{
      .seed = options.seed, .cars = options.cars, .lod = options.lod, .reference_system = options.reference_system};
  std::vector<Imported> scenes = load_scenes(options);
  apps::ProgressBar bar(stderr);
  const auto show = [&](std::string_view stage, double fraction) { bar.show(stage, fraction); };
  if (auto features = load_features(options, how, show, plants)) {
    const Terrain terrain = options.terrain.empty() ? Terrain() : read_terrain(options.terrain, *features);
    const bool first = !is_scene(options, options.city);
    scenes.insert(first ? scenes.begin() : scenes.end(), build_scene(std::move(*features), terrain, how, show));
  }
  return merge(std::move(scenes));
}

}  // namespace

Plants load_named_plants(const Options& options) {
  Plants plants(kPlantSpecies);
  const auto named = species_where([&](std::size_t i) { return has_file(options, i); });
  load_each(options, named, [&](std::size_t i, const foliage::PrepareOptions& how) {
    const auto* file = file_for(options, static_cast<PlantSpecies>(i));
    plants[i] = foliage::load_or_prepare({*file}, foliage::default_cache_folder(), how, tell);
  });
  return plants;
}

Imported load_city(const Options& options, Plants& plants) {
  if (!options.orthophoto.empty() && !std::filesystem::exists(options.orthophoto))  // before the work, not after
    throw std::runtime_error(options.orthophoto.string() + ": no such file");
  Imported city = load_plain_city(options, plants);
  Scene& scene = city.scene;
  if (!options.orthophoto.empty())
    scene.photo = read_ground_photo(options.orthophoto, scene.frame, scene.bounds, options.reference_system);
  return city;
}

void load_other_plants(const Options& options, const Scene& scene, Plants& plants) {
  const auto stands = species_in(scene);
  const auto missing = species_where([&](std::size_t i) { return stands[i] && !has_file(options, i); });
  load_each(options, missing, [&](std::size_t i, const foliage::PrepareOptions& how) {
    plants[i] =
        foliage::grow_or_prepare(foliage::kSpeciesNames[i], options.seed, foliage::default_cache_folder(), how, tell);
  });
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
