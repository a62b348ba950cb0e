// manzana-bake: prepares plants ahead of time.
// SHOWS: load_plant, prepare, write_prepared. READ FIRST: foliage/prepare.h.
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

foliage::PreparedPlant prepared(const foliage::Plant& plant, const std::string& file) {
  apps::ProgressBar bar(stderr);
  foliage::PrepareOptions options;
  options.progress = [&](double done) { bar.show("preparing", done); };
  try {
    return foliage::prepare(plant, options);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

int run(const bake::Options& options) {
  const double start = seconds_now();
  const foliage::PlantReading reading = foliage::load_plant(options.source);
  print(bake::source_report(reading));
  const double read = seconds_now();
  const foliage::PreparedPlant plant = prepared(reading.plant, options.source.file.string());
  print(bake::prepared_report(plant));
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
