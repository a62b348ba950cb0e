#pragma once
/// What the command line says.
///   const Parsed parsed = parse_options(argc, argv);
///   if (!parsed.options) return apps::reply(parsed);      // --help, --version or wrong usage
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/program.h"

namespace manzana::culling_benchmark {

struct Options {
  std::filesystem::path out;
  std::vector<std::string> cases;  ///< names of cases, or files
  std::vector<std::string> peers;  ///< slugs in the tables' order, bqr among them
  std::optional<int> frames;       ///< of the flight; without it the mode decides
  std::uint64_t seed = 1;
  bool quick = false, growth = false, trade = false, paper = false, extremes = false, cars = false, semantics = false,
       list = false;
  bool paper_process = false;  ///< this is the process that draws for `paper`
  int process = 0;  ///< 1, 2, ...: this is that process of a run, and tells its parent on stdout; 0: the parent
};

using Parsed = apps::Parsed<Options>;
Parsed parse_options(int argc, const char* const* argv);

/// Cases and peers, and which of them cannot be had here.
std::string list_text();

}  // namespace manzana::culling_benchmark
