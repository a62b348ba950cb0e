#pragma once
/// A case ready to be measured: a city, and the camera's flight through it.
///   const Workload work = make_workload("100k", seed, 300);
#include <string>
#include <vector>

#include "culling/baselines/city.h"

namespace manzana::culling_benchmark {

struct Workload {
  std::string name;
  baselines::City city;
  bool cold = false;
  std::vector<culling::View> views;  ///< the frames of the flight
  std::vector<culling::FrustumD> frusta;
};

/// `name`: of a case, or what read_city takes. Throws std::runtime_error ("FILE: what").
Workload make_workload(const std::string& name, std::uint64_t seed, int frames);

/// Throws std::runtime_error when `name` is neither a case nor a file nor built in; cheap.
void look_up_case(const std::string& name);

bool is_generated(const std::string& name);
/// What tells one state of the scene from another: "generated", or size and time of change of the file.
std::string scene_state(const std::string& name);

}  // namespace manzana::culling_benchmark
