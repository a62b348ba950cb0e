// The paper's experiments from outside: the files that the program leaves.
#include <algorithm>

#include "tests/support/program.h"

namespace {

Ended run_paper(const std::filesystem::path& folder) {
  return run_program(MANZANA_CULLING_BENCHMARK, folder,
                     {"--out", folder / "out", "--quick", "--paper", "--frames", "1"});
}

}  // namespace

TEST_CASE("benchmark: the paper's experiments are drawn and kept, and not drawn again") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  const Ended ended = run_paper(folder.path());
  CAPTURE(ended.err);
  REQUIRE(ended.code == 0);
  const std::string rows = read_all(out / "paper.csv"), frames = read_all(out / "paper_frames.csv");
  CHECK(rows.starts_with("paper_table,paper_row,quantity,case,peer,"));
  CHECK(std::count(rows.begin(), rows.end(), '\n') > 60);
  CHECK(std::count(frames.begin(), frames.end(), '\n') > 40);
  CHECK(rows.find(",1.68802e+06,") != std::string::npos);
  const std::string report = read_all(out / "report.md");
  CHECK(report.find("## Pina 2009") != std::string::npos);
  CHECK(report.find("Where ours differ") != std::string::npos);
  CHECK(read_all(out / "columns.md").find("paper_ratio") != std::string::npos);
  CHECK(std::filesystem::exists(out / "plots" / "paper_fig9.gp"));

  REQUIRE(run_paper(folder.path()).code == 0);
  CHECK(read_all(out / "paper_frames.csv") == frames);
  CHECK(read_all(out / "paper.csv") == rows);
}
