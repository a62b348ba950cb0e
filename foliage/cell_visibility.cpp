#include "foliage/cell_visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <tuple>

#include "foliage/octahedral.h"
#include "foliage/raster.h"

namespace manzana::foliage {
namespace {

constexpr std::uint32_t kNobody = ~0U;
constexpr int kFirstPixels = 256, kMostPixels = 2048, kMostForOne = 512;
constexpr std::size_t kFew = 16;  // one cell of so many may be looked at again for itself

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A quad as one view has it.
struct SeenQuad {
  SeenQuad(const PlantQuad& quad, const ParallelView& view) : uv(quad), form(form_of(quad, uv)) {
    for (std::size_t c = 0; c < 4; ++c) {
      at[c] = view.pixel(quad.corners[c].position);
      near[c] = view.nearness(quad.corners[c].position);
    }
    nearest = *std::max_element(near.begin(), near.end());
  }
  std::array<Vec2, 4> at;
  std::array<float, 4> near;
  float nearest;
  QuadUv uv;
  Form form;
};

/// Where a fragment is nearest or farthest, or the first of its id.
struct OpenToId {
  const float *near, *far;
  const std::uint32_t* last;
  std::uint32_t id;

  Lanes<std::int32_t> operator()(std::size_t texel, const Lanes<float>& here) const {
    return (here >= lanes_at(near + texel)) | (here <= lanes_at(far + texel)) | (lanes_at(last + texel) != id);
  }
};

/// Where it is nearer than what is there; with `also_equal`, or as near.
struct OpenToNearer {
  const float* near;
  bool also_equal;

  Lanes<std::int32_t> operator()(std::size_t texel, const Lanes<float>& here) const {
    const Lanes<float> there = lanes_at(near + texel);
    return also_equal ? here >= there : here > there;
  }
};

/// Calls void(std::size_t texel, float near) for pixels of a quad that are open and not holes.
template <class Open, class Visit>
void for_each_open(const SeenQuad& quad, int pixels, const LeafHoles* holes, const Open& open, Visit&& visit) {
  for_each_quad_span(quad.at, quad.form, pixels, [&](const PixelSpan& span, const QuadPart& part) {
    const Along depth(span, quad.near, part), u(span, quad.uv.u, part), v(span, quad.uv.v, part);
    const auto row =
        static_cast<std::size_t>(span.y) * static_cast<std::size_t>(pixels) + static_cast<std::size_t>(span.first);
    const int size = span.last - span.first;
    for (int i = 0; i < size; i += kLanes) {
      const Lanes<float> here = depth.lanes(i);
      const std::size_t first = row + static_cast<std::size_t>(i);
      const Lanes<std::int32_t> may_change = open(first, here);
      if (none(may_change)) continue;
      const Lanes<std::int32_t> texels = holes != nullptr ? holes->texels(u.lanes(i), v.lanes(i)) : may_change;
      for (int j = 0; j < std::min(size - i, kLanes); ++j)
        if (may_change[j] != 0 && (holes == nullptr || holes->opaque(texels[j])))
          visit(first + static_cast<std::size_t>(j), here[j]);
    }
  });
}

/// With room for a block past the last.
std::size_t texels_of(const ParallelView& view) {
  return static_cast<std::size_t>(view.pixels()) * static_cast<std::size_t>(view.pixels()) + kLanes;
}

/// A picture of who is nearest and who is farthest, so of what both ends of the rays see; and who came last to each
/// pixel.
class IdPicture {
 public:
  explicit IdPicture(const ParallelView& view)
      : view_(view),
        near_(texels_of(view), -kInfinity),
        far_(near_.size(), kInfinity),
        nearest_(near_.size(), 0),
        farthest_(nearest_),
        last_(near_.size(), kNobody) {}

  /// All quads of a cell; or some bark, as 0. Returns how many pixels they touch. In any order: of what is equally near
  /// the greater id is seen, as GL_LEQUAL has it of what comes later.
  std::uint32_t draw(std::span<const PlantQuad> quads, std::uint32_t id, const LeafHoles* holes) {
    std::uint32_t own = 0;
    sort_by_depth(quads);
    for (std::size_t low = 0, high = seen_.size(); low < high;) {  // both ends first: most of the others change nothing
      own += draw_quad(seen_[low++], id, holes);
      if (low < high) own += draw_quad(seen_[--high], id, holes);
    }
    return own;
  }

  std::vector<std::uint32_t> seen(std::size_t cells) const { return histogram(nearest_, cells); }
  std::vector<std::uint32_t> seen_from_behind(std::size_t cells) const { return histogram(farthest_, cells); }

