#include "apps/culling_benchmark/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "apps/culling_benchmark/catalogue.h"
#include "culling/baselines/peer.h"

namespace manzana::culling_benchmark {
namespace {

constexpr const char* kProgram = "manzana-culling-benchmark";
constexpr const char* kAbout =
    "Times the BqR-Tree against other structures, checks every answer against the exact one, and writes\n"
    "report.md, summary.csv, runs.csv, columns.md and plots. The same command goes on after an interrupt.\n"
    "Exit: 0 success, 1 bad input or an object missed, 2 wrong usage.";

/// Items of a comma list. A text that names a file is one item, whatever it holds.
std::vector<std::string> items(const std::vector<std::string>& texts) {
  std::vector<std::string> all;
  for (const std::string& text : texts) {
    if (std::filesystem::exists(text)) {
      all.push_back(text);
      continue;
    }
    std::istringstream in(text);
    for (std::string item; std::getline(in, item, ',');)
      if (!item.empty()) all.push_back(item);
  }
  return all;
}

std::vector<std::string> without_repetition(const std::vector<std::string>& texts) {
  std::vector<std::string> once;
  for (const std::string& text : texts)
    if (std::find(once.begin(), once.end(), text) == once.end()) once.push_back(text);
  return once;
}

struct Texts {
  std::vector<std::string> cases, peers;
};

void add_options(CLI::App& app, Options& options, Texts& texts) {
  app.add_option("--out", options.out, "folder for what is written; needed to time anything");
  app.add_option("--case", texts.cases, "comma list of cases (see --list) and of city files (.osm, .osm.pbf, ...)");
  app.add_option("--peers", texts.peers, "comma list of structures (see --list); bqr is always one");
  app.add_flag("--quick", options.quick, "C2, 10k, 100k, 100k-cold and 1M-1km in a minute, one process");
  app.add_flag("--growth", options.growth, "the cases of growing cities, from 1 000 to 10 000 000 objects");
  app.add_flag("--cars", options.cars, "what 10 000 moving cars in view cost among 10 000 to 1 000 000");
  app.add_flag("--semantics", options.semantics, "classes of objects filtered in the traversal and after it");
  app.add_flag("--trade", options.trade, "the cases of speed for accuracy: volumes and precisions");
  app.add_flag("--paper", options.paper, "the experiments of Pina 2009, drawn with OpenGL");
  app.add_flag("--extremes", options.extremes,
               "what is missed and falsely kept far from the origin, by whom; half a minute");
  app.add_option("--frames", options.frames,
                 "frames of the flight; 300, fewer for a quick million (100) and for growth (60)")
      ->check(CLI::Range(1, 100000));
  app.add_option("--seed", options.seed, "of the generated cities and of the order of measurement")
      ->check([](const std::string& text) { return std::string(text.starts_with('-') ? "is negative: " + text : ""); },
              "")
      ->capture_default_str();
  app.add_flag("--list", options.list, "print the cases and the structures");
  app.add_option("--process", options.process)->check(CLI::Range(1, 1000))->group("");  // for the program itself
  app.add_flag("--paper-process", options.paper_process)->group("");
}

/// The slugs that were asked for, or all; in the order of the tables. `unknown` takes the first that is none.
std::vector<std::string> chosen_peers(const std::vector<std::string>& asked, std::string& unknown) {
  for (const std::string& slug : asked)
    if (baselines::find_peer(slug) == nullptr && unknown.empty()) unknown = slug;
  std::vector<std::string> chosen;
  for (const baselines::PeerInfo& peer : baselines::peers()) {
    const bool named = std::find(asked.begin(), asked.end(), peer.slug) != asked.end();
    if (asked.empty() || named || peer.slug == "bqr") chosen.emplace_back(peer.slug);
  }
  return chosen;
}

Parsed refuse(const std::string& what) {
  apps::Reply reply = apps::wrong_usage(kProgram, what);
  return {std::nullopt, std::move(reply.text), reply.exit_code};
}

Parsed finish(Options options, const Texts& texts) {
  std::string unknown;
  options.cases = without_repetition(items(texts.cases));
  options.peers = chosen_peers(items(texts.peers), unknown);
  if (!unknown.empty()) return refuse("--peers: no such structure: " + unknown);
  if (options.out.empty() && !options.list) return refuse("--out is needed, a folder for what is written");
  return {std::move(options), {}, 0};
}

std::string line_of(std::string_view name, std::string_view what, bool available) {
  std::string line = "  " + std::string(name);
  line.resize(std::max<std::size_t>(line.size() + 1, 22), ' ');
  return line + std::string(what) + (available ? "\n" : " (unavailable: its library was not found)\n");
}

}  // namespace

Parsed parse_options(int argc, const char* const* argv) {
  CLI::App app(kAbout, kProgram);
  app.set_version_flag("--version", std::string(kProgram) + " " MANZANA_VERSION);
  Options options;
  Texts texts;
  add_options(app, options, texts);
  if (auto reply = apps::parse(app, argc, argv)) return {std::nullopt, std::move(reply->text), reply->exit_code};
  return finish(std::move(options), texts);
}

std::string list_text() {
  std::string text = "cases, or a city file (.osm, .osm.gz, .osm.bz2, .osm.pbf, builtin:town):\n";
  for (const Family family : {Family::speed, Family::growth, Family::trade})
    for (const std::string& name : names_of(family)) text += line_of(name, case_info(name).what, true);
  text += "structures:\n";
  for (const baselines::PeerInfo& p : baselines::peers()) text += line_of(p.slug, p.what, p.available);
  return text;
}

}  // namespace manzana::culling_benchmark
