// Written whole or not at all: by who is killed, and onto a disk that is full.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <thread>

#include "scenegraph/import/baked_city.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;

namespace {

const Imported& town() {
  static const Imported city = import_city("builtin:town", {.cars = 100}, {});
  return city;
}

/// What a process of its own comes to: 0 where `work` did not throw.
template <class Work>
pid_t in_child(Work&& work) {
  const pid_t child = fork();
  if (child != 0) return child;
  try {
    work();
    _exit(0);
  } catch (const std::exception&) {
    _exit(3);
  }
}
int status_of(pid_t child) {
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  return status;
}

/// No room for more than a part of the file.
void with_little_room(const std::filesystem::path& file) {
  const rlimit limit{100'000, 100'000};
  std::signal(SIGXFSZ, SIG_IGN);
  if (setrlimit(RLIMIT_FSIZE, &limit) == 0) write_baked(file, town());
}

}  // namespace

TEST_CASE("baked: who is killed in the middle leaves the file that was there or none") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "town.manzana";
  support::Random random(4);
  const std::string bytes = baked_bytes(town());
  int killed = 0, whole = 0;
  for (int round = 0; round < 25; ++round) {
    if (round % 5 == 0) std::filesystem::remove(file);
    const pid_t child = in_child([&] {
      for (;;) write_baked(file, town());
    });
    std::this_thread::sleep_for(std::chrono::microseconds(random.below(60'000)));
    kill(child, SIGKILL);
    killed += WIFSIGNALED(status_of(child)) ? 1 : 0;
    if (!std::filesystem::exists(file)) continue;
    ++whole;
    REQUIRE(std::filesystem::file_size(file) == bytes.size());
    REQUIRE(read_baked(file).scene.tree.objects() == town().scene.tree.objects());
  }
  CHECK(killed == 25);
  CHECK(whole > 0);
}

TEST_CASE("baked: onto a full disk nothing is written and what was there stays") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "town.manzana";
  CHECK(WEXITSTATUS(status_of(in_child([&] { with_little_room(file); }))) == 3);
  CHECK(files_in(folder.path()) == 0);
  write_baked(file, town());
  CHECK(WEXITSTATUS(status_of(in_child([&] { with_little_room(file); }))) == 3);
  CHECK(files_in(folder.path()) == 1);
  CHECK(read_baked(file).scene.tree.objects() == town().scene.tree.objects());
  CHECK_THROWS_WITH(write_baked(folder.path() / "no" / "town.manzana", town()), Catch::Contains("cannot be written"));
}
