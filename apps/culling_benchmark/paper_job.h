#pragma once
/// A job made ready: its city, the structures over it, their geometry. One frame of one lane at a time.
///   ReadyJob ready(job, options, stage);
///   FrameCost cost = ready.frame(lane, i);
#include <memory>

#include "apps/culling_benchmark/paper.h"
#include "culling/baselines/peer.h"

namespace manzana::paper {

/// Of the flight's 300 frames at 30 a second.
inline constexpr double kFlightSeconds = 10;

class ReadyJob {
 public:
  ReadyJob(const Job& job, const PaperOptions& options, Stage& stage);
  /// Measures frame i of the flight, and leaves its picture on the stage.
  FrameCost frame(std::size_t lane, int i);
  const baselines::City& city() const { return streets_.city; }

 private:
  struct Structure {
    std::unique_ptr<baselines::Peer> peer;
    CityModel model;
    StreetFinder finder;
  };
  struct FrameView {
    culling::View view;
    culling::FrustumD frustum;
    std::uint64_t tick;
  };
  void add_structures(const Geometry& rows);
  void query(Structure& structure, Attach attach, const FrameView& at);

  Job job_;
  Stage& stage_;
  Streets streets_;
  Fleet fleet_;
  std::vector<Structure> structures_;
  std::vector<std::size_t> structure_of_;  // by lane
  std::vector<FrameView> views_;           // by frame
  baselines::Answer answer_;
  std::vector<std::uint32_t> blocks_;
  SeenCars seen_;
};

}  // namespace manzana::paper
