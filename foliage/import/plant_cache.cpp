#include "foliage/import/plant_cache.h"

#include <xxhash.h>

#include <array>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "files/whole_file.h"

namespace manzana::foliage {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

struct Header {
  std::array<char, 8> magic{'M', 'A', 'N', 'Z', 'A', 'N', 'A', '\x1a'};
  std::uint32_t byte_order = 0x01020304;
  std::uint32_t format = kPlantFormat;
  std::uint64_t length = 0, checksum = 0;
};
static_assert(sizeof(Header) == 32);

/// Everything that a prepared plant holds, in the file's order: one list for writing and for reading. Does not compile
/// for a plant that has one member more.
template <class Plant, class Visit>
void each_field(Plant& plant, Visit&& visit) {
  auto& [name, height_m, crown_radius_m, leaf_image, bark_image, bark, branch_levels, branch_steps, lines, coarse_lines,
         line_levels, line_firsts, leaves, cells, shuffled, large_quads, points, large_points, point_levels, leaf_lines,
         cover_m2, leaf_area_m2, leaf_scale, visibility] = plant;
  const auto all = [&](auto&... fields) { (visit(fields), ...); };
  all(name, height_m, crown_radius_m, leaf_image.size, leaf_image.rgba, bark_image.size, bark_image.rgba);
  all(bark, branch_levels, branch_steps, lines, coarse_lines, line_levels, line_firsts);
  all(leaves, cells, shuffled, large_quads, points, large_points, point_levels, leaf_lines, cover_m2, leaf_area_m2,
      leaf_scale);
  all(visibility.side, visibility.share);
}

class Writer {
 public:
  template <class T>
  void operator()(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void operator()(const std::vector<T>& list) {
    write_list(list.data(), list.size());
  }
  void operator()(const std::string& text) { write_list(text.data(), text.size()); }

  std::string bytes;

 private:
  template <class T>
  void write_list(const T* first, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    (*this)(static_cast<std::uint32_t>(sizeof(T)));
    (*this)(static_cast<std::uint64_t>(count));
    if (count > 0) bytes.append(reinterpret_cast<const char*>(first), count * sizeof(T));
  }
};

class Reader {
 public:
  explicit Reader(std::span<const unsigned char> bytes) : bytes_(bytes) {}

  template <class T>
  void operator()(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (bytes_.size() < sizeof value) fail("is cut off");
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    list.resize(count_of(sizeof(T)));
    copy(list.data(), list.size() * sizeof(T));
  }
  void operator()(std::string& text) {
    text.resize(count_of(1));
    copy(text.data(), text.size());
  }

  void finish() const {
    if (!bytes_.empty()) fail("has bytes after its lists");
  }

 private:
  /// No more than there are bytes for.
  std::size_t count_of(std::size_t element) {
    std::uint32_t size = 0;
    std::uint64_t count = 0;
    (*this)(size);
    (*this)(count);
    if (size != element) fail("has a list of elements of another size");
    if (count > bytes_.size() / element) fail("has a list longer than the file");
    return static_cast<std::size_t>(count);
  }

  void copy(void* to, std::size_t size) {
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }

  std::span<const unsigned char> bytes_;
};

/// The lists, once the header is right.
std::span<const unsigned char> lists_of(std::span<const unsigned char> bytes) {
  Header header, ours;
  if (bytes.size() < sizeof header || std::memcmp(bytes.data(), ours.magic.data(), ours.magic.size()) != 0)
    fail("is no prepared plant");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.byte_order != ours.byte_order) fail("was written by a machine of another byte order");
  if (header.format != kPlantFormat)
    fail("has format " + std::to_string(header.format) + ", and this program reads " + std::to_string(kPlantFormat));
  const auto lists = bytes.subspan(sizeof header);
  if (lists.size() != header.length)
    fail("is damaged: " + std::to_string(lists.size()) + " bytes follow, and its header says " +
         std::to_string(header.length));
  if (XXH3_64bits(lists.data(), lists.size()) != header.checksum) fail("is damaged: its checksum does not match");
  return lists;
}

}  // namespace

std::string with_header(std::string_view lists) {
  Header header;
  header.length = lists.size();
  header.checksum = XXH3_64bits(lists.data(), lists.size());
  Writer writer;
  writer(header);
  return writer.bytes.append(lists);
}

std::string encoded(const PreparedPlant& plant) {
  Writer writer;
  each_field(plant, writer);
  return with_header(writer.bytes);
}

PreparedPlant decoded(std::span<const unsigned char> bytes) {
  PreparedPlant plant;
  Reader reader(lists_of(bytes));
  each_field(plant, reader);
  reader.finish();
  try {
    check(plant);
  } catch (const std::invalid_argument& error) {
    fail(std::string("is damaged: ") + error.what());
  }
  return plant;
}

void write_prepared(const fs::path& file, const PreparedPlant& plant) { files::write_whole(file, encoded(plant)); }

PreparedPlant read_prepared(const fs::path& file) {
  try {
    return decoded(files::read_whole(file, kMaxBytes));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace manzana::foliage
