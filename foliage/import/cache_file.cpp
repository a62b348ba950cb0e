#include "foliage/import/cache_file.h"

#include <xxhash.h>

#include <stdexcept>

namespace manzana::foliage {
namespace {

struct Header {
  std::array<char, 8> magic;
  std::uint32_t byte_order = 0x01020304;
  std::uint32_t format;
  std::uint64_t length = 0, checksum = 0;
};
static_assert(sizeof(Header) == 32);

Header header_of(const CacheKind& kind) { return {.magic = kind.magic, .format = kind.format}; }

std::string hexadecimal(std::uint64_t value) {
  std::string text(16, '0');
  for (std::size_t i = 0; i < 16; ++i) text[15 - i] = "0123456789abcdef"[value >> (4 * i) & 15];
  return text;
}

}  // namespace

void cache_file_error(const std::string& what) { throw std::runtime_error(what); }

std::uint64_t checksum_of(std::string_view bytes, std::uint64_t seed) {
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

std::string with_header(const CacheKind& kind, std::string_view lists) {
  Header header = header_of(kind);
  header.length = lists.size();
  header.checksum = checksum_of(lists);
  CacheWriter writer;
  writer(header);
  return writer.bytes.append(lists);
}

std::span<const unsigned char> lists_of(const CacheKind& kind, std::span<const unsigned char> bytes) {
  Header header;
  const Header ours = header_of(kind);
  if (bytes.size() < sizeof header || std::memcmp(bytes.data(), ours.magic.data(), ours.magic.size()) != 0)
    cache_file_error(std::string("is no ") + kind.name);
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.byte_order != ours.byte_order) cache_file_error("was written by a machine of another byte order");
  if (header.format != kind.format)
    cache_file_error("has format " + std::to_string(header.format) + ", and this program reads " +
                     std::to_string(kind.format));
  const auto lists = bytes.subspan(sizeof header);
  if (lists.size() != header.length)
    cache_file_error("is damaged: " + std::to_string(lists.size()) + " bytes follow, and its header says " +
                     std::to_string(header.length));
  if (XXH3_64bits(lists.data(), lists.size()) != header.checksum)
    cache_file_error("is damaged: its checksum does not match");
  return lists;
}

std::filesystem::path cache_path(const std::filesystem::path& folder, const std::string& stem,
                                 std::string_view description, const char* extension) {
  std::string name = stem.substr(0, 40);
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 33 || c == 127) c = '_';
  return folder / (name + "-" + hexadecimal(checksum_of(description)) + extension);
}

}  // namespace manzana::foliage
