#include "apps/culling_benchmark/workload.h"

#include "apps/culling_benchmark/growth.h"
#include "culling/baselines/cases.h"

namespace manzana::culling_benchmark {
namespace {

std::vector<culling::View> views_of(const std::string& name, const baselines::City& city, int frames) {
  if (const Growth* growth = find_growth(name)) return growth_views(*growth, city, frames);
  const baselines::Case* speed = baselines::find_case(name);
  const double far_m = speed != nullptr ? speed->far_m : std::numeric_limits<double>::infinity();
  std::vector<culling::View> views;
  for (int frame = 0; frame < frames; ++frame)
    views.push_back(flight(city, far_m, frames > 1 ? frame / (frames - 1.0) : 0));
  return views;
}

}  // namespace

Workload make_workload(const std::string& name, std::uint64_t seed, int frames, Cities& cities) {
  Workload work{case_info(name), cities.get(name, seed), {}, {}};
  work.views = views_of(name, *work.city, frames);
  for (const culling::View& view : work.views) work.frusta.push_back(make_frustum(view));
  return work;
}

}  // namespace manzana::culling_benchmark
