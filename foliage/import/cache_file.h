#pragma once
/// Files of lists that a program keeps for itself: magic, byte order, format, length and checksum (XXH3, 64 bits) of
/// what follows; then every list with the size of its elements and their count. Nothing is allocated on a file's word.
///   CacheWriter writer;
///   writer(plant.name), writer(plant.bark);
///   files::write_whole(file, with_header(kKind, writer.bytes));
///   CacheReader reader(lists_of(kKind, bytes));
///   reader(plant.name), reader(plant.bark);
///   reader.finish();
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace manzana::foliage {

struct CacheKind {
  std::array<char, 8> magic;
  std::uint32_t format;
  const char* name;  ///< as messages have it
};

std::string with_header(const CacheKind& kind, std::string_view lists);
/// The lists, once the header is right. Throws std::runtime_error ("is damaged: ...").
std::span<const unsigned char> lists_of(const CacheKind& kind, std::span<const unsigned char> bytes);

/// Where something of that description is kept, named after the stem and the description's hash.
std::filesystem::path cache_path(const std::filesystem::path& folder, const std::string& stem,
                                 std::string_view description, const char* extension);
std::uint64_t checksum_of(std::string_view bytes, std::uint64_t seed = 0);

[[noreturn]] void cache_file_error(const std::string& what);  ///< throws std::runtime_error

class CacheWriter {
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

/// What tells one thing's lists from another's, without writing them.
class CacheSum {
 public:
  template <class T>
  void operator()(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(&value, sizeof value);
  }
  template <class T>
  void operator()(const std::vector<T>& list) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(list.data(), list.size() * sizeof(T));
  }
  void operator()(const std::string& text) { add(text.data(), text.size()); }

  std::uint64_t sum = 0;

 private:
  void add(const void* first, std::size_t bytes) { sum = checksum_of({static_cast<const char*>(first), bytes}, sum); }
};

class CacheReader {
 public:
  explicit CacheReader(std::span<const unsigned char> bytes) : bytes_(bytes) {}

  template <class T>
  void operator()(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (bytes_.size() < sizeof value) cache_file_error("is cut off");
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
    if (!bytes_.empty()) cache_file_error("has bytes after its lists");
  }

 private:
  /// No more than there are bytes for.
  std::size_t count_of(std::size_t element) {
    std::uint32_t size = 0;
    std::uint64_t count = 0;
    (*this)(size);
    (*this)(count);
    if (size != element) cache_file_error("has a list of elements of another size");
    if (count > bytes_.size() / element) cache_file_error("has a list longer than the file");
    return static_cast<std::size_t>(count);
  }

  void copy(void* to, std::size_t size) {
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }

  std::span<const unsigned char> bytes_;
};

}  // namespace manzana::foliage
