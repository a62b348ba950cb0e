#include "apps/foliage_benchmark/options.h"

#include <CLI/CLI.hpp>

namespace manzana::foliage_benchmark {
namespace {

constexpr const char* kProgram = "manzana-foliage-benchmark";
constexpr const char* kAbout =
    "Measures what plants cost and how true they look under each law of detail, against all detail, and writes\n"
    "report.md, runs.csv, summary.csv, popping.csv, times.csv, columns.md, plots and contact sheets. The same command\n"
    "goes on after an interrupt.\n"
    "Exit: 0 success, 1 bad input, 2 wrong usage.";

}  // namespace

Parsed parse_options(int argc, const char* const* argv) {
  CLI::App app(kAbout, kProgram);
  app.set_version_flag("--version", std::string(kProgram) + " " MANZANA_VERSION);
  Options options;
  app.add_option("--out", options.out, "folder for what is written")->required();
  app.add_option("--plants", options.plants,
                 "files of plants (.glb, .gltf, .obj, .json; FILE#SYSTEM), in place of the species of our own");
  app.add_flag("--quick", options.quick, "fewer plants, distances, views and repetitions: a minute");
  app.add_option("--heights", options.heights, "comma list: heights of the plants in pixels, for image errors")
      ->delimiter(',')
      ->check(CLI::Range(4.0, 1024.0));
  app.add_option("--views", options.views, "round each plant, for image errors")->check(CLI::Range(1, 64));
  app.add_option("--error", options.error_px, "the error that is tolerated, pixels")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app.add_flag("--errors-only", options.errors_only, "image errors, without the tables of the sources");
  app.add_flag(
      "--trade", options.trade,
      "speed for accuracy alone: every law over the error that it is told, mosaics and groves by their knobs,\n"
      "how much each pops, and the profiles of quality");
  app.add_flag(
      "--forest", options.forest,
      "a forest of 4 000 trees along a path alone, with the settings of --quality balanced: its frames' times\n"
      "and errors");
  app.add_flag("--sheets-only", options.sheets_only, "contact sheets, without tables");
  if (auto reply = apps::parse(app, argc, argv)) return {std::nullopt, std::move(reply->text), reply->exit_code};
  return {std::move(options), {}, 0};
}

}  // namespace manzana::foliage_benchmark
