#pragma once
/// A model on its way to the device, or there, and what each camera of a view sees of it. No GL.
///   see(resident, resident.eyes[i], camera, sight);
#include "manzana/view.h"
#include "scenegraph/draw/picture_maker.h"
#include "scenegraph/horizon.h"

namespace manzana {

/// What one camera sees.
struct Eye {
  HostCamera host;
  draw::Camera camera;
  std::unique_ptr<VisibleSets> sets;
  std::vector<SeenNode> nodes;
  bool hides = false;  ///< what stands behind buildings is not in the sets
};

struct Resident {
  std::shared_ptr<const Model> model;
  std::shared_ptr<const Nodes> nodes;
  std::unique_ptr<draw::Renderer> renderer;
  std::unique_ptr<draw::FarTreeMaker> far;       ///< once it is shown; outlasts the renderer
  std::unique_ptr<draw::PictureMaker> pictures;  ///< likewise
  std::unique_ptr<Horizon> horizon;              ///< once it is seen
  std::vector<Eye> eyes;
  std::size_t left = 0;  ///< bytes to upload of what its eyes see
  bool shown = false;    ///< else on its way
};

/// What is looked for.
struct Sight {
  culling::ClassMask classes = culling::kAllClasses;
  bool buildings = true;  ///< are drawn, and so hide what stands behind them
  double seconds = 0;
};

bool hides(const Eye& eye, const Sight& sight);
void see(Resident& resident, Eye& eye, const HostCamera& camera, const Sight& sight);
void see(Resident& resident, std::span<const HostCamera> cameras, const Sight& sight);
Update::Seen count_seen(const Resident& resident, const Eye& eye);

/// Of a resident that is shown.
std::unique_ptr<draw::FarTreeMaker> make_far_trees(const Resident& resident, const Host& host);
std::unique_ptr<draw::PictureMaker> make_pictures(const Resident& resident, const Host& host);

}  // namespace manzana
