#pragma once
/// --report-memory: what each part holds, and how much of that the camera path needed.
///   PathNeeds needs(scene);
///   ...each frame: needs.see(sets);
///   MemoryReport report = report_memory(scene, plants, needs, renderer.memory());
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scenegraph/draw/renderer.h"

namespace manzana::walkthrough {

/// Which objects of the tree were in sight at any time.
class PathNeeds {
 public:
  explicit PathNeeds(const Scene& scene) : seen_(scene.tree.objects()) {}
  void see(const VisibleSets& sets);
  bool seen(std::uint32_t object) const { return seen_[object]; }

 private:
  std::vector<bool> seen_;
};

/// Bytes. Parts without `needed` are working memory, or do not grow with the city.
struct MemoryPart {
  std::string name;
  double held = 0;
  std::optional<double> needed = {};
};
struct MemoryReport {
  std::vector<MemoryPart> device, host;
};
/// Of meshes, what the objects in sight have; of plants, the species in sight, with all their levels.
MemoryReport report_memory(const Scene& scene, std::span<const foliage::PreparedPlant> plants, const PathNeeds& needs,
                           const draw::DeviceMemory& device);

/// Bytes held over bytes needed, of the parts that have both.
double over_model(std::span<const MemoryPart> parts);

std::string to_text(const MemoryReport& report);

}  // namespace manzana::walkthrough
