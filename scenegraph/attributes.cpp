#include "scenegraph/attributes.h"

#include <charconv>
#include <limits>
#include <stdexcept>

namespace manzana {
namespace {

std::string_view text_at(const Attributes& table, std::uint32_t at) { return table.text.c_str() + at; }

}  // namespace

std::span<const AttributePair> AttributeRow::pairs() const {
  const std::uint32_t list = table_ == nullptr || row_ == 0 ? 0 : table_->rows[row_].list;
  if (list == 0) return {};
  const std::uint32_t first = table_->list_last[list - 1];
  return std::span(table_->pairs).subspan(first, table_->list_last[list] - first);
}

std::string_view AttributeRow::source() const {
  const std::uint32_t at = table_ == nullptr || row_ == 0 ? 0 : table_->rows[row_].source;
  return at == 0 ? std::string_view() : text_at(*table_, at);
}

std::size_t AttributeRow::size() const { return pairs().size() + (source().empty() ? 0 : 1); }

std::pair<std::string_view, std::string_view> AttributeRow::operator[](std::size_t i) const {
  if (!source().empty() && i-- == 0) return {kSourceId, source()};
  const AttributePair& pair = pairs()[i];
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
         (a.list_last.size() + a.row_of_object.size()) * sizeof(std::uint32_t) +
         a.rows.size() * sizeof(Attributes::Row);
}

AttributeWriter::AttributeWriter(bool wanted) : wanted_(wanted) {
  if (!wanted) return;
  text("");  // at 0
  table_.list_last.push_back(0);
  table_.rows.emplace_back();
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

std::uint32_t AttributeWriter::row(std::span<const Given> given, std::string_view source) {
  if (!wanted_ || (given.empty() && source.empty())) return 0;
  const Attributes::Row row{list(given), text(source)};
  const auto [at, fresh] =
      rows_.try_emplace(std::uint64_t{row.list} << 32 | row.source, static_cast<std::uint32_t>(table_.rows.size()));
  if (fresh) table_.rows.push_back(row);
  return at->second;
}

std::uint32_t AttributeWriter::list(std::span<const Given> given) {
  if (given.empty()) return 0;
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
  const auto [at, fresh] = lists_.try_emplace(std::move(key), static_cast<std::uint32_t>(table_.list_last.size()));
  if (fresh)
    table_.list_last.push_back(static_cast<std::uint32_t>(table_.pairs.size()));
  else
    table_.pairs.resize(first);
  return at->second;
}

std::uint32_t AttributeWriter::row(const AttributeRow& other) {
  std::vector<Given> given;
  for (std::size_t i = other.source().empty() ? 0 : 1; i < other.size(); ++i) given.push_back(other[i]);
  return row(given, other.source());
}

}  // namespace manzana
