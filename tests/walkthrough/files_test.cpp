#include <stb_image.h>

#include "apps/walkthrough/load.h"
#include "apps/walkthrough/png.h"
#include "apps/walkthrough/progress_bar.h"
#include "apps/walkthrough/recorder.h"
#include "apps/walkthrough/whole_file.h"
#include "tests/walkthrough/temporary_folder.h"

using namespace manzana;
using namespace manzana::walkthrough;

namespace {

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

std::string shown(bool terminal, const std::vector<std::pair<const char*, double>>& steps) {
  std::FILE* out = std::tmpfile();
  REQUIRE(out != nullptr);
  {
    ProgressBar bar(out, terminal);
    for (const auto& [stage, fraction] : steps) bar.show(stage, fraction);
  }
  std::string text(static_cast<std::size_t>(std::ftell(out)), '\0');
  std::rewind(out);
  CHECK(std::fread(text.data(), 1, text.size(), out) == text.size());
  std::fclose(out);
  return text;
}

}  // namespace

TEST_CASE("png: read back by another reader gives the same pixels") {
  const TemporaryFolder folder;
  Picture picture{{37, 23}, {}};
  for (int i = 0; i < 37 * 23 * 3; ++i) picture.rgb.push_back(static_cast<unsigned char>(i * 2654435761U >> 13));
  const auto file = folder.path() / "p.png";
  write_png(file, picture);
  int width = 0, height = 0, channels = 0;
  unsigned char* pixels = stbi_load(file.c_str(), &width, &height, &channels, 0);
  REQUIRE(pixels != nullptr);
  CHECK(width == 37);
  CHECK(height == 23);
  CHECK(channels == 3);
  CHECK(std::equal(picture.rgb.begin(), picture.rgb.end(), pixels));
  stbi_image_free(pixels);
}

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

TEST_CASE("recorder: a recorded path can be read back, and the next one gets another name") {
  const TemporaryFolder folder;
  Recorder recorder;
  CHECK_THROWS(recorder.stop(folder.path()));
  for (int round = 0; round < 2; ++round) {
    recorder.start(10);
    for (int i = 0; i <= 60; ++i)
      recorder.take(10 + i / 60.0, {{static_cast<double>(i), 0, 2}, {static_cast<double>(i), 9, 2}});
    const CameraPath path = read_path(recorder.stop(folder.path() / "new"));
    CHECK(path.begin() == 0);
    CHECK(path.keys.size() == 6);
    CHECK(pose_at(path, 0.5).eye.x == Approx(30).margin(1));
  }
  CHECK(files_in(folder.path() / "new") == 2);
}

TEST_CASE("issues: the first few, and a table without stray line breaks") {
  const std::vector<Issue> issues{{"way 1", "open"}, {"way 2", "a\nb\tc"}, {"way 3", "x"}};
  CHECK(issue_lines({}).empty());
  CHECK(issue_lines(issues, 1) == "3 issues\n  way 1: open\n  ...\n");
  CHECK(issue_lines(issues, 3).ends_with("way 3: x\n"));
  CHECK(issue_table(issues) == "way 1\topen\nway 2\ta b c\nway 3\tx\n");
}
