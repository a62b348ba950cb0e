#include "scenegraph/import/baked_city.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <stdexcept>

#include "files/mapped_file.h"
#include "files/whole_file.h"
#include "scenegraph/import/baked_check.h"
#include "scenegraph/import/picture_square.h"

namespace manzana {
namespace {

constexpr std::array<char, 8> kMagic{'M', 'A', 'N', 'Z', 'A', 'N', 'A', '\n'};
constexpr std::size_t kAligned = 64;  // as nodes and packets are
constexpr std::uint32_t kByteOrder = 0x01020304;

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kBakedVersion, byte_order = kByteOrder;
  std::uint64_t bytes = 0;  ///< of the file
  std::uint32_t sections = 0, unused = 0;
  std::uint64_t checksum = 0;  ///< of the header with 0 here, and of the table of sections
};
static_assert(sizeof(Header) == 40);

/// A column.
struct Section {
  std::uint32_t id = 0, item_bytes = 0;
  std::uint64_t offset = 0, items = 0, checksum = 0;
};
static_assert(sizeof(Section) == 32);

/// What is no column.
struct Single {
  GeoPoint anchor;
  Vec3d origin;
  double reach = 0;
  culling::BoxD bounds;
  std::uint64_t root = 0, blocks = 0, fallback_blocks = 0, objects = 0, fallback_objects = 0, objects_median = 0,
                objects_largest = 0, leeway_of = 0;
};
static_assert(sizeof(Single) == 21 * 8);

/// All columns, by numbers that stay.
template <class AnyScene, class Visit>
void each_column(AnyScene& scene, Visit&& visit) {
  auto& tree = scene.tree;
  visit(2, tree.nodes), visit(3, tree.packets), visit(4, tree.classes), visit(5, tree.block_objects);
  visit(6, tree.place), visit(7, tree.order), visit(8, tree.object_order), visit(9, scene.blocks);
  std::uint32_t id = 10;
  for (auto* layer : {&scene.buildings, &scene.surfaces}) {
    visit(id++, layer->table.row_first), visit(id++, layer->table.boxes), visit(id++, layer->index_first);
    visit(id++, layer->mesh.vertices), visit(id++, layer->mesh.indices);
  }
  visit(20, scene.trees.table.row_first), visit(21, scene.trees.table.boxes), visit(22, scene.trees.instances);
  auto& traffic = scene.traffic;
  visit(23, traffic.halves), visit(24, traffic.points), visit(25, traffic.pieces), visit(26, traffic.circuits);
  visit(27, traffic.offsets), visit(28, traffic.block_first), visit(29, traffic.block_halves);
  auto& said = scene.attributes;
  visit(30, said.text), visit(31, said.pairs), visit(32, said.list_last), visit(33, said.row_of_object);
  visit(34, scene.attribution), visit(35, scene.trees.leeway);
  id = 36;
  for (auto& level : scene.buildings.levels)  // surfaces have none
    visit(id++, level.index_first), visit(id++, level.mesh.vertices), visit(id++, level.mesh.indices);
  visit(id++, said.rows);
  visit(id++, scene.buildings.mesh.textures), visit(id++, scene.pictures.textures);  // surfaces wear none
  for (auto& level : scene.buildings.levels) visit(id++, level.mesh.textures);
}

/// A picture's bytes end there, and begin where those of the one before it end.
struct PictureRow {
  std::uint64_t last = 0;
  std::uint32_t width = 0, height = 0;
  PicturePart worn;
};
constexpr std::uint32_t kPictureRows = 60, kPictureBytes = 61;

std::uint64_t checksum_of(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

std::string_view bytes_of(const auto& items) {
  return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(*items.data())};
}

std::uint64_t checksum_of(const auto& column) { return checksum_of(bytes_of(column)); }
/// Without holding all of it at once.
template <class Item>
std::uint64_t checksum_of(const Column<Item>& column) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_64bits_reset(state.get());
  for_each_part(column, [&](auto part) { XXH3_64bits_update(state.get(), part.data(), part.size_bytes()); });
  return XXH3_64bits_digest(state.get());
}

