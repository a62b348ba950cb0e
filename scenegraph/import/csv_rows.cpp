#include "scenegraph/import/csv_rows.h"

#include <algorithm>

namespace manzana {

CsvRows::CsvRows(std::string_view text) : rest_(text) {
  if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
  const std::string_view first = rest_.substr(0, rest_.find('\n'));
  for (const char c : {';', '\t'})
    if (std::ranges::count(first, c) > std::ranges::count(first, separator_)) separator_ = c;
  next(header_);
}

std::optional<std::string_view> CsvRows::line() {
  while (!rest_.empty()) {
    std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(rest_.size(), line.size() + 1));
    ++number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!line.empty()) return line;
  }
  return {};
}

bool CsvRows::next(CsvRow& row) {
  const auto text = line();
  if (!text) return false;
  split(*text, row);
  row.line = number_;
  return true;
}

void CsvRows::split(std::string_view line, CsvRow& row) const {
  row.fields.assign(1, {});
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool doubled = quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"';
    if (doubled)
      row.fields.back() += line[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (c == separator_ && !quoted)
      row.fields.emplace_back();
    else
      row.fields.back() += c;
  }
  row.open_quote = quoted;
}

std::optional<std::size_t> CsvRows::column(std::string_view name) const {
  const auto found = std::ranges::find(header_.fields, name);
  return found == header_.fields.end() ? std::nullopt : std::optional<std::size_t>(found - header_.fields.begin());
}

}  // namespace manzana
