#include "scenegraph/attributes.h"

#include <charconv>
#include <limits>
#include <stdexcept>

namespace manzana {
namespace {

std::string_view text_at(const Attributes& table, std::uint32_t at) { return table.text.c_str() + at; }

}  // namespace

std::size_t AttributeRow::size() const {
  return table_ == nullptr || row_ == 0 ? 0 : table_->row_last[row_] - table_->row_last[row_ - 1];
}

std::pair<std::string_view, std::string_view> AttributeRow::operator[](std::size_t i) const {
  const Attributes::Pair& pair = table_->pairs[table_->row_last[row_ - 1] + i];
  return {text_at(*table_, pair.name), text_at(*table_, pair.value)};
}

std::optional<std::string_view> AttributeRow::find(std::string_view name) const {
  for (std::size_t i = 0; i < size(); ++i)
    if ((*this)[i].first == name) return (*this)[i].second;
  return {};
}

std::optional<double> AttributeRow::number(std::string_view name) const {
  const auto value = find(name);
  double number = 0;
  if (!value || std::from_chars(value->data(), value->data() + value->size(), number).ec != std::errc()) return {};
  return number;
}

std::size_t bytes_of(const Attributes& a) {
  return a.text.size() + a.pairs.size() * sizeof(Attributes::Pair) +
         (a.row_last.size() + a.row_of_object.size()) * sizeof(std::uint32_t);
}

std::uint32_t AttributeWriter::text(std::string_view value) {
  value = value.substr(0, value.find('\0'));
  const auto [at, fresh] = texts_.try_emplace(std::string(value), static_cast<std::uint32_t>(table_.text.size()));
  if (!fresh) return at->second;
  if (table_.text.size() + value.size() >= std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("attributes of more than 4 GiB");
  table_.text += value;
  table_.text += '\0';
  return at->second;
}

std::uint32_t AttributeWriter::row(std::span<const Given> given) {
  if (!wanted_ || given.empty()) return 0;
  const std::size_t first = table_.pairs.size();
  std::string key;
  for (const auto& [name, value] : given) {
    const std::uint32_t at = text(name);
    bool known = false;
    for (std::size_t i = first; i < table_.pairs.size(); ++i) known = known || table_.pairs[i].name == at;
    if (known) continue;
    table_.pairs.push_back({at, text(value)});
    key.append(reinterpret_cast<const char*>(&table_.pairs.back()), sizeof(Attributes::Pair));
  }
  const auto [at, fresh] = rows_.try_emplace(std::move(key), static_cast<std::uint32_t>(table_.row_last.size()));
  if (fresh)
    table_.row_last.push_back(static_cast<std::uint32_t>(table_.pairs.size()));
  else
    table_.pairs.resize(first);
  return at->second;
}

std::uint32_t AttributeWriter::row(const AttributeRow& other) {
  std::vector<Given> given;
  for (std::size_t i = 0; i < other.size(); ++i) given.push_back(other[i]);
  return row(given);
}

}  // namespace manzana
