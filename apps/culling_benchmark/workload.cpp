#include "apps/culling_benchmark/workload.h"

#include <chrono>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "apps/culling_benchmark/city_file.h"
#include "culling/baselines/cases.h"

namespace manzana::culling_benchmark {
namespace {

bool built_in(const std::string& name) { return name.starts_with("builtin:"); }

Workload without_views(const std::string& name, std::uint64_t seed) {
  const baselines::Case* generated = baselines::find_case(name);
  if (generated == nullptr) return {name, read_city(name, seed), false, {}, {}};
  return {name, make_city(*generated, seed), generated->cold, {}, {}};
}

}  // namespace

bool is_generated(const std::string& name) { return baselines::find_case(name) != nullptr; }

Workload make_workload(const std::string& name, std::uint64_t seed, int frames) {
  Workload work = without_views(name, seed);
  const baselines::Case* generated = baselines::find_case(name);
  const double far_m = generated != nullptr ? generated->far_m : std::numeric_limits<double>::infinity();
  for (int frame = 0; frame < frames; ++frame) {
    work.views.push_back(flight(work.city, far_m, frames > 1 ? frame / (frames - 1.0) : 0));
    work.frusta.push_back(make_frustum(work.views.back()));
  }
  return work;
}

void look_up_case(const std::string& name) {
  if (!is_generated(name) && !built_in(name) && !std::filesystem::exists(name))
    throw std::runtime_error(name + ": no such case (see --list), nor a file");
}

std::string scene_state(const std::string& name) {
  if (is_generated(name) || built_in(name)) return "generated";
  if (!std::filesystem::exists(name)) return "missing";
  const auto changed = std::filesystem::last_write_time(name).time_since_epoch();
  return std::to_string(std::filesystem::file_size(name)) + "@" +
         std::to_string(std::chrono::duration_cast<std::chrono::seconds>(changed).count());
}

}  // namespace manzana::culling_benchmark
