// A tileset is there whole or not at all: who is killed in the middle, and a disk that is full.
#include <chrono>
#include <csignal>
#include <map>
#include <thread>

#include "tests/support/program.h"
#include "tests/support/random.h"

namespace {

using Files = std::map<std::string, std::string>;

Files all_in(const std::filesystem::path& folder) {
  Files files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[std::filesystem::relative(entry.path(), folder).string()] = read_all(entry.path());
  return files;
}

struct Village {
  TemporaryFolder folder, output;
  std::filesystem::path tiles = folder.path() / "tiles";
  std::vector<std::string> arguments{"tiles", MANZANA_VILLAGE, "-o", tiles.string()};
};

/// With files of so many bytes at most; what is larger fails as on a full disk.
Ended with_little_room(const Village& village, rlim_t most_bytes) {
  const rlimit limit{most_bytes, most_bytes};
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // the program inherits both
  const rlimit soft{limit.rlim_cur, before.rlim_max};
  REQUIRE(setrlimit(RLIMIT_FSIZE, &soft) == 0);
  const pid_t child = start_program(MANZANA_BAKE, village.output.path(), village.arguments);
  REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
  std::signal(SIGXFSZ, handler);
  return wait_for(child, village.output.path());
}

}  // namespace

TEST_CASE("bake tiles: who is killed in the middle leaves the whole tileset or none") {
  const Village village;
  const auto start = std::chrono::steady_clock::now();
  REQUIRE(run_program(MANZANA_BAKE, village.output.path(), village.arguments).code == 0);
  const auto whole = std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - start);
  const Files expected = all_in(village.tiles);
  REQUIRE(expected.contains("tileset.json"));
  support::Random random(9);
  int unfinished = 0;
  for (int round = 0; round < 20; ++round) {
    std::filesystem::remove_all(village.tiles);
    const pid_t child = start_program(MANZANA_BAKE, village.output.path(), village.arguments);
    std::this_thread::sleep_for(whole * random.within(0.2, 1.1));
    kill(child, SIGKILL);
    (void)wait_for(child, village.output.path());
    if (std::filesystem::exists(village.tiles))
      REQUIRE(all_in(village.tiles) == expected);
    else
      unfinished += files_in(village.folder.path()) > 0 ? 1 : 0;
  }
  CHECK(unfinished > 0);  // some were killed while they wrote
  std::filesystem::remove_all(village.tiles);
  REQUIRE(run_program(MANZANA_BAKE, village.output.path(), village.arguments).code == 0);
  CHECK(all_in(village.tiles) == expected);     // what they left is not in the way
  CHECK(files_in(village.folder.path()) == 1);  // nor there any more
}

TEST_CASE("bake tiles: onto a full disk nothing is written and it is told in one line") {
  const Village village;
  for (const rlim_t bytes : {rlim_t{2'000}, rlim_t{30'000}}) {
    const Ended ended = with_little_room(village, bytes);
    CAPTURE(ended.err);
    CHECK(ended.code == 1);
    CHECK_THAT(ended.err, Catch::Contains("manzana-bake: ") && Catch::Contains("cannot be written: File too large"));
    CHECK(files_in(village.folder.path()) == 0);
  }
}
