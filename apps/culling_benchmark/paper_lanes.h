#pragma once
/// Lanes made ready: their cities, cars, structures, and the geometry of each in its order, all of it shared where it
/// is the same. One frame of one lane at a time.
///   ReadyLanes ready(lanes, options, stage);
///   FrameCost cost = ready.frame(lane, i);
#include <map>
#include <memory>

#include "apps/culling_benchmark/paper.h"
#include "culling/baselines/peer.h"

namespace manzana::paper {

inline constexpr double kFlightSeconds = 10;  ///< 300 frames at 30 a second

class ReadyLanes {
 public:
  ReadyLanes(const std::vector<Lane>& lanes, const PaperOptions& options, Stage& stage);
  /// Measures frame i of the flight, and leaves its picture on the stage.
  FrameCost frame(std::size_t lane, int i);
  /// What that frame sends.
  std::size_t stream_bytes(std::size_t lane, int i);
  std::uint64_t city_triangles(std::size_t lane) const;

 private:
  struct FrameView {
    culling::View view;
    culling::FrustumD frustum;
    std::uint64_t tick;
  };
  struct Scene {
    baselines::City city;
    Geometry rows;
    std::vector<FrameView> views;
  };
  struct Structure {
    std::unique_ptr<baselines::Peer> peer;
    std::unique_ptr<CityModel> model;
    StreetFinder finder;
  };
  struct Ready {
    Lane lane;
    const Scene* scene;
    Structure* structure;
    const Traffic* traffic;
    const Fleet* fleet;
  };

  Scene& scene_of(const Lane& lane);
  const Traffic& traffic_of(const std::string& city, std::uint32_t cars);
  const Fleet& fleet_of(std::span<const CarLevel> levels);
  Structure& structure_of(const Lane& lane);
  void query(const Ready& ready, const FrameView& at);

  PaperOptions options_;
  Stage& stage_;
  std::map<std::pair<std::string, bool>, Scene> scenes_;  // by city, and whether it has streets
  std::map<std::pair<std::string, std::uint32_t>, Traffic> traffic_;
  std::map<std::size_t, Fleet> fleets_;  // by number of levels
  std::map<std::pair<const Scene*, std::string>, Structure> structures_;
  std::vector<Ready> lanes_;
  baselines::Answer answer_;
  std::vector<std::uint32_t> blocks_;
  SeenCars seen_;
};

}  // namespace manzana::paper
