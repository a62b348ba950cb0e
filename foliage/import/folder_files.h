#pragma once
/// The files that a model may name: those in its folder or below it, links followed. No others.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace manzana::foliage {

class FolderFiles {
 public:
  /// Without a folder there are none.
  FolderFiles(std::optional<std::filesystem::path> folder, std::uint64_t most_bytes)
      : folder_(std::move(folder)), bytes_left_(most_bytes) {}

  bool has_folder() const { return folder_.has_value(); }

  /// Nothing if it is absent. Throws std::runtime_error for what lies outside.
  std::optional<std::filesystem::path> find(const std::string& name) const;

  /// The same; and throws when all that was read is more than most_bytes.
  std::optional<std::vector<unsigned char>> read(const std::string& name);

  /// What read() was asked for, in order: read, or found absent.
  const std::vector<std::string>& names_read() const { return names_read_; }

 private:
  std::optional<std::filesystem::path> folder_;
  std::uint64_t bytes_left_;
  std::vector<std::string> names_read_;
};

}  // namespace manzana::foliage
