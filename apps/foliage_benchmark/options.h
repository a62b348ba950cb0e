#pragma once
/// What the command line says.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/program.h"

namespace manzana::foliage_benchmark {

struct Options {
  std::filesystem::path out;
  std::vector<std::string> plants;  ///< FILE or FILE#SYSTEM; none: species of our own
  bool quick = false;
  std::vector<double> heights;  ///< pixels; none: those of the mode
  std::optional<int> views;
  double error_px = 1;
  bool errors_only = false;  ///< the first section alone
  bool sheets_only = false;  ///< contact sheets alone
  bool trade = false;        ///< speed for accuracy alone
  bool forest = false;       ///< a forest along a path alone
};

using Parsed = apps::Parsed<Options>;
Parsed parse_options(int argc, const char* const* argv);

}  // namespace manzana::foliage_benchmark
