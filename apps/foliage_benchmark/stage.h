#pragma once
/// Draws plants without a window, as the walkthrough lights them, into pictures that can be compared.
///   Stage stage(plants, sites);
///   const Shot shot = shot_of(extent, azimuth, elevation, 128);
///   stage.set_law(foliage::Law::ours);
///   const Picture exact = stage.draw({0, 1}, shot, {.error_px = 1, .sampling = Sampling::fine});
#include <functional>
#include <optional>

#include "apps/foliage_benchmark/far_side.h"
#include "apps/foliage_benchmark/picture.h"
#include "culling/frustum.h"
#include "foliage/detail.h"
#include "foliage/gl/draw_plants.h"

namespace manzana::foliage_benchmark {

/// fine: the mean of a picture so many times the size that leaves' pictures are resolved, as references are drawn;
/// product: four samples a pixel; single: one.
enum class Sampling : std::uint8_t { fine, product, single };
inline constexpr int kProductSamples = 4;

/// A camera and its picture's size. Plants stand on the plane z = 0 of the scene.
struct Shot {
  culling::View view;
  int width = 0, height = 0;
  double focal_px = 1000;
  int fine = 4;                  ///< samples along a side of a pixel, for Sampling::fine
  Vec3d sun{0.45, -0.55, 0.70};  ///< towards it
};

/// An upright cylinder round the origin's axis that holds a plant.
struct Extent {
  double low = 0, high = 0, radius = 0, nominal_height = 0;
};
Extent extent_of(const foliage::PreparedPlant& plant);

/// From so far that the plant's height has so many pixels; the picture holds all of it, and a margin for what windows
/// reach. Angles in radians.
Shot shot_of(const Extent& extent, double azimuth, double elevation, double height_px);
/// As many as a reference needs, of plants of that height, as far as a device has room for such a picture.
int fine_samples(double height_px, int width);
/// The same picture, so much to the right.
Shot moved(const Shot& shot, double right_px);
/// A part of the picture, from `left` and `low` on, in pixels: what stands in it is drawn just as in the whole.
Shot window_of(const Shot& shot, int left, int low, int width, int height);

struct HowDrawn {
  double error_px = 1;
  Sampling sampling = Sampling::fine;
  double far_error_px = 0;  ///< of the far side, where it is another; 0: it is not
  bool heed_neighbours = true;
  FarSide* far = nullptr;   ///< small trees are its mosaics and groves; null: none are
  bool hidden_too = false;  ///< what is behind something else is drawn over it
};

/// Triangles and points.
inline std::uint64_t primitives_of(const foliage::Shown& shown) {
  return 2 * (shown.bark + shown.leaves + shown.lines) + shown.points;
}

/// Where something else than the stage's plants is drawn: its framebuffer is bound and empty, FrameData and the rows of
/// blocks are bound.
struct Canvas {
  int width = 0, height = 0, samples = 1;
  double focal_px = 1000;
};
using Paint = std::function<void(const Canvas&)>;

/// As the walkthrough lights plants; fragment shaders put out what they cover, too.
foliage::HostShaders shaders_with_mask();

class Stage {
 public:
  /// A context must be current, and stay the same. Blocks of sites are parts of the scene, in its axes. Throws as
  /// PlantStore, Extractor and PlantPrograms do.
  Stage(std::span<const foliage::PreparedPlant> plants, std::span<const foliage::TreeSite> sites,
        const foliage::ExtractLimits& limits = {});

  void set_law(foliage::Law law);
  void set_details(std::vector<foliage::Detail> details);  ///< until the next law
  /// Of the sites in the runs. With all detail, and more of it than lists have room for, in parts.
  Picture draw(std::span<const foliage::Run> runs, const Shot& shot, const HowDrawn& how);
  Picture draw(const foliage::Run& run, const Shot& shot, const HowDrawn& how) { return draw({&run, 1}, shot, how); }
  /// Only extraction and drawing, into the same kind of framebuffer, without reading it; ends with glFinish.
  void draw_only(std::span<const foliage::Run> runs, const Shot& shot, const HowDrawn& how);
  /// The same of what `paint` draws.
  Picture draw(const Paint& paint, const Shot& shot, Sampling sampling);
  void draw_only(const Paint& paint, const Shot& shot, Sampling sampling);
  /// Of the product's, hidden or not.
  std::uint64_t samples_drawn(std::span<const foliage::Run> runs, const Shot& shot, HowDrawn how);
  void extract_only(std::span<const foliage::Run> runs, const Shot& shot, const HowDrawn& how);
  /// Of the last picture.
  foliage::Shown shown();

  const foliage::PlantTable& table() const { return store_.table; }
  const std::vector<foliage::PreparedPlant>& plants() const { return plants_; }  ///< without pictures
  std::span<const foliage::TreeSite> sites() const { return sites_; }
  const foliage::glsl::Capacity& capacity() const { return extractor_.capacity; }
  std::vector<Vec4> rows_seen_from(const Vec3d& eye) const;  ///< of all blocks

 private:
  struct Room {
    int width = 0, height = 0, samples = 0;
    gl::Renderbuffer colour, mask, depth, flat_colour, flat_mask;
    gl::Framebuffer drawn, flat;
  };
  static Room make_room(int width, int height, int samples);
  Room& room_for(int width, int height, int samples);
  Room& room_for(const Shot& shot, Sampling sampling);
  void begin(const Shot& shot);
  void begin(std::span<const foliage::Run> runs, const Shot& shot, const HowDrawn& how);
  static void clear(Room& room);
  std::vector<std::uint32_t> words_of(std::span<const foliage::Run> runs, const Shot& shot, const HowDrawn& how) const;
  std::size_t part_of(std::span<const std::uint32_t> words) const;
  void extract_trees(std::span<const std::uint32_t> words);
  void extract_and_draw(Room& room, const Shot& shot, const HowDrawn& how);
  Room& draw_into_room(std::span<const foliage::Run> runs, const Shot& shot, const HowDrawn& how);
  Room& paint_into_room(const Paint& paint, const Shot& shot, Sampling sampling);
  Picture read(Room& room, int factor);

  std::vector<foliage::PreparedPlant> plants_;
  std::vector<foliage::TreeSite> sites_;
  foliage::PlantStore store_;
  foliage::Extractor extractor_;
  foliage::PlantPrograms programs_;
  gl::Buffer frame_, rows_, trees_;
  std::optional<foliage::Law> law_;
  std::size_t blocks_ = 1;
  foliage::TreesInView in_view_;
  std::vector<std::uint32_t> words_;          // of the picture at hand
  foliage::Shown shown_before_;               // of its parts but for the last
  std::vector<Room> rooms_;                   // the newest last
  std::vector<unsigned char> colour_, mask_;  // read last
};

/// The rows that select() and extract() are told, of a scene whose only block is the scene itself.
std::array<Vec4, 3> rows_seen_from(const Vec3d& eye);

}  // namespace manzana::foliage_benchmark
