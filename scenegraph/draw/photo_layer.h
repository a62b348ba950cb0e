#pragma once
/// The ground's photo on the GPU: of its finer levels a window each about the eye, the rest as a whole. What is held
/// depends on the picture's size and the limit, not on the photo's.  [Tanner, Migdal, Jones, The Clipmap: A Virtual
/// Mipmap, SIGGRAPH 1998]
///   PhotoLayerGpu layer(scene.photo, plan_photo(scene.photo, focal_px, most_bytes));
///   left = layer.bring(scene.photo, camera, ground_z, bytes_of_this_frame);
///   layer.bind();                                             // for programs with photo_pieces(true)
#include <array>
#include <string_view>
#include <vector>

#include "gl/handle.h"
#include "scenegraph/draw/camera.h"
#include "scenegraph/draw/photo_window.h"
#include "scenegraph/ground_photo.h"

namespace manzana::draw {

namespace glsl {
using vec4 = glm::vec4;
#include "scenegraph/draw/shaders/photo_layout.glsl"
}  // namespace glsl

/// What defines photographed() for a fragment shader.
using PhotoPieces = std::array<std::string_view, 2>;
PhotoPieces photo_pieces(bool photo);

/// Levels [first, first + windows) are windows of that side.
struct PhotoPlan {
  std::size_t first = 0;
  int side = 0;
  std::size_t windows = 0;
  bool operator==(const PhotoPlan&) const = default;
};
/// `focal_px`: pixels of a metre at a distance of a metre: windows twice as wide hold all squares that are as large as
/// a pixel. `most_bytes` of windows; 0: no limit.
PhotoPlan plan_photo(const GroundPhoto& photo, double focal_px, std::size_t most_bytes);

class PhotoLayerGpu {
 public:
  PhotoLayerGpu(const GroundPhoto& photo, const PhotoPlan& plan);
  const PhotoPlan& plan() const { return plan_; }
  /// Coarse levels before fine ones, about so many bytes at most. Returns how many are left. `ground_z`: of the ground
  /// below the eye, in L.
  std::size_t bring(const GroundPhoto& photo, const Camera& camera, double ground_z, std::size_t most_bytes);
  glsl::PhotoData data(const GroundPhoto& photo, const Vec3d& eye) const;
  void bind() const;  ///< its pictures
  std::size_t device_bytes() const;

 private:
  std::size_t bring_window(const GroundPhoto& photo, std::size_t window, const Vec2d& focus, std::size_t& allowed);
  void upload_rest(const GroundPhoto& photo);

  PhotoPlan plan_;
  std::vector<Squares> held_;  ///< of each window
  gl::Texture array_, rest_;
};

}  // namespace manzana::draw
