#include "files/whole_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <stdexcept>
#include <string>
#include <vector>

#include "files/whole_file.h"

namespace manzana::files {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPart = ".part";

/// A handle that holds the folder's lock; -1: somebody else does, or it is no folder, or locks are not known there.
int locked(const fs::path& folder) {
  const int handle = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (handle < 0 || flock(handle, LOCK_EX | LOCK_NB) == 0) return handle;
  close(handle);
  return -1;
}

/// Whether that folder still has the name: between being made and being locked somebody may have removed it.
bool has_name(int handle, const fs::path& name) {
  struct stat by_handle {
  }, by_name{};
  return fstat(handle, &by_handle) == 0 && stat(name.c_str(), &by_name) == 0 && by_handle.st_ino == by_name.st_ino &&
         by_handle.st_dev == by_name.st_dev;
}

bool is_part_of(const fs::path& folder, const fs::path& other) {
  const std::string name = other.filename().string(), begin = folder.filename().string() + kPart;
  return name.size() > begin.size() && name.starts_with(begin) &&
         std::all_of(name.begin() + static_cast<std::ptrdiff_t>(begin.size()), name.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// What nobody fills any more.
void remove_left_over(const fs::path& folder) {
  const fs::path beside = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
  std::error_code error;
  std::vector<fs::path> parts;
  for (fs::directory_iterator at(beside, error), end; !error && at != end; at.increment(error))
    if (is_part_of(folder, at->path())) parts.push_back(at->path());
  for (const fs::path& part : parts) {
    const int handle = locked(part);
    if (handle < 0) continue;
    fs::remove_all(part, error);
    close(handle);
  }
}

}  // namespace

WholeFolder::WholeFolder(fs::path folder) : folder_(std::move(folder)) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();
  std::error_code error;
  if (fs::exists(folder_, error) && !fs::is_empty(folder_, error))
    throw std::runtime_error(folder_.string() + ": is there already, and not empty");
  remove_left_over(folder_);
  fs::path part = folder_;
  part += kPart + std::to_string(getpid());
  constexpr int kTries = 3;
  for (int i = 0; i < kTries && part_.empty(); ++i) {
    make_folder(part);
    lock_ = locked(part);
    if (lock_ < 0 && errno == EWOULDBLOCK) throw std::runtime_error(part.string() + ": another program writes there");
    if (lock_ < 0 || has_name(lock_, part)) part_ = part;
  }
  if (part_.empty()) throw std::runtime_error(part.string() + ": another program removes it");
}

WholeFolder::~WholeFolder() {
  std::error_code ignored;
  if (!part_.empty()) fs::remove_all(part_, ignored);
  if (lock_ >= 0) close(lock_);
}

void WholeFolder::finish() {
  std::error_code error;
  fs::rename(part_, folder_, error);
  if (error) throw std::runtime_error(folder_.string() + ": cannot be written: " + error.message());
  part_.clear();
}

}  // namespace manzana::files