/// Rows with nothing by chance between their members.
template <class Row>
std::vector<Row> zeroed(std::size_t n) {
  std::vector<Row> rows(n);
  if (n > 0) std::memset(static_cast<void*>(rows.data()), 0, n * sizeof(Row));
  return rows;
}
const auto& tidy(const auto& column) { return column; }
std::vector<TreeInstance> tidy(const std::vector<TreeInstance>& trees) {
  std::vector<TreeInstance> out = zeroed<TreeInstance>(trees.size());
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const TreeInstance& t = trees[i];
    TreeInstance& o = out[i];
    o.position = t.position, o.height_m = t.height_m, o.crown_radius_m = t.crown_radius_m, o.yaw = t.yaw;
    o.block = t.block, o.plant = t.plant, o.tint = t.tint;
  }
  return out;
}
std::vector<Circuit> tidy(const std::vector<Circuit>& circuits) {
  std::vector<Circuit> out = zeroed<Circuit>(circuits.size());
  for (std::size_t i = 0; i < circuits.size(); ++i) {
    const Circuit& c = circuits[i];
    Circuit& o = out[i];
    o.first_half = c.first_half, o.last_half = c.last_half, o.first_car = c.first_car, o.last_car = c.last_car;
    o.step = c.step, o.step_fraction = c.step_fraction, o.period_s = c.period_s;
  }
  return out;
}

class Writer {
 public:
  template <class Column>
  void add(std::uint32_t id, const Column& column) {
    const auto& items = tidy(column);
    text_.resize((text_.size() + kAligned - 1) / kAligned * kAligned);
    const std::string_view bytes = bytes_of(items);
    table_.push_back({id, sizeof(*items.data()), text_.size(), items.size(), checksum_of(bytes)});
    text_ += bytes;
  }

  std::string run() {
    const std::size_t before = (sizeof(Header) + table_.size() * sizeof(Section) + kAligned - 1) / kAligned * kAligned;
    for (Section& section : table_) section.offset += before;
    Header header;
    header.bytes = before + text_.size();
    header.sections = static_cast<std::uint32_t>(table_.size());
    header.checksum = checksum_of(std::string(bytes_of(std::span(&header, 1))) + std::string(bytes_of(table_)));
    std::string out(bytes_of(std::span(&header, 1)));
    out += bytes_of(table_);
    out.resize(before);
    return out += text_;
  }

 private:
  std::vector<Section> table_;
  std::string text_;
};

Single single_of(const Imported& city) {
  const Scene& s = city.scene;
  const ImportReport& r = city.report;
  return {s.frame.anchor(),  s.tree.origin, s.tree.reach,       s.bounds,         s.tree.root,       r.blocks,
          r.fallback_blocks, r.objects,     r.fallback_objects, r.objects_median, r.objects_largest, s.trees.leeway_of};
}

void add_pictures(Writer& writer, const Pictures& pictures) {
  std::vector<PictureRow> rows;
  std::vector<unsigned char> all;
  for (const EncodedPicture& picture : pictures.encoded) {
    std::ranges::copy(bytes_of(picture), std::back_inserter(all));
    rows.push_back({all.size(), picture.width, picture.height, picture.worn});
  }
  writer.add(kPictureRows, rows), writer.add(kPictureBytes, all);
}

class Reader {
 public:
  /// `file`: what keeps the bytes, if they are a mapped file's.
  Reader(std::span<const std::byte> bytes, std::shared_ptr<const void> file) : bytes_(bytes), file_(std::move(file)) {
    Header header;
    need(bytes.size() >= sizeof header, "is no baked city");
    std::memcpy(&header, bytes.data(), sizeof header);
    need(header.magic == kMagic, "is no baked city");
    need(header.byte_order == kByteOrder, "was baked on a machine of another byte order; bake it again");
    if (header.version != kBakedVersion)
      throw std::runtime_error("is of version " + std::to_string(header.version) + ", this program reads version " +
                               std::to_string(kBakedVersion) + "; bake it again");
    need(header.bytes == bytes.size(), "is damaged: it has not the length that it says");
    need(header.sections <= 1000 && sizeof header + header.sections * sizeof(Section) <= bytes.size(),
         "is damaged: its table of columns");
    const std::uint64_t told = std::exchange(header.checksum, 0);
    table_.resize(header.sections);
    if (!table_.empty()) std::memcpy(table_.data(), bytes.data() + sizeof header, table_.size() * sizeof(Section));
    need(told == checksum_of(std::string(bytes_of(std::span(&header, 1))) + std::string(bytes_of(table_))),
         "is damaged: its table of columns");
  }

  template <class Column>
  void take(std::uint32_t id, Column& column) const {
    using Item = typename Column::value_type;
    static_assert(std::is_trivially_copyable_v<Item>);
    const auto found = std::ranges::find(table_, id, &Section::id);
    need(found != table_.end(), "is damaged: a column is missing");
    need(found->item_bytes == sizeof(Item), "is damaged: a column has items of another size");
    need(found->offset % kAligned == 0 && found->offset <= bytes_.size() &&
             found->items <= (bytes_.size() - found->offset) / sizeof(Item),
         "is damaged: a column reaches beyond its end");
    const std::byte* at = bytes_.data() + found->offset;
    const std::span<const Item> items(reinterpret_cast<const Item*>(at), found->items);
    fill(column, items);
    if (checksum_of(column) != found->checksum)
      throw std::runtime_error("is damaged: column " + std::to_string(id) + " is not what was written");
    check_raw<Item>(bytes_of(items));
  }

