// Runs that are ended from outside, and go on.
#include <signal.h>

#include <chrono>
#include <thread>

#include "apps/culling_benchmark/run_row.h"
#include "tests/support/program.h"

using namespace manzana::culling_benchmark;

namespace {

const std::vector<std::string> kRun{"--quick",  "--case", "C1,C2,10k,100k", "--peers", "bqr,none,linear",
                                    "--frames", "40"};
constexpr std::size_t kRows = 12;

std::vector<std::string> run_into(const std::filesystem::path& out) {
  std::vector<std::string> arguments = kRun;
  arguments.insert(arguments.end(), {"--out", out});
  return arguments;
}

std::vector<RunRow> rows_in(const std::filesystem::path& out) { return read_rows(read_all(out / "runs.csv")); }

/// Ends the run by a signal as soon as it has some rows, but not all.
Ended interrupted_run(const TemporaryFolder& folder, const std::filesystem::path& out, int signal) {
  const pid_t child = start_program(MANZANA_CULLING_BENCHMARK, folder.path(), run_into(out));
  while (rows_in(out).size() < 3 && kill(child, 0) == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  kill(child, signal);
  return wait_for(child, folder.path());
}

void check_resumed(const TemporaryFolder& folder, const std::filesystem::path& out) {
  const auto before = rows_in(out);
  REQUIRE(before.size() >= 3);
  REQUIRE(before.size() < kRows);
  const Ended ended = run_program(MANZANA_CULLING_BENCHMARK, folder.path(), run_into(out));
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  const auto after = rows_in(out);
  REQUIRE(after.size() == kRows);
  CHECK(to_csv(std::span(after).first(before.size())) == to_csv(before));  // to the last digit: not measured again
  CHECK(std::filesystem::exists(out / "summary.csv"));
  CHECK_FALSE(std::filesystem::exists(out / "truth"));
  for (const auto& entry : std::filesystem::directory_iterator(out))
    CHECK_FALSE(entry.path().extension().string().starts_with(".part"));
}

}  // namespace

TEST_CASE("resume: a killed run keeps what it has, and goes on from there") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  CHECK(interrupted_run(folder, out, SIGKILL).code == 128 + SIGKILL);
  std::ofstream(out / "runs.csv.part123") << "what a kill may leave";
  check_resumed(folder, out);
}

TEST_CASE("resume: an interrupted run says how to go on, and goes on") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  const Ended ended = interrupted_run(folder, out, SIGINT);
  CHECK(ended.code == 1);
  CHECK(ended.err.find("interrupted: the same command goes on") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(out / "summary.csv"));
  check_resumed(folder, out);
}

TEST_CASE("resume: what was measured with another seed is measured again, and said to be") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  std::vector<std::string> arguments{"--out", out, "--quick", "--case", "C1", "--peers", "bqr", "--frames", "3"};
  REQUIRE(run_program(MANZANA_CULLING_BENCHMARK, folder.path(), arguments).code == 0);
  const auto first = rows_in(out);
  arguments.insert(arguments.end(), {"--seed", "2"});
  const Ended second = run_program(MANZANA_CULLING_BENCHMARK, folder.path(), arguments);
  CHECK(second.code == 0);
  CHECK(second.err.find("1 rows of another commit, machine, seed or mode") != std::string::npos);
  REQUIRE(rows_in(out).size() == 1);
  CHECK(rows_in(out)[0].seed == 2);
}
