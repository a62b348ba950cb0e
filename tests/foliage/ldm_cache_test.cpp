// Packs on disk.
#include "foliage/import/ldm_cache.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/foliage/ldm_samples.h"
#include "tests/support/temporary_folder.h"

namespace manzana::foliage {
namespace {

std::span<const unsigned char> bytes_of(const std::string& text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

bool refused(const std::string& bytes) {
  try {
    decoded_pack(bytes_of(bytes));
  } catch (const std::runtime_error& error) {
    return std::string(error.what()).find('\n') == std::string::npos;
  }
  return false;
}

}  // namespace

TEST_CASE("pack cache: what is written comes back") {
  const TemporaryFolder folder;
  const LdmPack pack = pack_of_blobs({.layers = 3, .occlusion = 1});
  write_pack(folder.path() / "a.pack", pack);
  const LdmPack again = read_pack(folder.path() / "a.pack");
  CHECK(encoded(again) == encoded(pack));
  CHECK(again.options.layers == 3);
  CHECK(again.mosaics.size() == pack.mosaics.size());
  CHECK(again.colour == pack.colour);
}

TEST_CASE("pack cache: every cut and every changed byte is noticed") {
  const std::string good = encoded(pack_of_blobs());
  CHECK_FALSE(refused(good));
  for (const std::size_t size : {std::size_t{0}, std::size_t{31}, std::size_t{32}, good.size() / 2, good.size() - 1})
    CHECK(refused(good.substr(0, size)));
  CHECK(refused(good + "x"));
  support::Random random(11);
  for (int i = 0; i < 60; ++i) {
    std::string bad = good;
    const auto at = i < 32 ? static_cast<std::size_t>(i) : random.bits() % bad.size();
    bad[at] = static_cast<char>(bad[at] ^ (1 << random.below(8)));
    CHECK(refused(bad));
  }
}

TEST_CASE("pack cache: a kept pack is read and a damaged one is made again with one line") {
  const TemporaryFolder folder;
  PreparedPlant plant;
  plant.name = "a bush";
  int made = 0;
  std::vector<std::string> lines;
  const auto get = [&](const LdmOptions& options) {
    return load_or_make_pack(
        plant, folder.path(), options, [&] { return ++made, pack_of_blobs(options); },
        [&](const std::string& line) { lines.push_back(line); });
  };
  const std::string first = encoded(get({}));
  CHECK(encoded(get({})) == first);
  CHECK(made == 1);
  CHECK(lines.empty());
  get({.layers = 4});
  CHECK(made == 2);  // another pack
  plant.height_m += 1;
  get({});
  CHECK(made == 3);  // another plant
  plant.height_m -= 1;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(1000);
    file.put('!').put('?').put('!');
  }
  CHECK(encoded(get({})) == first);
  CHECK(made == 4);
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0], Catch::Contains(".pack: is damaged") && Catch::EndsWith("; made again"));
  CHECK(encoded(get({})) == first);
  CHECK(made == 4);
}

}  // namespace manzana::foliage
