#pragma once
/// The material libraries (MTL) of an OBJ file, as a plant's triangles wear them.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "foliage/import/folder_files.h"
#include "foliage/import/source_part.h"

namespace manzana::foliage {

class ObjMaterials {
 public:
  explicit ObjMaterials(FolderFiles& files) : files_(files) {}

  /// Reads a library. What is absent or broken is left out and noted; what lies outside the folder throws.
  void add_library(const std::string& name);

  /// The material's number in taken(): asked for by every usemtl.
  int number(std::string_view name);

  /// All that were asked for; those that no library has are plain.
  std::vector<SourceMaterial> taken();

  const std::vector<std::string>& notes() const { return notes_; }

 private:
  struct Look {
    Vec3 colour{1};
    std::string picture, alpha;  // file names
  };

  void read_library(std::string_view text);
  SourceMaterial material(const std::string& name);
  void wear_picture(const Look& look, SourceMaterial& out);

  FolderFiles& files_;
  std::map<std::string, Look, std::less<>> looks_;
  std::map<std::string, int, std::less<>> numbers_;
  std::vector<std::string> names_, notes_;
  std::map<std::string, SourceMaterial> worn_;  // by the pictures' names: each is decoded once
};

}  // namespace manzana::foliage
