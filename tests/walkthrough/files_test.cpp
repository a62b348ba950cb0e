#include <stb_image.h>

#include "apps/walkthrough/load.h"
#include "apps/walkthrough/png.h"
#include "apps/walkthrough/recorder.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;
using namespace manzana::walkthrough;

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
