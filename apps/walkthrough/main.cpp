// manzana-walkthrough: walks, flies and drives through a city; without a display draws a camera path to files.
// SHOWS: import_city, VisibleSets, Renderer. READ FIRST: frame.cpp, then headless.cpp or window.cpp.
#include <cstdio>
#include <string>

#include "apps/walkthrough/builtin_paths.h"
#include "apps/walkthrough/headless.h"
#include "apps/walkthrough/load.h"
#include "apps/walkthrough/options.h"
#include "apps/walkthrough/window.h"
#include "files/whole_file.h"

namespace {

using namespace manzana;
using namespace manzana::walkthrough;

void print_city(const Imported& city) {
  std::printf("%s\n", report_line(city).c_str());
  if (!city.scene.attribution.empty()) std::printf("%s\n", city.scene.attribution.c_str());
  std::fflush(stdout);
  std::fputs(issue_lines(city.issues).c_str(), stderr);
}

/// What the user named is looked at first, so that a wrong name does not cost an import.
void run(const Options& options) {
  const Display display(options.headless);
  if (!display.open() && !options.headless)
    std::fprintf(stderr, "no display: drawing the path %s to files in %s\n", options.path.c_str(), options.out.c_str());
  CameraPath path;
  if (!is_builtin_path(options.path)) path = read_path(options.path);
  Plants plants = load_named_plants(options);
  if (!display.open()) files::make_folder(options.out);
  const Imported city = load_city(options, plants);
  load_other_plants(options, city.scene, plants);
  print_city(city);
  if (path.keys.empty()) path = builtin_path(options.path, city.scene);
  display.open() ? run_window(options, city, plants, path) : run_headless(options, city, plants, path);
}

}  // namespace

int main(int argc, char** argv) {
  const Parsed parsed = parse_options(argc, argv);
  if (!parsed.options) return apps::reply(parsed);
  return apps::guarded("manzana-walkthrough", parsed.options->city, [&] {
    run(*parsed.options);
    return 0;
  });
}
