#pragma once
/// The rows of a run on disk, so that an interrupted run goes on: each row is there as soon as it is kept.
///   Record<Row> record(out / "runs.csv", columns, [&](const Row& row) { return same_run(row, facts); });
///   if (record.find(is_it) == nullptr) record.keep(measure());
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <utility>

#include "apps/common/csv.h"
#include "files/whole_file.h"

namespace manzana::apps {

template <class Row>
class Record {
 public:
  /// What the file holds; without rows that are not `usable` any more, which is told on stderr.
  Record(std::filesystem::path file, std::span<const Column<Row>> columns,
         const std::function<bool(const Row&)>& usable)
      : file_(std::move(file)), columns_(columns), rows_(rows_in<Row>(file_, columns)) {
    const std::size_t dropped = std::erase_if(rows_, [&](const Row& row) { return !usable(row); });
    if (dropped > 0)
      std::fprintf(stderr, "%s: %zu rows of another commit, machine, seed or mode are measured anew\n", file_.c_str(),
                   dropped);
  }

  const std::vector<Row>& rows() const { return rows_; }
  /// The file anew, where it holds anything else, or else a line more. Throws std::runtime_error.
  void keep(Row row) {
    rows_.push_back(std::move(row));
    if (std::exchange(holds_rows_, false))
      append();
    else
      files::write_whole(file_, to_csv<Row>(rows_, columns_));
    holds_rows_ = true;
  }
  /// The file keeps them until the next row is kept.
  template <class F>
  void drop(F&& is_it) {
    if (std::erase_if(rows_, is_it) > 0) holds_rows_ = false;
  }
  template <class F>
  const Row* find(F&& is_it) const {
    const auto at = std::find_if(rows_.begin(), rows_.end(), is_it);
    return at == rows_.end() ? nullptr : &*at;
  }

 private:
  void append() {
    std::ofstream out(file_, std::ios::binary | std::ios::app);
    out << to_line(rows_.back(), columns_) << std::flush;
    if (!out) throw std::runtime_error(file_.string() + ": cannot be written");
  }

  std::filesystem::path file_;
  std::span<const Column<Row>> columns_;
  std::vector<Row> rows_;
  bool holds_rows_ = false;  ///< the file, just these
};

}  // namespace manzana::apps
