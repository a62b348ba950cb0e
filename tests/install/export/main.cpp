// The built-in town as a GeoPackage.
#include <cstdio>
#include <filesystem>

#include "scenegraph/export/geopackage.h"
#include "scenegraph/import/import.h"

int main() {
  const auto file = std::filesystem::temp_directory_path() / "manzana-export-consumer.gpkg";
  const manzana::Imported city = manzana::import_city("builtin:town", {}, {});
  const manzana::GeopackageWritten written = manzana::write_geopackage(city.scene, file, {});
  std::filesystem::remove(file);
  std::printf("%zu buildings and %zu trees written\n", written.buildings, written.trees);
}