 private:
  static std::vector<std::uint32_t> histogram(const std::vector<std::uint32_t>& picture, std::size_t cells) {
    std::vector<std::uint32_t> count(cells, 0);
    for (const std::uint32_t id : picture)
      if (id > 0) ++count[id - 1];
    return count;
  }

  void sort_by_depth(std::span<const PlantQuad> quads) {
    seen_.clear();
    for (const PlantQuad& quad : quads) seen_.emplace_back(quad, view_);
    std::sort(seen_.begin(), seen_.end(), [](const SeenQuad& a, const SeenQuad& b) { return a.nearest > b.nearest; });
  }

  std::uint32_t draw_quad(const SeenQuad& quad, std::uint32_t id, const LeafHoles* holes) {
    std::uint32_t fresh = 0;
    const OpenToId open{near_.data(), far_.data(), last_.data(), id};
    for_each_open(quad, view_.pixels(), holes, open, [&](std::size_t texel, float here) {
      if (here > near_[texel] || (here == near_[texel] && id > nearest_[texel]))
        near_[texel] = here, nearest_[texel] = id;
      if (here < far_[texel] || (here == far_[texel] && id > farthest_[texel]))
        far_[texel] = here, farthest_[texel] = id;
      fresh += last_[texel] != id ? 1 : 0;
      last_[texel] = id;
    });
    return fresh;
  }

  const ParallelView& view_;
  std::vector<float> near_, far_;
  std::vector<std::uint32_t> nearest_, farthest_, last_;
  std::vector<SeenQuad> seen_;
};

/// One cell in a picture, and what of it others hide. Cheaper: pixels without the cell, or hidden, are done with.
class OneCellPicture {
 public:
  explicit OneCellPicture(const ParallelView& view) : view_(view), near_(texels_of(view), -kInfinity) {}

  void draw_own(const PlantQuad& quad, const LeafHoles& holes) {
    const OpenToNearer open{near_.data(), true};
    for_each_open(SeenQuad(quad, view_), view_.pixels(), &holes, open, [&](std::size_t texel, float here) {
      pixels_ += near_[texel] == -kInfinity ? 1 : 0;
      near_[texel] = here;
      farthest_ = std::min(farthest_, here);
    });
  }

  /// Between the cell's own quads and the others'.
  void end_own() { std::replace(near_.begin(), near_.end(), -kInfinity, kInfinity); }

  /// Later cells also hide what is as near as they are.
  void hide_behind(const PlantQuad& quad, const LeafHoles* holes, bool later) {
    const SeenQuad seen(quad, view_);
    if (seen.nearest < farthest_) return;
    const OpenToNearer open{near_.data(), later};
    for_each_open(seen, view_.pixels(), holes, open, [&](std::size_t texel, float) {
      near_[texel] = kInfinity;
      --pixels_;
    });
  }

  std::uint32_t pixels() const { return pixels_; }
  float farthest() const { return farthest_; }

