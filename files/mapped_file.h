#pragma once
/// A file in memory, as it is: read where it is looked at, and shared with whoever reads it too. What takes its name
/// later does not change it; who writes into it, or cuts it off, does: so only files that are written whole.
///   const MappedFile file("city.manzana");
///   parse(file.bytes());
#include <cstddef>
#include <filesystem>
#include <span>

namespace manzana::files {

class MappedFile {
 public:
  /// A regular file. Throws std::runtime_error without the file's name ("no such file", "is no file").
  explicit MappedFile(const std::filesystem::path& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const { return {static_cast<const std::byte*>(at_), size_}; }
  /// What was read of it need not stay in memory; it is read again when it is looked at again.
  void let_go() const;

 private:
  void* at_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace manzana::files
