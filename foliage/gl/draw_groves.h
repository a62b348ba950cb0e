#pragma once
/// Groves on the GPU, and how they are drawn: a draw for each page of points, whatever the wood.
///   GroveDrawer drawer(host);
///   auto place = drawer.add(grove.points);                 // none: no room; drawer.remove(*place) makes some
///   drawer.draw(shown, focal_px, samples);                 // each frame, with the blocks' rows bound
#include <deque>
#include <optional>

#include "foliage/gl/draw_plants.h"
#include "foliage/grove.h"
#include "gl/ranges.h"

namespace manzana::foliage {

class GroveDrawer {
 public:
  /// A page of points: the room that comes at once, and the most that a grove can take.
  static constexpr std::uint32_t kPage = 1U << 16;
  static constexpr std::size_t kPageBytes = kPage * sizeof(LeafPoint);

  /// Of `host` its points.
  explicit GroveDrawer(HostShaders host);

  struct Place {
    std::uint32_t page, first, points;
  };
  /// At most so many pages from now on; those that are there stay.
  void limit(std::size_t pages) { most_pages_ = pages; }
  std::optional<Place> add(std::span<const LeafPoint> points);
  void remove(const Place& place);
  std::size_t bytes() const { return pages_.size() * kPageBytes; }

  struct Shown {
    std::uint32_t block;  ///< whose row places it
    Place place;
    GroveShown points;
    std::uint32_t share;  ///< 255ths that its trees show themselves
  };
  /// Into the bound framebuffer, with its depth; the blocks' rows are bound to kBlockRowsBinding. Returns points.
  /// Throws std::runtime_error when a shader does not compile: the first time with so many samples.
  std::uint64_t draw(std::span<const Shown> shown, float focal_px, int samples);

 private:
  struct Page {
    gl::Buffer points;
    gl::Ranges room;
  };
  std::optional<Place> take(std::uint32_t points);

  HostShaders host_;
  int samples_ = 0;  // of the program
  gl::Program program_;
  gl::VertexArray array_;
  std::deque<Page> pages_;
  std::size_t most_pages_ = 32;
  gl::StreamBuffer stream_;
  std::vector<GroveItem> items_;
  std::vector<std::vector<glm::uvec2>> groups_;  ///< a list a page: item, first rank
};

}  // namespace manzana::foliage
