#pragma once
/// A real city for the benchmark: the objects of all layers of an imported file, in its own blocks.
///   baselines::City city = read_city("helsinki.osm.pbf", seed);
#include <string>

#include "culling/baselines/city.h"

namespace manzana {
struct Scene;
}

namespace manzana::culling_benchmark {

/// `name` as import_city has it. Blocks enclose their objects and their half-streets; surfaces (streets, greens, water)
/// count as ground. Trees have all their triangles. Throws std::runtime_error ("FILE: what") for a file that
/// cannot be read or holds no object.
baselines::City read_city(const std::string& name, std::uint64_t seed);

/// Cars, which move, are not in it.
baselines::City city_of(const Scene& scene, std::uint64_t seed);

}  // namespace manzana::culling_benchmark
