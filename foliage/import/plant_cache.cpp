#include "foliage/import/plant_cache.h"

#include <array>
#include <stdexcept>

#include "files/mapped_file.h"
#include "files/whole_file.h"
#include "foliage/import/cache_file.h"

namespace manzana::foliage {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

constexpr CacheKind kKind{{'M', 'A', 'N', 'Z', 'A', 'N', 'A', '\x1a'}, kPlantFormat, "prepared plant"};

/// Everything that a prepared plant holds, in the file's order: one list for writing and for reading. Does not compile
/// for a plant that has one member more.
template <class Plant, class Visit>
void each_field(Plant& plant, Visit&& visit) {
  auto& [name, height_m, crown_radius_m, leaf_image, bark_image, bark, branch_levels, branch_steps, lines, coarse_lines,
         line_levels, line_firsts, leaves, cells, shuffled, large_quads, points, large_points, point_levels, cover_m2,
         leaf_area_m2, turning, leaf_scale, visibility, grove] = plant;
  const auto all = [&](auto&... fields) { (visit(fields), ...); };
  all(name, height_m, crown_radius_m, leaf_image.size, leaf_image.rgba, bark_image.size, bark_image.rgba);
  all(bark, branch_levels, branch_steps, lines, coarse_lines, line_levels, line_firsts);
  all(leaves, cells, shuffled, large_quads, points, large_points, point_levels, cover_m2, leaf_area_m2);
  all(turning, leaf_scale);
  all(visibility.side, visibility.share, grove);
}

}  // namespace

std::string with_header(std::string_view lists) { return with_header(kKind, lists); }

std::string encoded(const PreparedPlant& plant) {
  CacheWriter writer;
  each_field(plant, writer);
  return with_header(writer.bytes);
}

std::uint64_t checksum_of(const PreparedPlant& plant) {
  CacheSum sum;
  each_field(plant, sum);
  return sum.sum;
}

PreparedPlant decoded(std::span<const unsigned char> bytes) {
  PreparedPlant plant;
  CacheReader reader(lists_of(kKind, bytes));
  each_field(plant, reader);
  reader.finish();
  try {
    check(plant);
  } catch (const std::invalid_argument& error) {
    fail(std::string("is damaged: ") + error.what());
  }
  return plant;
}

void write_prepared(const fs::path& file, const PreparedPlant& plant) { files::write_whole(file, encoded(plant)); }

PreparedPlant read_prepared(const fs::path& file) {
  try {
    const files::MappedFile mapped(file);
    return decoded({reinterpret_cast<const unsigned char*>(mapped.bytes().data()), mapped.bytes().size()});
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

}  // namespace manzana::foliage
