#include "apps/walkthrough/recorder.h"

#include <cstdio>
#include <stdexcept>

#include "files/whole_file.h"

namespace manzana::walkthrough {

std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& prefix,
                                const std::string& suffix) {
  for (int number = 1;; ++number) {
    char digits[16];
    std::snprintf(digits, sizeof digits, "%03d", number);
    auto file = folder / (prefix + digits + suffix);
    if (!std::filesystem::exists(file)) return file;
  }
}

void Recorder::start(double now) {
  on_ = true;
  start_ = now;
  path_ = {"recorded", {}};
}

void Recorder::take(double now, const CameraPose& pose) {
  constexpr double kEvery = 0.2 - 1e-6;  // seconds; a frame that comes on time but for rounding counts
  if (!on_ || (!path_.keys.empty() && now - start_ < path_.keys.back().t + kEvery)) return;
  path_.keys.push_back({now - start_, pose});
}

std::filesystem::path Recorder::stop(const std::filesystem::path& folder) {
  on_ = false;
  if (path_.keys.empty()) throw std::runtime_error("nothing was recorded");
  files::make_folder(folder);
  const auto file = free_name(folder, "path-", ".json");
  files::write_whole(file, to_json(path_));
  return file;
}

}  // namespace manzana::walkthrough
