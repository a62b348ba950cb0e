#include "foliage/grove_fit.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

#include "foliage/leaf_scale.h"
#include "foliage/point_shade.h"
#include "foliage/random.h"
#include "foliage/raster.h"

namespace manzana::foliage {
namespace {

constexpr std::size_t kTrials = 64, kSquares = 4096;  // at least so many trees, each from another side, and points
constexpr int kGrid = 128;
constexpr double kSteepest = 10;  // rise: almost from above, so that eight sides are eight pictures

float sine_of(std::size_t view) { return static_cast<float>(view) / (kGroveViews - 1); }

/// A square as the eye sees it, in pixels of a small picture; its area in them.
struct Square {
  Vec2 middle;
  float nearness, area, light;
};

struct SeenSquares {
  double pixels = 0, light = 0;  ///< covered; sum over them of the nearest's
};

/// What a small picture shows of squares, their areas times `scale`.
class Picture {
 public:
  SeenSquares draw(std::span<const Square> squares, float scale) {
    ++picture_;
    SeenSquares seen;
    for (const Square& square : squares) {
      const float half = 0.5F * std::sqrt(square.area * scale);
      const auto pixel = [](float v) { return first_pixel(v, kGrid); };
      for (int y = pixel(square.middle.y - half); y < pixel(square.middle.y + half); ++y)
        for (int x = pixel(square.middle.x - half); x < pixel(square.middle.x + half); ++x)
          put(square, pixels_[static_cast<std::size_t>(y * kGrid + x)], seen);
    }
    return seen;
  }

 private:
  struct Pixel {
    const Square* nearest = nullptr;
    std::uint32_t picture = 0;  // of an earlier one: nothing is there
  };
  void put(const Square& square, Pixel& there, SeenSquares& seen) const {
    const bool first = there.picture != picture_;
    if (!first && there.nearest->nearness >= square.nearness) return;
    seen.pixels += first ? 1 : 0;
    seen.light += static_cast<double>(square.light - (first ? 0 : there.nearest->light));
    there = {&square, picture_};
  }

  std::array<Pixel, std::size_t{kGrid} * kGrid> pixels_{};
  std::uint32_t picture_ = 0;
};

using Trials = std::vector<std::vector<Square>>;

double luminance_of(std::uint32_t srgb) {
  const auto linear = [&](int shift) { return std::pow(static_cast<double>(srgb >> shift & 255U) / 255, 2.2); };
  return 0.2126 * linear(0) + 0.7152 * linear(8) + 0.0722 * linear(16);
}

class Fitter {
 public:
  explicit Fitter(const PreparedPlant& plant) : plant_(plant) {
    pixel_m_ = 2 * std::max(plant.height_m, 2 * plant.crown_radius_m) / kGrid;
  }

  /// Square metres, mean over the trials.
  double covered_m2(const Trials& trials, double scale) {
    return draw(trials, scale).pixels / static_cast<double>(trials.size()) * static_cast<double>(pixel_m_ * pixel_m_);
  }
  /// Of what is seen.
  double mean_light(const Trials& trials, double scale) {
    const SeenSquares seen = draw(trials, scale);
    return seen.pixels > 0 ? seen.light / seen.pixels : 0;
  }

  /// `points`: rows of the plant's. Of the picture's size, or their areas as shares of a square metre.
  std::vector<Square> seen(std::span<const std::uint32_t> points, std::size_t view, std::size_t trial,
                           float scale = 1) const {
    const float up = sine_of(view), level = std::sqrt(1 - up * up),
                a = 2 * std::numbers::pi_v<float> * static_cast<float>(trial) / kTrials;
    const Vec3 right(-std::sin(a), std::cos(a), 0), top(-up * std::cos(a), -up * std::sin(a), level),
        towards(level * std::cos(a), level * std::sin(a), up);
    const Vec3 middle(0, 0, plant_.height_m / 2);
    std::vector<Square> squares;
    for (const std::uint32_t row : points) {
      const LeafPoint& point = plant_.points[row];
      const Vec3 p = point.position - middle;
      squares.push_back({Vec2(glm::dot(p, right), glm::dot(p, top)) / pixel_m_ + 0.5F * kGrid, glm::dot(p, towards),
                         scale * point.area / (pixel_m_ * pixel_m_),
                         static_cast<float>(luminance_of(point.colour)) * arriving(point.shade)});
    }
    return squares;
  }

 private:
  SeenSquares draw(const Trials& trials, double scale) {
    SeenSquares sum;
    for (const auto& trial : trials) {
      const SeenSquares seen = picture_.draw(trial, static_cast<float>(scale));
      sum.pixels += seen.pixels, sum.light += seen.light;
    }
    return sum;
  }

