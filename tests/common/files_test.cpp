#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "apps/common/progress_bar.h"
#include "files/whole_file.h"
#include "files/whole_folder.h"
#include "tests/support/temporary_folder.h"

using namespace manzana::apps;
using namespace manzana::files;

namespace {

std::string shown(bool terminal, const std::vector<std::pair<const char*, double>>& steps, const char* note = "") {
  std::FILE* out = std::tmpfile();
  REQUIRE(out != nullptr);
  {
    ProgressBar bar(out, terminal);
    for (const auto& [stage, fraction] : steps) bar.show(stage, fraction, note);
  }
  std::string text(static_cast<std::size_t>(std::ftell(out)), '\0');
  std::rewind(out);
  CHECK(std::fread(text.data(), 1, text.size(), out) == text.size());
  std::fclose(out);
  return text;
}

}  // namespace

TEST_CASE("files: written whole, replaced whole, nothing left beside them") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.txt";
  write_whole(file, "first");
  write_whole(file, std::string(100000, 'x') + '\0' + "end");
  CHECK(read_all(file).size() == 100004);
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("files: what cannot be written says which file, and leaves nothing") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(write_whole(folder.path() / "no" / "a.txt", "x"), Catch::Contains("a.txt: cannot be written"));
  std::filesystem::create_directory(folder.path() / "taken");
  std::filesystem::create_directory(folder.path() / "taken" / "inside");
  CHECK_THROWS_WITH(write_whole(folder.path() / "taken", "x"), Catch::Contains("taken: cannot be written"));
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("files: a folder is made with those above it, a file in the way is told") {
  const TemporaryFolder folder;
  make_folder(folder.path() / "a" / "b" / "c");
  CHECK(std::filesystem::is_directory(folder.path() / "a" / "b" / "c"));
  write_whole(folder.path() / "file", "x");
  CHECK_THROWS_WITH(make_folder(folder.path() / "file"), Catch::Contains("file: "));
  CHECK_THROWS_WITH(make_folder(folder.path() / "file" / "below"), Catch::Contains("below: "));
}

TEST_CASE("progress: plain lines, one for each quarter and stage") {
  CHECK(shown(false, {{"reading", 0}, {"reading", 0.1}, {"reading", 0.3}, {"meshes", 0.5}, {"meshes", 7}}) ==
        "reading: 0 %\nreading: 25 %\nmeshes: 50 %\nmeshes: 100 %\n");
}

TEST_CASE("progress: a bar on a terminal redraws its line and ends it") {
  const std::string text = shown(true, {{"reading", 0.5}, {"reading", 0.501}, {"reading", 1}});
  CHECK(text.find("\r") == 0);
  CHECK(text.find("50 %") != std::string::npos);
  CHECK(text.find("50 %") == text.rfind("50 %"));
  CHECK(text.ends_with("100 %\n"));
}

TEST_CASE("progress: the time left stands behind the bar in seconds or minutes") {
  CHECK(time_left(0) == "about 0 s left");
  CHECK(time_left(99.9) == "about 99 s left");
  CHECK(time_left(1770) == "about 30 min left");
  CHECK(shown(true, {{"reading", 0.5}}, "soon").find("50 %, soon") != std::string::npos);
  CHECK(shown(false, {{"reading", 0.5}}, "soon") == "reading: 50 %, soon\n");
}

TEST_CASE("files: a folder that is filled is there when it is finished and not before") {
  const TemporaryFolder folder;
  const auto tiles = folder.path() / "tiles";
  {
    const WholeFolder whole(tiles);
    write_whole(whole.part() / "a", "1");
    CHECK_FALSE(std::filesystem::exists(tiles));
  }
  CHECK(files_in(folder.path()) == 0);
  WholeFolder whole(tiles / "");
  write_whole(whole.part() / "a", "1");
  whole.finish();
  CHECK(files_in(folder.path()) == 1);
  CHECK(std::filesystem::exists(tiles / "a"));
  CHECK_THROWS_WITH(WholeFolder(tiles), Catch::EndsWith("tiles: is there already, and not empty"));
}

TEST_CASE("files: of what others left beside a folder goes what nobody fills any more") {
  const TemporaryFolder folder;
  const auto beside = [&](const std::string& end) { return folder.path() / ("tiles" + end); };
  const std::string own = ".part" + std::to_string(getpid());
  for (const std::string& end :
       {own, std::string(".part1"), std::string(".part1x"), std::string(".part"), std::string(".old")}) {
    std::filesystem::create_directories(beside(end) / "deep");
    write_whole(beside(end) / "deep" / "old", "old");
  }
  const WholeFolder other(folder.path() / "tiles.part22");  // a folder of such a name, being filled
  std::filesystem::create_directory(beside(".part2"));
  const int filled = open(beside(".part2").c_str(), O_RDONLY | O_DIRECTORY);
  REQUIRE(flock(filled, LOCK_EX | LOCK_NB) == 0);
  write_whole(beside(".part3"), "a file");
  std::filesystem::create_directory_symlink(folder.path(), beside(".part4"));
  WholeFolder whole(beside(""));
  CHECK(files_in(whole.part()) == 0);
  whole.finish();
  CHECK_FALSE(std::filesystem::exists(beside(".part1")));
  for (const char* end : {"", ".part", ".part1x", ".part2", ".part3", ".part4", ".old"})
    CHECK(std::filesystem::exists(beside(end)));
  CHECK(std::filesystem::exists(other.part()));
  close(filled);
}

TEST_CASE("files: two that fill one folder do not disturb each other") {
  const TemporaryFolder folder;
  const WholeFolder one(folder.path() / "tiles");
  write_whole(one.part() / "a", "1");
  CHECK_THROWS_WITH(WholeFolder(folder.path() / "tiles"), Catch::Contains("another program writes there"));
  CHECK(std::filesystem::exists(one.part() / "a"));
}
