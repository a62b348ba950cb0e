#include "scenegraph/export/geopackage_file.h"

#include <cstring>
#include <limits>
#include <stdexcept>

namespace manzana {
namespace {

constexpr const char* kTables = R"(
PRAGMA application_id = 0x47504B47;
PRAGMA user_version = 10300;
PRAGMA journal_mode = OFF;
BEGIN;
CREATE TABLE gpkg_spatial_ref_sys (
  srs_name TEXT NOT NULL, srs_id INTEGER NOT NULL PRIMARY KEY, organization TEXT NOT NULL,
  organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL, description TEXT);
INSERT INTO gpkg_spatial_ref_sys VALUES
  ('Undefined cartesian SRS', -1, 'NONE', -1, 'undefined', 'undefined cartesian coordinate reference system'),
  ('Undefined geographic SRS', 0, 'NONE', 0, 'undefined', 'undefined geographic coordinate reference system'),
  ('WGS 84 geodetic', 4326, 'EPSG', 4326, 'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AXIS["Latitude",NORTH],AXIS["Longitude",EAST],AUTHORITY["EPSG","4326"]]', 'longitude/latitude coordinates in decimal degrees on the WGS 84 spheroid');
CREATE TABLE gpkg_contents (
  table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT UNIQUE, description TEXT DEFAULT '',
  last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')),
  min_x DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE, srs_id INTEGER,
  CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_geometry_columns (
  table_name TEXT NOT NULL, column_name TEXT NOT NULL, geometry_type_name TEXT NOT NULL, srs_id INTEGER NOT NULL,
  z TINYINT NOT NULL, m TINYINT NOT NULL, CONSTRAINT pk_geom_cols PRIMARY KEY (table_name, column_name),
  CONSTRAINT uk_gc_table_name UNIQUE (table_name),
  CONSTRAINT fk_gc_tn FOREIGN KEY (table_name) REFERENCES gpkg_contents(table_name),
  CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_extensions (
  table_name TEXT, column_name TEXT, extension_name TEXT NOT NULL, definition TEXT NOT NULL, scope TEXT NOT NULL,
  CONSTRAINT ge_tce UNIQUE (table_name, column_name, extension_name));
)";

/// Of the extension gpkg_rtree_index, for those who edit the layer.  [OGC 12-128r18, annex F.3]
constexpr const char* kTriggers = R"(
CREATE TRIGGER rtree_@_geom_insert AFTER INSERT ON "@"
  WHEN (NEW.geom NOT NULL AND NOT ST_IsEmpty(NEW.geom))
BEGIN INSERT OR REPLACE INTO rtree_@_geom VALUES
  (NEW.fid, ST_MinX(NEW.geom), ST_MaxX(NEW.geom), ST_MinY(NEW.geom), ST_MaxY(NEW.geom)); END;
CREATE TRIGGER rtree_@_geom_update1 AFTER UPDATE OF geom ON "@"
  WHEN OLD.fid = NEW.fid AND (NEW.geom NOTNULL AND NOT ST_IsEmpty(NEW.geom))
BEGIN INSERT OR REPLACE INTO rtree_@_geom VALUES
  (NEW.fid, ST_MinX(NEW.geom), ST_MaxX(NEW.geom), ST_MinY(NEW.geom), ST_MaxY(NEW.geom)); END;
CREATE TRIGGER rtree_@_geom_update2 AFTER UPDATE OF geom ON "@"
  WHEN OLD.fid = NEW.fid AND (NEW.geom ISNULL OR ST_IsEmpty(NEW.geom))
BEGIN DELETE FROM rtree_@_geom WHERE id = OLD.fid; END;
CREATE TRIGGER rtree_@_geom_update3 AFTER UPDATE ON "@"
  WHEN OLD.fid != NEW.fid AND (NEW.geom NOTNULL AND NOT ST_IsEmpty(NEW.geom))
BEGIN DELETE FROM rtree_@_geom WHERE id = OLD.fid;
  INSERT OR REPLACE INTO rtree_@_geom VALUES
  (NEW.fid, ST_MinX(NEW.geom), ST_MaxX(NEW.geom), ST_MinY(NEW.geom), ST_MaxY(NEW.geom)); END;
CREATE TRIGGER rtree_@_geom_update4 AFTER UPDATE ON "@"
  WHEN OLD.fid != NEW.fid AND (NEW.geom ISNULL OR ST_IsEmpty(NEW.geom))
BEGIN DELETE FROM rtree_@_geom WHERE id IN (OLD.fid, NEW.fid); END;
CREATE TRIGGER rtree_@_geom_delete AFTER DELETE ON "@" WHEN old.geom NOT NULL
BEGIN DELETE FROM rtree_@_geom WHERE id = OLD.fid; END;
)";

std::string with_name(std::string text, const std::string& name) {
  for (std::size_t at = text.find('@'); at != std::string::npos; at = text.find('@', at)) text.replace(at, 1, name);
  return text;
}

template <class T>
void put(std::string& out, const T& value) {  // the machines that we build for are little-endian
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

constexpr std::uint32_t kPoint = 1, kPolygon = 3, kMultiPolygon = 6;

void put_head(std::string& out, std::uint32_t type) {
  out.push_back(1);  // little-endian
  put(out, type);
}

void put_polygon(std::string& out, const GeoPolygon& polygon) {
  put_head(out, kPolygon);
  put(out, static_cast<std::uint32_t>(polygon.size()));
  for (const GeoRing& ring : polygon) {
    put(out, static_cast<std::uint32_t>(ring.size() + 1));
    for (std::size_t i = 0; i <= ring.size(); ++i) put(out, ring[i % ring.size()]);
  }
}

/// The header of a geometry, with its envelope: [OGC 12-128r18, 2.1.3]
std::string geometry(const std::string& wkb, const Vec2d& low, const Vec2d& high) {
  std::string out("GP\0\3", 4);
  put(out, std::int32_t{4326});
  for (const double v : {low.x, high.x, low.y, high.y}) put(out, v);
  return out + wkb;
}

}  // namespace

GeopackageFile::GeopackageFile(const std::filesystem::path& file) {
  if (sqlite3_open_v2(file.c_str(), &db_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr) != SQLITE_OK) {
    const std::string what = sqlite3_errmsg(db_);
    sqlite3_close(db_);
    throw std::runtime_error("cannot be written: " + what);
  }
  run(kTables);
}

GeopackageFile::~GeopackageFile() { sqlite3_close(db_); }

void GeopackageFile::fail() const {
  throw std::runtime_error(std::string("cannot be written: ") + sqlite3_errmsg(db_));
}

void GeopackageFile::run(const std::string& sql) {
  if (sqlite3_exec(db_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

void GeopackageFile::finish() { run("COMMIT"); }

GeopackageLayer::GeopackageLayer(GeopackageFile& file, std::string name, const std::string& type,
                                 std::vector<Column> columns)
    : file_(file), name_(std::move(name)) {
  std::string declared, marks;
  for (const Column& column : columns) {
    declared += ", \"" + column.name + "\" " + column.type;
    marks += ", ?";
  }
  file_.run("CREATE TABLE \"" + name_ + "\" (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom " + type + declared +
            ");\nINSERT INTO gpkg_contents (table_name, data_type, identifier, srs_id) VALUES ('" + name_ +
            "', 'features', '" + name_ + "', 4326);\nINSERT INTO gpkg_geometry_columns VALUES ('" + name_ +
            "', 'geom', '" + type + "', 4326, 0, 0);\nINSERT INTO gpkg_extensions VALUES ('" + name_ +
            "', 'geom', 'gpkg_rtree_index', 'http://www.geopackage.org/spec120/#extension_rtree', 'write-only');\n" +
            "CREATE VIRTUAL TABLE rtree_" + name_ + "_geom USING rtree(id, minx, maxx, miny, maxy);");
  row_ = prepare("INSERT INTO \"" + name_ + "\" VALUES (?, ?" + marks + ")");
  index_ = prepare("INSERT INTO rtree_" + name_ + "_geom VALUES (?, ?, ?, ?, ?)");
}

GeopackageLayer::Statement GeopackageLayer::prepare(const std::string& sql) const {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(file_.handle(), sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) file_.fail();
  return Statement(statement);
}

void GeopackageLayer::add(const Vec2d& point, const std::vector<Value>& values) {
  std::string wkb;
  put_head(wkb, kPoint);
  put(wkb, point);
  insert(wkb, point, point, values);
}

void GeopackageLayer::add(const std::vector<GeoPolygon>& shape, const std::vector<Value>& values) {
  std::string wkb;
  put_head(wkb, kMultiPolygon);
  put(wkb, static_cast<std::uint32_t>(shape.size()));
  Vec2d low(std::numeric_limits<double>::infinity()), high = -low;
  for (const GeoPolygon& polygon : shape) {
    put_polygon(wkb, polygon);
    for (const Vec2d& p : polygon.at(0)) low = glm::min(low, p), high = glm::max(high, p);
  }
  insert(wkb, low, high, values);
}

void GeopackageLayer::insert(const std::string& wkb, const Vec2d& low, const Vec2d& high,
                             const std::vector<Value>& values) {
  const std::string blob = geometry(wkb, low, high);
  const auto fid = static_cast<sqlite3_int64>(++rows_);
  sqlite3_stmt* row = row_.get();
  sqlite3_bind_int64(row, 1, fid);
  sqlite3_bind_blob(row, 2, blob.data(), static_cast<int>(blob.size()), SQLITE_STATIC);
  for (int i = 0; i < static_cast<int>(values.size()); ++i) {
    const Value& value = values[static_cast<std::size_t>(i)];
    if (const auto* text = std::get_if<std::string>(&value))
      sqlite3_bind_text(row, 3 + i, text->c_str(), static_cast<int>(text->size()), SQLITE_STATIC);
    else if (const auto* number = std::get_if<double>(&value))
      sqlite3_bind_double(row, 3 + i, *number);
    else
      sqlite3_bind_int64(row, 3 + i, std::get<std::int64_t>(value));
  }
  sqlite3_bind_int64(index_.get(), 1, fid);
  const double box[]{low.x, high.x, low.y, high.y};
  for (int i = 0; i < 4; ++i) sqlite3_bind_double(index_.get(), 2 + i, box[i]);
  for (sqlite3_stmt* statement : {row, index_.get()}) {
    if (sqlite3_step(statement) != SQLITE_DONE) file_.fail();
    sqlite3_reset(statement);
  }
  low_ = rows_ == 1 ? low : glm::min(low_, low);
  high_ = rows_ == 1 ? high : glm::max(high_, high);
}

void GeopackageLayer::finish() {
  row_.reset();
  index_.reset();
  if (rows_ > 0) {
    const Statement extent = prepare(
        "UPDATE gpkg_contents SET min_x = ?, min_y = ?, max_x = ?, max_y = ? WHERE table_name = '" + name_ + "'");
    const double box[]{low_.x, low_.y, high_.x, high_.y};
    for (int i = 0; i < 4; ++i) sqlite3_bind_double(extent.get(), 1 + i, box[i]);
    if (sqlite3_step(extent.get()) != SQLITE_DONE) file_.fail();
  }
  file_.run(with_name(kTriggers, name_));
}

}  // namespace manzana