 private:
  void fill(auto& column, const auto& items) const { column.assign(items.begin(), items.end()); }
  /// What is large and looked at in parts stays in the file.
  template <class Item>
  void fill(Column<Item>& column, const std::span<const Item>& items) const {
    file_ ? void(column = Column<Item>(items, file_)) : column.own().assign(items.begin(), items.end());
  }
  static void need(bool holds, const char* what) {
    if (!holds) throw std::runtime_error(what);
  }
  /// A byte that is neither false nor true must not be read as a bool.
  template <class Item>
  static void check_raw(std::string_view content) {
    if constexpr (std::is_same_v<Item, culling::BqrNode>)
      for (std::size_t at = offsetof(culling::BqrNode, ordered); at < content.size(); at += sizeof(Item))
        need(content[at] == 0 || content[at] == 1, "is damaged: a node's lanes");
  }

  std::span<const std::byte> bytes_;
  std::shared_ptr<const void> file_;
  std::vector<Section> table_;
};

void take_pictures(const Reader& reader, const std::shared_ptr<const void>& file, Pictures& pictures) {
  std::vector<PictureRow> rows;
  Column<std::byte> bytes;
  reader.take(kPictureRows, rows), reader.take(kPictureBytes, bytes);
  std::uint64_t first = 0;
  for (const PictureRow& row : rows) {
    if (row.last < first || row.last > bytes.size()) throw std::runtime_error("is damaged: a picture");
    const auto own = bytes.items().subspan(first, row.last - first);
    EncodedPicture& picture = pictures.encoded.emplace_back();
    picture.width = row.width, picture.height = row.height, picture.worn = row.worn;
    if (file)
      picture.bytes = Column<std::byte>(own, file);
    else
      picture.bytes.own().assign(own.begin(), own.end());
    first = row.last;
  }
}

Imported imported_from(std::span<const std::byte> bytes, const std::shared_ptr<const void>& file) {
  const auto start = std::chrono::steady_clock::now();
  const Reader reader(bytes, file);
  std::vector<Single> singles;
  reader.take(1, singles);
  if (singles.size() != 1) throw std::runtime_error("is damaged: its first column");
  const Single& s = singles[0];
  if (!valid(s.anchor) || !std::isfinite(s.anchor.height_m)) throw std::runtime_error("is damaged: its place");
  Imported city;
  city.scene.frame = LocalFrame(s.anchor);
  city.scene.tree.origin = s.origin;
  city.scene.tree.reach = s.reach;
  city.scene.tree.root = static_cast<std::uint32_t>(s.root);
  city.scene.bounds = s.bounds;
  city.scene.trees.leeway_of = s.leeway_of;
  each_column(city.scene, [&](std::uint32_t id, auto& column) { reader.take(id, column); });
  take_pictures(reader, file, city.scene.pictures);
  check_scene(city.scene);
  city.report = {s.blocks, s.fallback_blocks, s.objects, s.fallback_objects, s.objects_median, s.objects_largest, 0};
  city.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return city;
}

}  // namespace

bool is_baked(const std::filesystem::path& file) { return file.extension() == ".manzana"; }

std::string baked_bytes(const Imported& city) {
  for (const TreeInstance& tree : city.scene.trees.instances)
    if (tree.plant >= kPlantSpecies) throw std::runtime_error("plants of an ecosystem cannot be baked with a city");
  Writer writer;
  writer.add(1, std::array{single_of(city)});
  each_column(city.scene, [&](std::uint32_t id, const auto& column) { writer.add(id, column); });
  add_pictures(writer, city.scene.pictures);
  return writer.run();
}

void write_baked(const std::filesystem::path& file, const Imported& city) {
  files::write_whole(file, baked_bytes(city));
}

Imported read_baked_bytes(std::span<const std::byte> bytes, const std::string& name) {
  try {
    return imported_from(bytes, {});
  } catch (const std::exception& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
}

Imported read_baked(const std::filesystem::path& file) {
  try {
    const auto mapped = std::make_shared<const files::MappedFile>(file);
    Imported city = imported_from(mapped->bytes(), mapped);
    mapped->let_go();
    return city;
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace manzana