 private:
  const ParallelView& view_;
  std::vector<float> near_;
  float farthest_ = kInfinity;
  std::uint32_t pixels_ = 0;
};

/// Of a vertex of the grid the first one with its direction.
std::uint32_t first_of_pair(std::uint32_t side, std::uint32_t i, std::uint32_t j) {
  if (j == 0 || j == side - 1) i = std::min(i, side - 1 - i);
  if (i == 0 || i == side - 1) j = std::min(j, side - 1 - j);
  return j * side + i;
}

/// The vertex from which the other end of the rays looks; of a grid of an odd side: others have none.
std::uint32_t opposite(std::uint32_t side, std::uint32_t vertex) {
  const int n = static_cast<int>(side) - 1;
  const int x = 2 * static_cast<int>(vertex % side) - n, y = 2 * static_cast<int>(vertex / side) - n;
  const auto across = [n](int sign, int other) {
    return static_cast<std::uint32_t>((n + (sign < 0 ? 1 : -1) * (n - std::abs(other))) / 2);
  };
  return first_of_pair(side, across(x, y), across(y, x));
}

/// Side of a picture in which all but few cells have enough pixels, when they have `own` in one of kFirstPixels.
int enough_for_most(std::vector<std::uint32_t> own) {
  if (own.empty()) return kFirstPixels;
  const auto few = own.begin() + static_cast<std::ptrdiff_t>(own.size() / kFew);
  std::nth_element(own.begin(), few, own.end());
  if (*few >= kEnoughPixels) return kFirstPixels;
  const double larger = std::sqrt(1.1 * kEnoughPixels / std::max(*few, 1U));
  return static_cast<int>(std::min<double>(larger * kFirstPixels, kMostPixels));
}

/// A picture of one cell in which it has enough pixels, as far as that can be.
ParallelView near_view(const PreparedPlant& plant, std::uint32_t cell, const ParallelView& view, std::uint32_t own) {
  Vec2 low(3e38F), high(-3e38F);
  for (std::uint32_t q = plant.cells[cell].quads.first; q < plant.cells[cell].quads.last; ++q)
    for (const PlantQuad::Corner& c : plant.leaves[q].corners)
      low = glm::min(low, view.pixel(c.position)), high = glm::max(high, view.pixel(c.position));
  const float side = std::max({high.x - low.x, high.y - low.y, 1e-3F});
  const float wanted = std::sqrt(1.3F * kEnoughPixels / static_cast<float>(std::max(own, 1U)));
  const float zoom = own > 0 ? std::min(wanted, kMostForOne / side) : kMostForOne / side;
  return view.part(0.5F * (low + high), zoom, static_cast<int>(side * zoom) + 2);
}

float nearest_of(const CellPiece& piece, const ParallelView& view) {
  return view.nearness(piece.middle) + glm::dot(piece.half, glm::abs(view.towards()));
}

void fill_direction(PreparedPlant& plant, std::uint32_t vertex, std::span<const std::uint32_t> seen,
                    std::span<const std::uint32_t> own) {
  const std::uint32_t all = plant.visibility.side * plant.visibility.side;
  for (std::size_t c = 0; c < plant.cells.size(); ++c)
    plant.visibility.share[c * all + vertex] = seen_share(seen[c], own[c], plant.cells[c].quads.size() == 0);
}

/// `each`: calls a void(std::uint32_t) with [0, n), in any order, by any thread.
void bake(PreparedPlant& plant, const VisibilityOptions& options, const CountPixels& count, auto&& each) {
  if (options.side < 2 || options.side > 257)
    throw std::invalid_argument("a grid of directions has a side of 2 to 257");
  if (options.pixels < 0 || options.pixels > 8192)
    throw std::invalid_argument("a picture has at most 8192 pixels a side");
  const std::uint32_t side = options.side, all = side * side;
  plant.visibility.side = side;
  plant.visibility.share.assign(plant.cells.size() * all, 0);
  const bool both_ends = side % 2 == 1;
  std::vector<std::uint32_t> firsts;
  for (std::uint32_t vertex = 0; vertex < all; ++vertex)
    if (first_of_pair(side, vertex % side, vertex / side) == vertex && (!both_ends || vertex < opposite(side, vertex)))
      firsts.push_back(vertex);
  const int pixels = options.pixels > 0 ? options.pixels : picture_size(plant, count);
  std::mutex telling;
  std::size_t done = 0;
  const auto fill = [&](std::uint32_t vertex, const std::vector<std::uint32_t>& seen, const CellPixels& of) {
    fill_direction(plant, vertex, seen, of.own);
    const std::scoped_lock lock(telling);
    tell(options.progress, ++done, (both_ends ? 2 : 1) * firsts.size());
  };
  each(firsts.size(), [&](std::size_t i) {
    const Vec3d to_eye = grid_direction(side, firsts[i] % side, firsts[i] / side);
    const ParallelView view = view_of(plant, to_eye, pixels);
    const CellPixels counted = options.pixels > 0 ? count(view, {}) : enough_pixels(plant, view, count);
    fill(firsts[i], counted.seen, counted);
    if (both_ends) fill(opposite(side, firsts[i]), counted.seen_from_behind, counted);
  });
  for (std::size_t c = 0; c < plant.cells.size(); ++c)
    for (std::uint32_t vertex = 0; vertex < all; ++vertex)
      plant.visibility.share[c * all + vertex] =
          plant.visibility.share[c * all + first_of_pair(side, vertex % side, vertex / side)];
}

}  // namespace

std::uint8_t seen_share(std::uint32_t seen, std::uint32_t own, bool empty) {
  if (own == 0) return empty ? 0 : 255;
  if (seen == 0) return 0;
  const std::uint64_t rounded = (2 * 255 * std::uint64_t{std::min(seen, own)} + own) / (2 * std::uint64_t{own});
  return static_cast<std::uint8_t>(std::max<std::uint64_t>(rounded, 1));
}

CellCounter::CellCounter(const PreparedPlant& plant)
    : plant_(plant), pieces_(pieces_of(plant)), holes_(std::make_shared<LeafHoles>(plant.leaf_image)) {}

CellPixels CellCounter::operator()(const ParallelView& view, std::optional<std::uint32_t> only) const {
  CellPixels count;
  count.own.assign(plant_.cells.size(), 0);
  count.seen = count.seen_from_behind = count.own;
  if (!only) {
    count_all(view, count);
  } else {
    std::tie(count.own[*only], count.seen[*only]) = count_one(view, *only);
    count.seen_from_behind[*only] = count_one(view.turned(), *only).second;
  }
  return count;
}

std::span<const PlantQuad> CellCounter::quads_of(const CellPiece& piece) const {
  const std::vector<PlantQuad>& all = is_leaf(piece) ? plant_.leaves : plant_.bark;
  return std::span(all).subspan(piece.quads.first, piece.quads.size());
}

/// From both ends by turns, so that what lies between them changes little.
std::vector<const CellPiece*> ends_first(std::span<const CellPiece> pieces, const ParallelView& view) {
  std::vector<const CellPiece*> sorted, out;
  for (const CellPiece& piece : pieces) sorted.push_back(&piece);
  std::stable_sort(sorted.begin(), sorted.end(), [&](const CellPiece* a, const CellPiece* b) {
    return view.nearness(a->middle) > view.nearness(b->middle);
  });
  for (std::size_t low = 0, high = sorted.size(); low < high;) {
    out.push_back(sorted[low++]);
    if (low < high) out.push_back(sorted[--high]);
  }
  return out;
}

void CellCounter::count_all(const ParallelView& view, CellPixels& count) const {
  IdPicture picture(view);
  for (const CellPiece* piece : ends_first(pieces_, view)) {
    const std::uint32_t id = is_leaf(*piece) ? piece->cell + 1 : 0;
    const std::uint32_t own = picture.draw(quads_of(*piece), id, is_leaf(*piece) ? holes_.get() : nullptr);
    if (is_leaf(*piece)) count.own[piece->cell] = own;
  }
  count.seen = picture.seen(count.own.size());
  count.seen_from_behind = picture.seen_from_behind(count.own.size());
}

/// Those in the picture that may be nearer than `farthest`; the nearest first.
std::vector<const CellPiece*> CellCounter::in_front(const ParallelView& view, float farthest) const {
  std::vector<std::pair<float, const CellPiece*>> found;
  for (const CellPiece& piece : pieces_)
    if (const float near = nearest_of(piece, view); near >= farthest && !pixels_of(piece, view).empty())
      found.emplace_back(near, &piece);
  std::sort(found.begin(), found.end(), std::greater<>());
  std::vector<const CellPiece*> pieces;
  for (const auto& [near, piece] : found) pieces.push_back(piece);
  return pieces;
}

/// Its own pixels, and those seen.
std::pair<std::uint32_t, std::uint32_t> CellCounter::count_one(const ParallelView& view, std::uint32_t cell) const {
  OneCellPicture picture(view);
  for (std::uint32_t q = plant_.cells[cell].quads.first; q < plant_.cells[cell].quads.last; ++q)
    picture.draw_own(plant_.leaves[q], *holes_);
  picture.end_own();
  const std::uint32_t own = picture.pixels();
  for (const CellPiece* piece : in_front(view, picture.farthest())) {
    if (piece->cell == cell || picture.pixels() == 0) continue;
    for (const PlantQuad& quad : quads_of(*piece))
      picture.hide_behind(quad, is_leaf(*piece) ? holes_.get() : nullptr, is_leaf(*piece) && piece->cell > cell);
  }
  return {own, picture.pixels()};
}

int picture_size(const PreparedPlant& plant, const CountPixels& count) {
  return enough_for_most(count(view_of(plant, glm::normalize(Vec3d(2, 1, 1)), kFirstPixels), {}).own);
}

CellPixels enough_pixels(const PreparedPlant& plant, const ParallelView& view, const CountPixels& count) {
  CellPixels all = count(view, {});
  for (std::uint32_t c = 0; c < plant.cells.size(); ++c) {
    if (all.own[c] >= kEnoughPixels || plant.cells[c].quads.size() == 0) continue;
    const CellPixels nearer = count(near_view(plant, c, view, all.own[c]), c);
    if (nearer.own[c] <= all.own[c]) continue;
    all.own[c] = nearer.own[c];
    all.seen[c] = nearer.seen[c];
    all.seen_from_behind[c] = nearer.seen_from_behind[c];
  }
  return all;
}

void bake_visibility(PreparedPlant& plant, const VisibilityOptions& options) {
  bake(plant, options, CellCounter(plant),
       [](std::size_t n, auto&& one) { tbb::parallel_for(std::size_t{0}, n, one); });
}

void bake_visibility(PreparedPlant& plant, const VisibilityOptions& options, const CountPixels& count) {
  bake(plant, options, count, [](std::size_t n, auto&& one) {
    for (std::size_t i = 0; i < n; ++i) one(i);
  });
}

}  // namespace manzana::foliage
