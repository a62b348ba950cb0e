#include "apps/common/markdown.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace manzana::apps {
namespace {

std::string line_of(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) {
    line += ' ';
    line += cell;
    line += " |";
  }
  return line + "\n";
}

/// By the first cell below the head.
bool holds_words(std::span<const std::vector<std::string>> rows, std::size_t column) {
  if (rows.size() < 2 || column >= rows[1].size() || rows[1][column].empty()) return false;
  const char first = rows[1][column].front();
  return (first >= 'A' && first <= 'Z') || (first >= 'a' && first <= 'z');
}

}  // namespace

std::string md_table(std::span<const std::vector<std::string>> rows) {
  std::string text = line_of(rows.front()) + "|";
  for (std::size_t i = 0; i < rows.front().size(); ++i) text += i == 0 || holds_words(rows, i) ? "---|" : "--:|";
  text += "\n";
  for (const auto& row : rows.subspan(1)) text += line_of(row);
  return text + "\n";
}

std::string digits3(double value) {
  if (value == 0 || !std::isfinite(value)) return value == 0 ? "0" : "-";
  const int whole = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;  // digits before the point
  const double unit = std::pow(10.0, whole - 3);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", std::clamp(3 - whole, 0, 9), std::round(value / unit) * unit);
  return text.data();
}

std::string grouped(double value) {
  std::array<char, 64> digits{};
  std::snprintf(digits.data(), digits.size(), "%.0f", value);
  std::string text = digits.data();
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), 1, ' ');
  return text;
}

}  // namespace manzana::apps
