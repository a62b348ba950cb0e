#pragma once
/// Tables of text: a header, then rows. Separated by commas, semicolons or tabs, whichever the header has most of;
/// fields may be quoted, with quotes doubled inside.  [RFC 4180, but that no field goes on beyond its line]
///   CsvRows rows(text);
///   for (CsvRow row; rows.next(row);) ... row.fields[rows.column("height")] ...
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace manzana {

struct CsvRow {
  std::size_t line = 0;  ///< from 1
  std::vector<std::string> fields;
  bool open_quote = false;  ///< the line ends within one
};

class CsvRows {
 public:
  /// Refers to the text. A byte order mark before it is passed over.
  explicit CsvRows(std::string_view text);
  const std::vector<std::string>& header() const { return header_.fields; }
  /// Of a name of the header.
  std::optional<std::size_t> column(std::string_view name) const;
  /// False at the end. Empty lines are passed over.
  bool next(CsvRow& row);

 private:
  std::optional<std::string_view> line();
  void split(std::string_view line, CsvRow& row) const;
  std::string_view rest_;
  std::size_t number_ = 0;
  char separator_ = ',';
  CsvRow header_;
};

}  // namespace manzana
