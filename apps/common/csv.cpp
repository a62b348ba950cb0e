#include "apps/common/csv.h"

#include <array>
#include <charconv>

namespace manzana::apps {
namespace {

template <class Number>
bool parse_number(const std::string& text, Number& value) {
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  return read.ec == std::errc() && read.ptr == end;
}

}  // namespace

std::string to_cell(const std::string& text) {
  std::string cell;
  bool quote = false;
  for (const char c : text) {
    quote = quote || c == ',' || c == '"';
    cell += c == '"' ? "\"\"" : std::string(1, static_cast<unsigned char>(c) < 32 ? ' ' : c);
  }
  return quote ? '"' + cell + '"' : cell;
}

std::string to_cell(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 6);
  return {digits.data(), end.ptr};
}

std::string to_cell(std::uint64_t value) { return std::to_string(value); }

bool from_cell(const std::string& text, std::string& value) {
  value = text;
  return true;
}
bool from_cell(const std::string& text, double& value) { return parse_number(text, value); }
bool from_cell(const std::string& text, std::uint64_t& value) { return parse_number(text, value); }

std::vector<std::string> split_cells(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool doubled = quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"';
    if (doubled)
      cells.back() += line[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else if (c != '\n')
      cells.back() += c;
  }
  return cells;
}

}  // namespace manzana::apps
