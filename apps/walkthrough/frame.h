#pragma once
/// One frame: camera, time -> cull -> cars -> draw.
///   Stage stage(scene, plants, quality, {1280, 720});
///   FrameRow row = draw_frame(stage, view_of(scene.frame, pose, aspect), seconds);
///   stage.renderer.present(0);
#include <optional>
#include <span>

#include "apps/walkthrough/frame_log.h"
#include "foliage/time_budget.h"
#include "gl/frame_timer.h"
#include "scenegraph/draw/far_tree_maker.h"
#include "scenegraph/draw/picture_maker.h"
#include "scenegraph/draw/renderer.h"
#include "scenegraph/horizon.h"
#include "scenegraph/visible.h"

namespace manzana::walkthrough {

/// What lives from frame to frame. The scene must outlive it; a GL context must be current.
struct Stage {
  Stage(const Scene& city, std::span<const foliage::PreparedPlant> plants, const draw::Quality& quality,
        draw::Size size, std::size_t gpu_bytes = 0);
  double aspect() const { return static_cast<double>(size.width) / static_cast<double>(size.height); }
  void resize(draw::Size new_size);

  const Scene& scene;
  draw::Renderer renderer;
  VisibleSets sets;
  Horizon horizon;
  draw::Size size;
  Structure structure = Structure::bqr;
  draw::DrawOptions options;  ///< with options.frozen set, that view culls and `view` looks at it from outside
  bool wait = true;           ///< for the device at the end, so that draw_ms says all
  std::optional<draw::FarTreeMaker> far;  ///< none: far trees are drawn as near ones are
  draw::PictureMaker pictures;            ///< what buildings wear
  bool whole = false;  ///< a frame waits for the pictures, packs and groves that it asks for, so that two runs give
                       ///< equal pictures
  double tree_ms = 0;  ///< of a frame, that trees' vertices are kept to; 0: no limit
  foliage::TimeBudget time_budget;
  gl::FrameTimer timer;  ///< of the GPU; where there is none, frames are waited for and timed as a whole
};

/// From now on trees that are small are drawn as mosaics and groves. Plants and stage must stay where they are.
void make_far_trees(Stage& stage, std::span<const foliage::PreparedPlant> plants);

struct Options;
/// What the command line says of structure and trees.
void apply(const Options& options, Stage& stage);

/// What to say, once, of a frame with FrameRow::trees_missing.
constexpr const char* kTreesMissing = "no room for all trees in view: parts of some are not drawn";

/// Of a frame with FrameRow::meshes_missing.
constexpr const char* kMeshesMissing = "no room for all meshes in view: some are not drawn (--gpu-mb)";

/// The cars are where they are `seconds` after the start of the scene.
FrameRow draw_frame(Stage& stage, const culling::View& view, double seconds);

}  // namespace manzana::walkthrough
