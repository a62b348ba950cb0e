// manzana-bake: prepares plants ahead of time.
// SHOWS: load_plant, prepare, bake_visibility, write_prepared. READ FIRST: foliage/prepare.h.
#include <chrono>
#include <cstdio>
#include <stdexcept>

#include "apps/bake/options.h"
#include "apps/bake/report.h"
#include "apps/common/progress_bar.h"
#include "foliage/import/plant_cache.h"

namespace {

using namespace manzana;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

/// And who counted what is seen of its cells.
std::pair<foliage::PreparedPlant, std::string> prepared(const foliage::Plant& plant, const bake::Options& options) {
  constexpr double kBefore = 0.4;  // of the work, where visibility is counted
  const double before = options.visibility == bake::VisibilityBy::none ? 1 : kBefore;
  apps::ProgressBar bar(stderr);
  foliage::PrepareOptions how;
  how.visibility_side = 0;
  how.progress = [&](double done) { bar.show("preparing", before * done); };
  try {
    foliage::PreparedPlant ready = foliage::prepare(plant, how);
    const auto tell = [&](double done) { bar.show("preparing", before + (1 - before) * done); };
    std::string by = bake::bake_visibility(ready, options.visibility, tell);
    tell(1);
    return {std::move(ready), std::move(by)};
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(options.source.file.string() + ": " + error.what());
  }
}

int run(const bake::Options& options) {
  const double start = seconds_now();
  const foliage::PlantReading reading = foliage::load_plant(options.source);
  print(bake::source_report(reading));
  const double read = seconds_now();
  const auto [plant, counted_by] = prepared(reading.plant, options);
  print(bake::prepared_report(plant));
  std::printf("visibility %u directions a side, by: %s\n", plant.visibility.side, counted_by.c_str());
  foliage::write_prepared(options.out, plant);
  std::printf("seconds    %.2f to read, %.2f to prepare and write %s\n", read - start, seconds_now() - read,
              options.out.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bake::Parsed parsed = bake::parse_options(argc, argv);
  if (!parsed.options) return apps::reply(parsed);
  return apps::guarded("manzana-bake", parsed.options->source.file.string(), [&] { return run(*parsed.options); });
}
