#pragma once
/// A folder that is there whole or not at all: filled beside, under another name, then renamed.
///   WholeFolder whole("helsinki-tiles");
///   write_whole(whole.part() / "tileset.json", json);
///   whole.finish();
/// Who fills one holds a lock on it, which ends with the process; so what one who was killed left beside is known, and
/// the next who writes the same folder removes it.
#include <filesystem>

namespace manzana::files {

class WholeFolder {
 public:
  /// `folder` is not there, or empty. Throws std::runtime_error ("FOLDER: what").
  explicit WholeFolder(std::filesystem::path folder);
  /// Nothing is left behind that was not finished.
  ~WholeFolder();
  WholeFolder(const WholeFolder&) = delete;
  WholeFolder& operator=(const WholeFolder&) = delete;

  const std::filesystem::path& part() const { return part_; }  ///< where to write
  /// Throws as the constructor does.
  void finish();

 private:
  std::filesystem::path folder_, part_;
  int lock_ = -1;
};

}  // namespace manzana::files
