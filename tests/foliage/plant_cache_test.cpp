#include "foliage/import/plant_cache.h"

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "files/whole_file.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;
using namespace manzana::foliage;

namespace {

const PreparedPlant& shrub() {
  static const PreparedPlant plant = [] {
    PreparedPlant made = prepare(grow_plant(builtin_species("shrub"), 3));
    made.visibility = {2, std::vector<std::uint8_t>(4 * made.cells.size(), 77)};
    return made;
  }();
  return plant;
}

std::span<const unsigned char> bytes_of(const std::string& text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

std::string complaint(const std::string& bytes) {
  try {
    decoded(bytes_of(bytes));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("plant cache: what is read back is what was written") {
  const std::string bytes = encoded(shrub());
  const PreparedPlant again = decoded(bytes_of(bytes));
  CHECK(encoded(again) == bytes);
  CHECK(checksum_of(again) == checksum_of(shrub()));
  PreparedPlant other = again;
  other.grove.light[2][7] *= 1.001F;
  CHECK(checksum_of(other) != checksum_of(shrub()));
  CHECK(again.name == shrub().name);
  CHECK(again.leaves.size() == shrub().leaves.size());
  CHECK(std::memcmp(again.points.data(), shrub().points.data(), sizeof(LeafPoint) * again.points.size()) == 0);
  CHECK(again.visibility.share == shrub().visibility.share);
  CHECK(encoded(decoded(bytes_of(encoded(PreparedPlant{})))) == encoded(PreparedPlant{}));
}

TEST_CASE("plant cache: a file is whole, replaced whole, and named when it cannot be read") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.plant";
  write_prepared(file, PreparedPlant{});
  write_prepared(file, shrub());
  CHECK(files_in(folder.path()) == 1);
  CHECK(encoded(read_prepared(file)) == encoded(shrub()));
  CHECK_THROWS_WITH(read_prepared(folder.path() / "b.plant"), Catch::EndsWith("b.plant: no such file"));
  CHECK_THROWS_WITH(read_prepared(folder.path()), Catch::EndsWith("is no file"));
  files::write_whole(file, "oak");
  CHECK_THROWS_WITH(read_prepared(file), Catch::EndsWith("a.plant: is no prepared plant"));
}

TEST_CASE("plant cache: every cut and every changed byte is noticed") {
  const std::string good = encoded(shrub());
  for (std::size_t size :
       {std::size_t{0}, std::size_t{7}, std::size_t{31}, std::size_t{32}, good.size() / 2, good.size() - 1})
    CHECK_FALSE(complaint(good.substr(0, size)).empty());
  CHECK_THAT(complaint(good + "x"), Catch::Contains("damaged"));
  support::Random random(11);
  for (int i = 0; i < 200; ++i) {
    std::string bad = good;
    const auto at = i < 32 ? static_cast<std::size_t>(i) : random.bits() % bad.size();
    bad[at] = static_cast<char>(bad[at] ^ (1 << random.below(8)));
    CHECK_FALSE(complaint(bad).empty());
  }
}

TEST_CASE("plant cache: other formats and machines are told apart") {
  std::string bytes = encoded(PreparedPlant{});
  bytes[12] = 99;
  CHECK_THAT(complaint(bytes), Catch::StartsWith("has format 99, and this program reads "));
  bytes = encoded(PreparedPlant{});
  std::swap(bytes[8], bytes[11]);
  std::swap(bytes[9], bytes[10]);
  CHECK_THAT(complaint(bytes), Catch::Contains("another byte order"));
}

TEST_CASE("plant cache: no list is believed where the checksum holds") {
  const std::string lists = encoded(shrub()).substr(32);
  CHECK(complaint(with_header(lists)).empty());
  CHECK_FALSE(complaint(with_header("")).empty());
  CHECK_THAT(complaint(with_header(lists + "x")), Catch::Contains("bytes after its lists"));
  std::string longer = lists;
  const std::uint64_t count = std::uint64_t{1} << 62;
  std::memcpy(longer.data() + 4, &count, sizeof count);  // of the name
  CHECK_THAT(complaint(with_header(longer)), Catch::Contains("longer than the file"));
  std::string wider = lists;
  wider[0] = 9;
  CHECK_THAT(complaint(with_header(wider)), Catch::Contains("elements of another size"));
  support::Random random(5);
  for (int i = 0; i < 2000; ++i) {
    std::string bad = lists;
    const auto at = i < 1000 ? static_cast<std::size_t>(i) % 60 : random.bits() % bad.size();
    bad[at] = static_cast<char>(random.bits());
    complaint(with_header(bad));  // a plant that passes check(), or std::runtime_error
  }
}
