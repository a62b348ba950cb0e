#include "apps/walkthrough/memory_report.h"

#include <algorithm>
#include <cstdio>

namespace manzana::walkthrough {
namespace {

template <class T>
double bytes_of(const std::vector<T>& items) {
  return static_cast<double>(items.size() * sizeof(T));
}

double bytes_of(const StoredMesh& mesh) {
  return static_cast<double>(mesh.vertices.items().size_bytes() + mesh.indices.items().size_bytes());
}

/// Those of a baked city stay in its file, and are read from there when they are first in sight.
MemoryPart meshes_on_host(const Scene& scene, double needed) {
  const double all = bytes_of(scene.buildings.mesh) + bytes_of(scene.surfaces.mesh);
  if (scene.buildings.mesh.vertices.mapped()) return {"meshes, in the file alone", all};
  return {"meshes of buildings and surfaces", all, needed};
}

double bytes_of(const foliage::PreparedPlant& plant) {
  return bytes_of(plant.bark) + bytes_of(plant.leaves) + bytes_of(plant.lines) + bytes_of(plant.points) +
         bytes_of(plant.leaf_image.rgba) + bytes_of(plant.bark_image.rgba);
}

/// Vertices from the lowest to the highest that the rows name, and the indices.
double needed_of(const MeshLayer& layer, const PathNeeds& needs) {
  double bytes = 0;
  for (std::uint32_t object = 0; object + 1 < layer.table.row_first.size(); ++object) {
    if (!needs.seen(object)) continue;
    const culling::ObjectRun rows = layer.table.rows({object, object + 1});
    const std::uint32_t first = layer.index_first[rows.first], last = layer.index_first[rows.last];
    if (first == last) continue;
    const auto [low, high] = std::minmax_element(layer.mesh.indices.begin() + first, layer.mesh.indices.begin() + last);
    bytes += static_cast<double>((*high - *low + 1) * sizeof(CityVertex) + (last - first) * sizeof(std::uint32_t));
  }
  return bytes;
}

/// The share of the plants' bytes that belongs to species in sight.
double share_of_plants(const Scene& scene, std::span<const foliage::PreparedPlant> plants, const PathNeeds& needs) {
  std::vector<bool> used(plants.size());
  for (std::uint32_t object = 0; object + 1 < scene.trees.table.row_first.size(); ++object) {
    if (!needs.seen(object)) continue;
    const culling::ObjectRun rows = scene.trees.table.rows({object, object + 1});
    for (std::uint32_t row = rows.first; row < rows.last; ++row) used[scene.trees.instances[row].plant] = true;
  }
  double all = 0, of_used = 0;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    all += bytes_of(plants[i]);
    if (used[i]) of_used += bytes_of(plants[i]);
  }
  return all > 0 ? of_used / all : 1;
}

void add_lines(const char* where, std::span<const MemoryPart> parts, std::string& text) {
  constexpr double kMega = 1e-6;
  for (const MemoryPart& part : parts) {
    char line[128];
    std::snprintf(line, sizeof line, "  %-7s %-34s %9.2f", where, part.name.c_str(), part.held * kMega);
    text += line;
    if (part.needed) std::snprintf(line, sizeof line, " %9.2f", *part.needed * kMega), text += line;
    text += '\n';
  }
}

}  // namespace

void PathNeeds::see(const VisibleSets& sets) {
  for (const culling::ObjectRun& run : sets.objects())
    std::fill(seen_.begin() + run.first, seen_.begin() + run.last, true);
}

MemoryReport report_memory(const Scene& scene, std::span<const foliage::PreparedPlant> plants, const PathNeeds& needs,
                           const draw::DeviceMemory& device) {
  const double meshes = needed_of(scene.buildings, needs) + needed_of(scene.surfaces, needs);
  const double share = share_of_plants(scene, plants, needs);
  double host_plants = 0;
  for (const foliage::PreparedPlant& plant : plants) host_plants += bytes_of(plant);
  const auto held = [](std::size_t bytes) { return static_cast<double>(bytes); };
  return {{{"meshes of buildings and surfaces", held(device.meshes), meshes},
           {"plants", held(device.plants), share * held(device.plants)},
           {"lists of trees", held(device.lists)},
           {"mosaics of far trees", held(device.packs)},
           {"groves", held(device.groves)},
           {"photo of the ground", held(device.photo)},
           {"what buildings wear", held(device.textures)},
           {"nodes of a host", held(device.nodes)},
           {"frames' streams", held(device.stream)},
           {"pictures", held(device.pictures)}},
          {meshes_on_host(scene, meshes),
           {"plants", host_plants, share * host_plants},
           {"trees", bytes_of(scene.trees.instances)},
           {"photo of the ground", held(bytes_of(scene.photo))},
           {"BqR-Tree, for queries", held(query_bytes(scene.tree))}}};
}

double over_model(std::span<const MemoryPart> parts) {
  double held = 0, needed = 0;
  for (const MemoryPart& part : parts)
    if (part.needed) held += part.held, needed += *part.needed;
  return needed > 0 ? held / needed : 1;
}

std::string to_text(const MemoryReport& report) {
  std::string text = "memory at the end, MB                         held    needed along the path\n";
  add_lines("device", report.device, text);
  add_lines("host", report.host, text);
  char line[96];
  std::snprintf(line, sizeof line, "over_model: device %.2f, host %.2f\n", over_model(report.device),
                over_model(report.host));
  return text + line;
}

}  // namespace manzana::walkthrough
