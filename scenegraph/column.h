#pragma once
/// A column that is only read once it is there: items of its own, or a part of a mapped file, which stays mapped for as
/// long as a column of it is.
///   Column<CityVertex> made; made.own().push_back(v);
///   const Column<CityVertex> mapped(items, file);
///   ...read some...; mapped.let_go(first, last);       // their memory is the system's again; they come back when read
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace manzana {

template <class T>
class Column {
 public:
  using value_type = T;
  Column() = default;
  /// `items` lie in memory that `file` keeps, mapped for reading from a file.
  Column(std::span<const T> items, std::shared_ptr<const void> file) : mapped_(items), file_(std::move(file)) {}

  /// Of a column that is not mapped.
  std::vector<T>& own() {
    assert(!file_);
    return own_;
  }
  bool mapped() const { return file_ != nullptr; }
  std::span<const T> items() const { return file_ ? mapped_ : std::span<const T>(own_); }
  const T* data() const { return items().data(); }
  std::size_t size() const { return items().size(); }
  bool empty() const { return items().empty(); }
  auto begin() const { return items().begin(); }
  auto end() const { return items().end(); }
  const T& operator[](std::size_t i) const { return items()[i]; }
  bool operator==(const Column& other) const { return std::ranges::equal(items(), other.items()); }

  /// Whole pages of [first, last) are given back to the system; nothing where they are the column's own.
  void let_go(std::size_t first, std::size_t last) const {
    if (!mapped()) return;
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto begin = (reinterpret_cast<std::uintptr_t>(data() + first) + page - 1) / page * page,
               end = reinterpret_cast<std::uintptr_t>(data() + last) / page * page;
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);
  }

 private:
  std::vector<T> own_;
  std::span<const T> mapped_;
  std::shared_ptr<const void> file_;
};

/// visit(items) for all of a column, some megabytes at a time, each let go after.
template <class T, class Visit>
void for_each_part(const Column<T>& column, Visit&& visit) {
  constexpr std::size_t kItems = (std::size_t{4} << 20) / sizeof(T);
  for (std::size_t first = 0; first < column.size(); first += kItems) {
    const std::size_t last = std::min(column.size(), first + kItems);
    visit(column.items().subspan(first, last - first));
    column.let_go(first, last);
  }
}

}  // namespace manzana
