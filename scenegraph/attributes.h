#pragma once
/// What files say of things, name by name: "species" = "Quercus robur". Rows are of pairs of texts; each text is kept
/// once, and so is each list of pairs that many things share.
///   AttributeWriter writer;                                       // while a file is read
///   tree.attributes = writer.row({{"species", "Quercus robur"}, {"height", "12"}});
///   const AttributeRow row = scene.attributes.of(object);         // in the scene
///   row.find("species");                                          // "Quercus robur"
///   row.find(kSourceId);                                          // "node/4711": by what its file knows it
/// Numbers are kept as the file writes them.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace manzana {

struct Attributes;

/// Where the texts of a name and its value begin.
struct AttributePair {
  std::uint32_t name = 0, value = 0;
  bool operator==(const AttributePair&) const = default;
};

/// The name of what a thing is known by in its file, its first pair: "way/4711", "relation/8" and "node/15" of
/// OpenStreetMap, the names of CityJSON's objects, the ids of rows in other files. No tag begins so.
inline constexpr std::string_view kSourceId = "@id";

/// Of one thing. Refers to the table.
class AttributeRow {
 public:
  AttributeRow() = default;
  AttributeRow(const Attributes& table, std::uint32_t row) : table_(&table), row_(row) {}
  std::size_t size() const;
  /// Name and value; each is followed by a zero byte.
  std::pair<std::string_view, std::string_view> operator[](std::size_t i) const;
  std::optional<std::string_view> find(std::string_view name) const;
  std::string_view source() const;  ///< of kSourceId; "" where none is known
  /// What the value begins with as a number, as in "12.5 m".
  std::optional<double> number(std::string_view name) const;

 private:
  std::span<const AttributePair> pairs() const;
  const Attributes* table_ = nullptr;
  std::uint32_t row_ = 0;
};

struct Attributes {
  using Pair = AttributePair;
  struct Row {
    std::uint32_t list = 0;    ///< of pairs
    std::uint32_t source = 0;  ///< where the text of its id begins; 0, an empty text: none is known
  };
  std::string text;  ///< each ends with a zero byte
  std::vector<Pair> pairs;
  std::vector<std::uint32_t> list_last;      ///< of pairs; a list begins where the one before it ends; list 0 has none
  std::vector<Row> rows;                     ///< row 0 has nothing
  std::vector<std::uint32_t> row_of_object;  ///< of the scene's tree; empty: none has any
  AttributeRow row(std::uint32_t i) const { return {*this, i}; }
  AttributeRow of(std::uint32_t object) const {
    return object < row_of_object.size() ? row(row_of_object[object]) : AttributeRow();
  }
};
std::size_t bytes_of(const Attributes& attributes);

class AttributeWriter {
 public:
  using Given = std::pair<std::string_view, std::string_view>;
  explicit AttributeWriter(bool wanted = false);
  /// False: all rows are row 0, and nothing is kept; readers need not look.
  bool wanted() const { return wanted_; }
  /// Of a name that comes again the first value counts. `source`: by what the file knows the thing, if it does. Throws
  /// std::length_error beyond 4 GiB of text.
  std::uint32_t row(std::span<const Given> given, std::string_view source = {});
  std::uint32_t row(std::initializer_list<Given> given, std::string_view source = {}) {
    return row(std::span(given.begin(), given.size()), source);
  }
  /// The same of another table.
  std::uint32_t row(const AttributeRow& other);
  const Attributes& table() const { return table_; }
  Attributes take() { return std::move(table_); }

 private:
  std::uint32_t text(std::string_view value);
  std::uint32_t list(std::span<const Given> given);
  bool wanted_;
  Attributes table_;
  std::unordered_map<std::string, std::uint32_t> texts_, lists_;
  std::unordered_map<std::uint64_t, std::uint32_t> rows_;  ///< by list and source
};

}  // namespace manzana
