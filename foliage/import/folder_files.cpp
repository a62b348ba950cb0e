#include "foliage/import/folder_files.h"

#include <algorithm>
#include <stdexcept>

#include "files/whole_file.h"

namespace manzana::foliage {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

}  // namespace

std::optional<fs::path> FolderFiles::find(const std::string& name) const {
  const fs::path relative(name);
  if (!folder_) fail("refers to the file " + name + ", and this one is read without others");
  if (relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end())
    fail("refers to " + name + ", outside its folder");
  std::error_code error;
  const fs::path folder = fs::canonical(*folder_, error);
  if (error) fail("its folder is not readable");
  const fs::path full = fs::canonical(folder / relative, error);
  if (error || !fs::is_regular_file(full, error)) return std::nullopt;
  if (std::mismatch(folder.begin(), folder.end(), full.begin(), full.end()).first != folder.end())
    fail("refers to " + name + ", a link that leads outside its folder");
  return full;
}

std::optional<std::vector<unsigned char>> FolderFiles::read(const std::string& name) {
  const auto full = find(name);
  names_read_.push_back(name);
  if (!full) return std::nullopt;
  if (fs::file_size(*full) > bytes_left_) fail("refers to too many bytes in other files");
  std::vector<unsigned char> bytes = files::read_whole(*full, bytes_left_);
  bytes_left_ -= bytes.size();
  return bytes;
}

}  // namespace manzana::foliage
