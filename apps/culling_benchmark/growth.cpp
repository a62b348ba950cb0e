#include "apps/culling_benchmark/growth.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "culling/baselines/cases.h"

namespace manzana::culling_benchmark {
namespace {

constexpr std::array<std::string_view, 5> kPeers{"bqr", "bqr-paper", "linear-simd", "bvh8", "vam16"};

struct Size {
  const char *name, *words;
  std::uint32_t objects;
};
constexpr std::array kSizes{Size{"1k", "1 000", 1'000}, Size{"10k", "10 000", 10'000}, Size{"100k", "100 000", 100'000},
                            Size{"1M", "1 000 000", 1'000'000}, Size{"10M", "10 000 000", 10'000'000}};

std::vector<Growth> make_cases() {
  std::vector<Growth> all;
  for (const Size& size : kSizes) {
    const std::string name = std::string("grow-") + size.name, what = std::string(size.words) + " objects, ";
    all.push_back({name + "-all", what + "all in view", size.objects, true, false, 1});
    all.push_back({name + "-1km", what + "seen to 1 km", size.objects, false, false, 1});
    all.push_back({name + "-1km-cold", what + "seen to 1 km, cold caches", size.objects, false, true, 1});
    all.push_back({name + "-1km-2t", what + "seen to 1 km, two threads at once", size.objects, false, false, 2});
  }
  return all;
}

const std::vector<Growth>& all_cases() {
  static const std::vector<Growth> cases = make_cases();
  return cases;
}

}  // namespace

std::span<const Growth> growth_cases() { return all_cases(); }

const Growth* find_growth(const std::string& name) {
  const auto& all = all_cases();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Growth& g) { return g.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::span<const std::string_view> growth_peers() { return kPeers; }

bool fits_memory(const Growth& growth) {
  constexpr double kBytes = 600;  // an object: its row in the city, bits of truth, two structures while they are built
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  return growth.objects * kBytes < memory / 2;
}

std::vector<culling::View> growth_views(const Growth& growth, const baselines::City& city, int frames) {
  std::vector<culling::View> views;
  const Vec3d middle = culling::center(city.bounds);
  const double away = 1.5 * glm::length(city.bounds.max - city.bounds.min);  // a ball of a third of it fills 39 degrees
  for (int frame = 0; frame < frames; ++frame) {
    const double angle = 2 * std::numbers::pi * frame / frames;
    const Vec3d from{std::cos(angle), std::sin(angle), 0.6};
    views.push_back(growth.all_in_view
                        ? culling::look(middle + away * from, -from, Vec3d(0, 0, 1), std::numbers::pi / 3, 16.0 / 9.0)
                        : flight(city, 1000, frames > 1 ? frame / (frames - 1.0) : 0));
  }
  return views;
}

}  // namespace manzana::culling_benchmark
