#include "apps/culling_benchmark/options.h"

#include "apps/culling_benchmark/catalogue.h"
#include "apps/culling_benchmark/rules.h"
#include "culling/baselines/peer.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;
using namespace manzana::culling_benchmark;

namespace {

Parsed parse(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "manzana-culling-benchmark");
  std::vector<const char*> argv;
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  return parse_options(static_cast<int>(argv.size()), argv.data());
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("options: the defaults are a full run of all cases and structures") {
  const Parsed parsed = parse({"--out", "x"});
  REQUIRE(parsed.options);
  CHECK(parsed.options->out == "x");
  CHECK(parsed.options->seed == 1);
  CHECK(parsed.options->peers.size() == baselines::peers().size());
  CHECK(parsed.options->peers.front() == "bqr");
  CHECK(cases_of(*parsed.options).size() >= 11);
  CHECK(rules_of(*parsed.options).mode == "full");
  CHECK(rules_of(*parsed.options).processes >= 6);
  CHECK(rules_of(*parsed.options).limits.pairs >= 50);
  CHECK(frames_of(*parsed.options, "1M") == 300);
}

TEST_CASE("options: quick is one process, nine pairs or more, and its own cases") {
  const Parsed parsed = parse({"--out", "x", "--quick"});
  REQUIRE(parsed.options);
  CHECK(cases_of(*parsed.options) == Texts{"C2", "10k", "100k", "100k-cold", "1M-1km"});
  CHECK(rules_of(*parsed.options).processes == 1);
  CHECK(rules_of(*parsed.options).limits.least_pairs >= 9);
  CHECK(frames_of(*parsed.options, "100k") == 300);
  CHECK(frames_of(*parsed.options, "1M-1km") == 100);
  CHECK(frames_of(*parse({"--out", "x", "--quick", "--frames", "7"}).options, "1M-1km") == 7);
}

TEST_CASE("options: the parts of a full run are given 35 minutes together and the cases of a quick one 40 s") {
  const Options full = *parse({"--out", "x"}).options, quick = *parse({"--out", "x", "--quick"}).options;
  const auto process_seconds = [](const Options& options) {
    double seconds = 0;
    for (const std::string& name : cases_of(options)) seconds += case_seconds(options, name);
    return seconds;
  };
  const Besides more = besides(full);
  CHECK(kProcesses * process_seconds(full) + more.paper + more.sharing + more.cars + more.extremes < 35 * 60);
  CHECK(process_seconds(quick) == Approx(40));
  CHECK(besides(quick).paper == 0);
}

TEST_CASE("options: growth is the larger city beside the smaller one in every run of it") {
  const Options options = *parse({"--out", "x", "--quick", "--peers", "linear"}).options;
  CHECK(peers_for(options, "1M-1km") == Texts{"bqr", "linear", kSmallerCity});
  CHECK(peers_for(options, "1M") == Texts{"bqr", "linear"});
  REQUIRE(peer_info(kSmallerCity) != nullptr);
  CHECK(can_measure("1M-1km", kSmallerCity));
}

TEST_CASE("options: lists by commas, repeated options, nothing twice") {
  const Parsed parsed = parse({"--out", "x", "--case", "C1,10k,C1", "--case", "a.osm", "--peers", "linear,none"});
  REQUIRE(parsed.options);
  CHECK(parsed.options->cases == Texts{"C1", "10k", "a.osm"});
  CHECK(parsed.options->peers == Texts{"bqr", "none", "linear"});
}

TEST_CASE("options: a file is one case, even with a comma in its name") {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "a,b.osm";
  std::ofstream(file) << "";
  CHECK(parse({"--out", "x", "--case", file}).options->cases == Texts{file});
}

TEST_CASE("options: wrong usage is told in one line that ends with where to read on") {
  for (const Texts& arguments :
       {Texts{}, Texts{"--quick"}, Texts{"--out", "x", "--peers", "oak"}, Texts{"--out", "x", "--frames", "0"},
        Texts{"--out", "x", "--seed", "-1"}, Texts{"--nonsense"}, Texts{"stray"}}) {
    const Parsed parsed = parse(arguments);
    CAPTURE(arguments, parsed.text);
    CHECK_FALSE(parsed.options);
    CHECK(parsed.exit_code == 2);
    CHECK(parsed.text.ends_with("(see --help)\n"));
    CHECK(parsed.text.find('\n') == parsed.text.size() - 1);
  }
}

TEST_CASE("options: help, version and the list need no folder") {
  CHECK(parse({"--help"}).exit_code == 0);
  CHECK(parse({"--help"}).text.find("--process") == std::string::npos);
  CHECK(parse({"--version"}).text.starts_with("manzana-culling-benchmark "));
  REQUIRE(parse({"--list"}).options);
  for (const baselines::PeerInfo& peer : baselines::peers())
    CHECK(list_text().find("  " + std::string(peer.slug) + " ") != std::string::npos);
}

TEST_CASE("options: the extremes are part of a full run, and may be all of one") {
  CHECK(with_extremes(*parse({"--out", "x"}).options));
  CHECK(!with_extremes(*parse({"--out", "x", "--quick"}).options));
  CHECK(!with_extremes(*parse({"--out", "x", "--paper"}).options));
  const Parsed alone = parse({"--out", "x", "--extremes"});
  CHECK(with_extremes(*alone.options));
  CHECK(!with_paper(*alone.options));
  CHECK(cases_of(*alone.options).empty());
}

TEST_CASE("options: moving cars are part of a full run, and may be all of one") {
  CHECK(with_cars(*parse({"--out", "x"}).options));
  CHECK(!with_cars(*parse({"--out", "x", "--quick"}).options));
  CHECK(!with_cars(*parse({"--out", "x", "--extremes"}).options));
  const Parsed alone = parse({"--out", "x", "--cars"});
  CHECK(with_cars(*alone.options));
  CHECK(!with_extremes(*alone.options));
  CHECK(cases_of(*alone.options).empty());
}

TEST_CASE("options: the paper's experiments are part of a full run, and may be all of one") {
  CHECK(with_paper(*parse({"--out", "x"}).options));
  CHECK(!with_paper(*parse({"--out", "x", "--quick"}).options));
  CHECK(!with_paper(*parse({"--out", "x", "--case", "C2"}).options));
  const Parsed both = parse({"--out", "x", "--quick", "--case", "C2", "--paper"}),
               alone = parse({"--out", "x", "--paper"});
  CHECK(with_paper(*both.options));
  CHECK(cases_of(*both.options) == Texts{"C2"});
  CHECK(with_paper(*alone.options));
  CHECK(cases_of(*alone.options).empty());
}
