#include <algorithm>
#include <stdexcept>

#include "files/whole_file.h"
#include "scenegraph/import/cityjson.h"
#include "scenegraph/import/cityjson_objects.h"
#include "scenegraph/import/json_text.h"

namespace manzana {
namespace {

using cityjson::Json;

constexpr std::uint64_t kMostBytes = 256ULL << 20;  // of one document: some 15 times that in memory
constexpr std::uint64_t kMostSequence = 2ULL << 30;

/// Lines that hold something: what, and its number from 1.
template <class Visit>
void each_line(std::string_view bytes, Visit&& visit) {
  std::size_t number = 0;
  while (!bytes.empty()) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    ++number;
    if (line.find_first_not_of(" \t\r") != std::string_view::npos) visit(line, number);
    bytes.remove_prefix(std::min(bytes.size(), line.size() + 1));
  }
}

using Folder = std::optional<std::filesystem::path>;

CityFeatures read_sequence(std::string_view bytes, const ImportOptions& options, const Progress& progress,
                           const Folder& folder) {
  std::optional<cityjson::Intake> intake;
  each_line(bytes, [&](std::string_view line, std::size_t number) {
    const std::string where = "line " + std::to_string(number);
    if (progress && number % 256 == 0)
      progress("reading", static_cast<double>(line.data() - bytes.data()) / static_cast<double>(bytes.size()));
    try {
      const Json json = parse_shallow_json(line);
      if (!intake) intake.emplace(json, options, folder);
      intake->add(json);
    } catch (const std::runtime_error& error) {
      if (!intake) throw std::runtime_error(where + " is no header of a CityJSON sequence: " + error.what());
      intake->issues().push_back({where, error.what()});
    }
  });
  if (!intake) throw std::runtime_error("the file is empty");
  return features_of(intake->take());
}

}  // namespace

CityFeatures read_cityjson_bytes(std::string_view bytes, bool sequence, const ImportOptions& options,
                                 const Progress& progress, const std::optional<std::filesystem::path>& folder) {
  if (progress) progress("reading", 0);
  if (sequence) return read_sequence(bytes, options, progress, folder);
  const Json json = parse_shallow_json(bytes);
  cityjson::Intake intake(json, options, folder);
  if (progress) progress("reading", 0.5);
  intake.add(json);
  return features_of(intake.take());
}

bool is_cityjson(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  if (name.ends_with(".city.json") || name.ends_with(".jsonl")) return true;
  if (!name.ends_with(".json")) return false;
  try {
    const auto bytes = files::read_whole(file, kMostBytes);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return text.find("\"CityJSON\"") != std::string_view::npos ||
           text.find("\"CityObjects\"") != std::string_view::npos;
  } catch (const std::runtime_error&) {
    return false;
  }
}

CityFeatures read_cityjson(const std::filesystem::path& file, const ImportOptions& options, const Progress& progress) {
  const bool sequence = file.extension() == ".jsonl";
  try {
    const auto bytes = files::read_whole(file, sequence ? kMostSequence : kMostBytes);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return read_cityjson_bytes(text, sequence, options, progress,
                               file.parent_path().empty() ? "." : file.parent_path());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace manzana
