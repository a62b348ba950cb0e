#pragma once
/// The file of write_geopackage: SQLite with the tables that OGC 12-128r18 asks for.
///   GeopackageFile file("city.gpkg.part");
///   GeopackageLayer trees(file, "trees", "POINT", {{"species", "TEXT"}, {"height", "REAL"}});
///   trees.add(points_of_wkb, {"oak", 12.5});
///   trees.finish();                                                 // extent
///   file.finish();
#include <sqlite3.h>

#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "culling/vec.h"

namespace manzana {

/// Degrees: (longitude, latitude). Rings are open here, closed in the file.
using GeoRing = std::vector<Vec2d>;
using GeoPolygon = std::vector<GeoRing>;  ///< outer, then holes

class GeopackageFile {
 public:
  explicit GeopackageFile(const std::filesystem::path& file);  ///< throws std::runtime_error without the file's name
  ~GeopackageFile();
  GeopackageFile(const GeopackageFile&) = delete;
  GeopackageFile& operator=(const GeopackageFile&) = delete;
  void run(const std::string& sql);
  void finish();
  sqlite3* handle() const { return db_; }
  [[noreturn]] void fail() const;

 private:
  sqlite3* db_ = nullptr;
};

class GeopackageLayer {
 public:
  using Value = std::variant<std::int64_t, double, std::string>;
  struct Column {
    std::string name, type;
  };

  GeopackageLayer(GeopackageFile& file, std::string name, const std::string& geometry, std::vector<Column> columns);
  void add(const Vec2d& point, const std::vector<Value>& values);
  void add(const std::vector<GeoPolygon>& shape, const std::vector<Value>& values);
  void finish();  ///< writes the extent, and the triggers that keep the index
  std::size_t rows() const { return rows_; }

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;
  Statement prepare(const std::string& sql) const;
  void insert(const std::string& wkb, const Vec2d& low, const Vec2d& high, const std::vector<Value>& values);

  GeopackageFile& file_;
  std::string name_;
  Statement row_, index_;
  std::size_t rows_ = 0;
  Vec2d low_{0, 0}, high_{0, 0};
};

}  // namespace manzana
