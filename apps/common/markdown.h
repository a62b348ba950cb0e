#pragma once
/// Pieces of report.md.
#include <span>
#include <string>
#include <vector>

namespace manzana::apps {

/// A table whose first row is its head. Columns of numbers stand to the right: all but the first and those of words.
std::string md_table(std::span<const std::vector<std::string>> rows);

/// Three digits that count, never with an exponent: 0.503, 12.2, 32700.
std::string digits3(double value);
/// 32 700 000
std::string grouped(double value);

}  // namespace manzana::apps
