#pragma once
/// A baked city whose bytes were changed, with checksums that fit again: as if somebody had meant it.
#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <string>

namespace baked {

inline constexpr std::size_t kHeader = 40, kSection = 32;

template <class T>
T at(const std::string& bytes, std::size_t place) {
  T value;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}
template <class T>
void put(std::string& bytes, std::size_t place, T value) {
  std::memcpy(bytes.data() + place, &value, sizeof value);
}

inline std::size_t sections(const std::string& bytes) {
  const auto told = bytes.size() < kHeader ? 0 : at<std::uint32_t>(bytes, 24);
  return std::min<std::size_t>(told, bytes.size() < kHeader ? 0 : (bytes.size() - kHeader) / kSection);
}
struct Place {
  std::size_t offset, bytes;
};
/// Of section i; nothing where its table says nonsense.
inline Place section(const std::string& bytes, std::size_t i) {
  const std::size_t row = kHeader + i * kSection;
  const auto size = at<std::uint32_t>(bytes, row + 4);
  const auto offset = at<std::uint64_t>(bytes, row + 8), items = at<std::uint64_t>(bytes, row + 16);
  if (offset > bytes.size() || size == 0 || items > (bytes.size() - offset) / size) return {0, 0};
  return {offset, items * size};
}

inline void resum(std::string& bytes) {
  const std::size_t n = sections(bytes);
  if (bytes.size() < kHeader) return;
  for (std::size_t i = 0; i < n; ++i) {
    const Place place = section(bytes, i);
    put<std::uint64_t>(bytes, kHeader + i * kSection + 24, XXH3_64bits(bytes.data() + place.offset, place.bytes));
  }
  put<std::uint64_t>(bytes, 16, bytes.size());
  put<std::uint64_t>(bytes, 32, 0);
  put<std::uint64_t>(bytes, 32, XXH3_64bits(bytes.data(), kHeader + n * kSection));
}

}  // namespace baked