  const PreparedPlant& plant_;
  float pixel_m_ = 1;
  Picture picture_;
};

/// The coarsest level that has as many.
const PointLevel& level_with(const PreparedPlant& plant, std::uint32_t points) {
  std::size_t i = plant.point_levels.size() - 1;
  while (i > 0 && plant.point_levels[i].points.size() < points) --i;
  return plant.point_levels[i];
}

double area_in(const PreparedPlant& plant, std::span<const std::uint32_t> rows) {
  double sum = 0;
  for (const std::uint32_t row : rows) sum += static_cast<double>(plant.points[row].area);
  return sum;
}

/// The scale, of points that sum up to a square metre, at which they cover so much: a plant may be a blade of grass.
double fitted_scale(Fitter& fitter, const Trials& trials, double cover_m2) {
  double low = cover_m2 / 16, high = 64 * cover_m2;
  for (int step = 0; step < 12; ++step) {
    const double middle = std::sqrt(low * high);
    (fitter.covered_m2(trials, middle) < cover_m2 ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

/// The first points of some trees, which of each sum up to a square metre.
Trials first_points(const Fitter& fitter, const PreparedPlant& plant, const GroveFit& fit, std::size_t view,
                    std::uint32_t n) {
  Trials trials;
  for (std::size_t t = 0; t < std::max(kTrials, kSquares / n); ++t) {
    const auto rows = chosen_points(fit, n, static_cast<std::uint32_t>(hash(n, t)));
    trials.push_back(fitter.seen(rows, view, t, static_cast<float>(1 / std::max(area_in(plant, rows), 1e-9))));
  }
  return trials;
}

/// As its level is drawn, which is as light as leaves are.
double light_of_all(Fitter& fitter, const GroveFit& fit, std::size_t view) {
  std::vector<std::uint32_t> rows(fit.points.size());
  std::iota(rows.begin(), rows.end(), fit.points.first);
  Trials trials;
  for (std::size_t t = 0; t < kTrials; ++t) trials.push_back(fitter.seen(rows, view, t));
  return fitter.mean_light(trials, 1);
}

}  // namespace

GroveFit fit_grove(const PreparedPlant& plant) {
  GroveFit fit;
  if (plant.points.empty()) return fit;
  fit.points = plant.point_levels.empty() ? Run{0, static_cast<std::uint32_t>(plant.points.size())}
                                          : level_with(plant, 1U << (kGroveFits - 1)).points;
  Fitter fitter(plant);
  for (std::size_t view = 0; view < kGroveViews; ++view) {
    const double up = static_cast<double>(sine_of(view));
    fit.cover_m2[view] = covered_m2(plant, std::min(up / std::sqrt(1 - up * up), kSteepest));
    const double light = light_of_all(fitter, fit, view);
    for (std::size_t i = 0; i < kGroveFits; ++i) {
      const Trials trials = first_points(fitter, plant, fit, view, 1U << i);
      const double area = fitted_scale(fitter, trials, static_cast<double>(fit.cover_m2[view])),
                   now = fitter.mean_light(trials, area);
      fit.area[view][i] = static_cast<float>(area);
      fit.light[view][i] = static_cast<float>(now > 0 ? light / now : 1);
    }
  }
  return fit;
}

double fitted(const GroveFit::Table& table, std::size_t view, double points) {
  const double at = std::clamp(std::log2(points), 0.0, static_cast<double>(kGroveFits - 1));
  const auto i = std::min(static_cast<std::size_t>(at), kGroveFits - 2);
  return std::lerp(static_cast<double>(table[view][i]), static_cast<double>(table[view][i + 1]),
                   at - static_cast<double>(i));
}

double outline_scale(const PreparedPlant& plant, const TreeSite& site, std::size_t view) {
  const double up = static_cast<double>(sine_of(view)), level = std::sqrt(1 - up * up);
  const auto outline = [&](float wide, float high) {
    const double r = static_cast<double>(plant.crown_radius_m * wide),
                 h = static_cast<double>(plant.height_m * high) / 2;
    return r * std::hypot(h * level, r * up);
  };
  return outline(site.radius, site.height) / outline(1, 1);
}

// Digits of a level's order are those of the halves in which points lie, so an exclusive or changes which come first
// and leaves them spread.  [Kollig, Keller 2002, scrambled nets]
std::vector<std::uint32_t> chosen_points(const GroveFit& fit, std::uint32_t n, std::uint32_t hash) {
  std::vector<std::uint32_t> rows;
  const std::uint32_t size = fit.points.size(), all = std::bit_ceil(size), turn = hash & (all - 1);
  for (std::uint32_t j = 0; j < all && rows.size() < n; ++j)
    if ((j ^ turn) < size) rows.push_back(fit.points.first + (j ^ turn));
  return rows;
}

}  // namespace manzana::foliage
