#include "foliage/import/ldm_cache.h"

#include <sstream>
#include <stdexcept>

#include "files/mapped_file.h"
#include "files/whole_file.h"
#include "foliage/far_pack.h"
#include "foliage/import/plant_cache.h"

namespace manzana::foliage {
namespace {

namespace fs = std::filesystem;

/// One list for writing and for reading. Does not compile for a pack that has one member more.
template <class Pack, class Visit>
void each_field(Pack& pack, Visit&& visit) {
  auto& [options, centre, radius, height_m, grown, sides, blocks, mosaics, colour, surface] = pack;
  auto& [kind, layers, smallest, colour_delta, disparity_px, occlusion, focal_px, nearest_radii, nearest] = options;
  const auto all = [&](auto&... fields) { (visit(fields), ...); };
  all(kind, layers, smallest, colour_delta, disparity_px, occlusion, focal_px, nearest_radii, nearest);
  all(centre, radius, height_m, grown, sides, blocks, mosaics, colour, surface);
}

std::string description_of(const PreparedPlant& plant, const LdmOptions& options) {
  LdmPack none;
  none.options = options;
  std::ostringstream text;
  text << "plant " << checksum_of(plant) << " pack " << checksum_of(encoded(none));
  return text.str();
}

}  // namespace

std::string encoded(const LdmPack& pack) {
  CacheWriter writer;
  each_field(pack, writer);
  return with_header(kPackKind, writer.bytes);
}

LdmPack decoded_pack(std::span<const unsigned char> bytes) {
  LdmPack pack;
  CacheReader reader(lists_of(kPackKind, bytes));
  each_field(pack, reader);
  reader.finish();
  try {
    check(pack);
  } catch (const std::invalid_argument& error) {
    cache_file_error(std::string("is damaged: ") + error.what());
  }
  return pack;
}

void write_pack(const fs::path& file, const LdmPack& pack) { files::write_whole(file, encoded(pack)); }

LdmPack read_pack(const fs::path& file) {
  try {
    const files::MappedFile mapped(file);
    return decoded_pack({reinterpret_cast<const unsigned char*>(mapped.bytes().data()), mapped.bytes().size()});
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

LdmPack load_or_make_pack(const PreparedPlant& plant, const std::optional<fs::path>& cache_folder,
                          const LdmOptions& options, const std::function<LdmPack()>& make, const TellLine& tell) {
  if (!cache_folder) return make();
  const fs::path file = cache_path(*cache_folder, plant.name, description_of(plant, options), ".pack");
  try {
    if (fs::exists(file)) return read_pack(file);
  } catch (const std::exception& error) {
    tell(std::string(error.what()) + "; made again");
  }
  LdmPack pack = make();
  try {
    files::make_folder(*cache_folder);
    write_pack(file, pack);
  } catch (const std::exception& error) {
    tell(std::string(error.what()) + "; the pack is not kept");
  }
  return pack;
}

LdmPack load_or_make_far_pack(const PreparedPlant& plant, const std::optional<fs::path>& cache_folder,
                              const TellLine& tell) {
  return load_or_make_pack(
      plant, cache_folder, kFarPack, [&] { return make_far_pack(plant); }, tell);
}

}  // namespace manzana::foliage
