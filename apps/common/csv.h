#pragma once
/// Tables in files: rows are structs, and one list of columns says how a row is written, read and explained.
///   const std::array kColumns{Column<Row>{"seed", "", "of the city", &Row::seed}, ...};
///   std::string text = to_csv<Row>(rows, kColumns);
/// An empty cell is a value that was not measured. Decimal point, UTF-8, quotes as in RFC 4180.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace manzana::apps {

std::string to_cell(const std::string& text);
std::string to_cell(double value);  ///< six digits
std::string to_cell(std::uint64_t value);
template <class T>
std::string to_cell(const std::optional<T>& value) {
  return value ? to_cell(*value) : std::string();
}

/// False when the text is no such value.
bool from_cell(const std::string& text, std::string& value);
bool from_cell(const std::string& text, double& value);
bool from_cell(const std::string& text, std::uint64_t& value);
template <class T>
bool from_cell(const std::string& text, std::optional<T>& value) {
  value.reset();
  return text.empty() || from_cell(text, value.emplace());
}

/// The cells of one line, unquoted.
std::vector<std::string> split_cells(std::string_view line);

template <class Row>
struct Column {
  std::string_view name, unit, what;
  std::variant<std::string Row::*, double Row::*, std::uint64_t Row::*, std::optional<double> Row::*,
               std::optional<std::uint64_t> Row::*>
      field;
};

template <class Row>
std::string head_line(std::span<const Column<Row>> columns) {
  std::string line;
  for (const auto& column : columns) (line += line.empty() ? "" : ",") += column.name;
  return line + "\n";
}

template <class Row>
std::string to_line(const Row& row, std::span<const Column<Row>> columns) {
  std::string line;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i > 0) line += ',';
    line += std::visit([&](auto field) { return to_cell(row.*field); }, columns[i].field);
  }
  return line + "\n";
}

/// Head and rows.
template <class Row>
std::string to_csv(std::span<const Row> rows, std::span<const Column<Row>> columns) {
  std::string text = head_line(columns);
  for (const Row& row : rows) text += to_line(row, columns);
  return text;
}

/// Nothing when a cell is missing or no value of its column.
template <class Row>
std::optional<Row> from_line(std::string_view line, std::span<const Column<Row>> columns) {
  const auto cells = split_cells(line);
  if (cells.size() != columns.size()) return std::nullopt;
  Row row;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!std::visit([&](auto field) { return from_cell(cells[i], row.*field); }, columns[i].field)) return std::nullopt;
  return row;
}

/// Lines that are no rows are passed over, so that a text of another version counts as empty; so is a line without its
/// end, whose last number may be cut.
template <class Row>
std::vector<Row> rows_of(std::string_view csv, std::span<const Column<Row>> columns) {
  std::vector<Row> rows;
  for (std::size_t end = csv.find('\n'); end != csv.npos; end = csv.find('\n')) {
    if (auto row = from_line(csv.substr(0, end), columns)) rows.push_back(*std::move(row));
    csv.remove_prefix(end + 1);
  }
  return rows;
}

/// Of a file that may not be there.
template <class Row>
std::vector<Row> rows_in(const std::filesystem::path& file, std::span<const Column<Row>> columns) {
  std::ifstream in(file, std::ios::binary);
  return rows_of(std::string(std::istreambuf_iterator<char>(in), {}), columns);
}

/// A table of the columns, in Markdown.
template <class Row>
std::string explain(std::span<const Column<Row>> columns) {
  std::string text = "| column | unit | what |\n|---|---|---|\n";
  for (const auto& c : columns)
    text += "| " + std::string(c.name) + " | " + std::string(c.unit) + " | " + std::string(c.what) + " |\n";
  return text;
}

}  // namespace manzana::apps
