#pragma once
/// A case ready to be measured: a city, and the camera's flight through it.
///   Cities cities;
///   const Workload work = make_workload("100k", seed, 300, cities);
#include "apps/culling_benchmark/catalogue.h"
#include "culling/frustum.h"

namespace manzana::culling_benchmark {

struct Workload {
  CaseInfo info;
  std::shared_ptr<const baselines::City> city;
  std::vector<culling::View> views;  ///< the frames
  std::vector<culling::FrustumD> frusta;
};

/// Throws as Cities::get does.
Workload make_workload(const std::string& name, std::uint64_t seed, int frames, Cities& cities);

}  // namespace manzana::culling_benchmark
