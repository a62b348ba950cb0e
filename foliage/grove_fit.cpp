#include "foliage/grove_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "foliage/grove_points.h"
#include "foliage/leaf_scale.h"
#include "foliage/random.h"
#include "foliage/square_picture.h"

namespace manzana::foliage {
namespace {

constexpr std::size_t kTrials = 64, kSquares = 1024;  // at least so many trees, each from another side, and points
constexpr double kSteepest = 10;                      // rise: almost from above, so that eight sides are eight pictures

float sine_of(std::size_t view) {
  return std::sin(std::numbers::pi_v<float> / 2 * static_cast<float>(view) / (kGroveViews - 1));
}

using Trials = std::vector<std::vector<Square>>;

class Fitter {
 public:
  explicit Fitter(const PreparedPlant& plant) : pixel_m_(square_pixel_m(plant)) {}

  /// Square metres, mean over the trials.
  double covered_m2(const Trials& trials, double scale) {
    return draw(trials, scale).pixels / static_cast<double>(trials.size()) * static_cast<double>(pixel_m_ * pixel_m_);
  }
  /// Of what is seen.
  double mean_light(const Trials& trials, double scale) {
    const SeenSquares seen = draw(trials, scale);
    return seen.pixels > 0 ? seen.light / seen.pixels : 0;
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

  float pixel_m_;
  SquarePicture picture_;
};

SquareSight sight_of(const PreparedPlant& plant, std::size_t view, std::size_t trial) {
  return {plant, sine_of(view), 2 * std::numbers::pi_v<float> * static_cast<float>(trial) / kTrials};
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

/// Round `n`, half an octave either way: the first 2, 4, 8 ... points are spread more evenly than any between.
std::uint32_t about(std::uint32_t n, Random random) {
  return static_cast<std::uint32_t>(std::lround(static_cast<float>(n) * std::exp2(random.spread(0.5F))));
}

/// The first points of some trees, which of each sum up to a square metre.
Trials first_points(const PreparedPlant& plant, std::size_t view, std::uint32_t n) {
  Trials trials;
  for (std::size_t t = 0; t < std::max(kTrials, kSquares / n); ++t) {
    const SquareSight sight = sight_of(plant, view, t);
    const auto rows = chosen_points(plant.grove, about(n, Random(t)), static_cast<std::uint32_t>(hash(n, t)));
    std::vector<Square>& squares = trials.emplace_back();
    for (const std::uint32_t row : rows)
      squares.push_back(
          sight.square(plant.points[row], 1 / (static_cast<float>(rows.size()) * plant.points[row].area)));
  }
  return trials;
}

double light_of(Fitter& fitter, const PreparedPlant& plant, std::span<const LeafPoint> surface, std::size_t view) {
  Trials trials;
  for (std::size_t t = 0; t < kTrials; ++t) trials.push_back(sight_of(plant, view, t).squares(surface));
  return fitter.mean_light(trials, 1);
}

}  // namespace

void add_grove(PreparedPlant& plant) {
  const std::vector<LeafPoint> surface = grove_surface(plant), points = grove_points(plant, surface);
  if (points.empty()) return;
  GroveFit& fit = plant.grove;
  fit.points.first = static_cast<std::uint32_t>(plant.points.size());
  plant.points.insert(plant.points.end(), points.begin(), points.end());
  fit.points.last = static_cast<std::uint32_t>(plant.points.size());
  Fitter fitter(plant);
  for (std::size_t view = 0; view < kGroveViews; ++view) {
    const double up = static_cast<double>(sine_of(view));
    fit.cover_m2[view] = covered_m2(plant, std::min(up / std::sqrt(1 - up * up), kSteepest));
    const double light = light_of(fitter, plant, surface, view);
    for (std::size_t i = 0; i < kGroveFits; ++i) {
      const Trials trials = first_points(plant, view, 1U << i);
      const double area = fitted_scale(fitter, trials, static_cast<double>(fit.cover_m2[view])),
                   now = fitter.mean_light(trials, area);
      fit.area[view][i] = static_cast<float>(area);
      fit.light[view][i] = static_cast<float>(now > 0 ? light / now : 1);
    }
  }
}

double fitted(const GroveFit::Table& table, double view, double points) {
  const double at = std::clamp(std::log2(points), 0.0, static_cast<double>(kGroveFits - 1));
  const auto i = std::min(static_cast<std::size_t>(at), kGroveFits - 2);
  const auto t = static_cast<float>(at - static_cast<double>(i));
  return between_views(view, [&](std::size_t v) { return std::lerp(table[v][i], table[v][i + 1], t); });
}

// An area is as large as its shadow across d: S, the stretching, makes det S |S^-1 d| of it, and S^-1 d of d.
NaturalView natural_view(const TreeSite& site, std::size_t view) {
  const double r = static_cast<double>(site.radius), h = static_cast<double>(site.height),
               up = static_cast<double>(sine_of(view)), x = std::sqrt(1 - up * up) / r, z = up / h;
  return {std::atan2(z, x) / (std::numbers::pi / 2) * (kGroveViews - 1), r * r * h * std::sqrt(x * x + z * z)};
}

// Digits of a point's place in the order are those of the halves in which it lies, so an exclusive or changes which
// come first and leaves them spread.  [Kollig, Keller 2002, scrambled nets]
std::vector<std::uint32_t> chosen_points(const GroveFit& fit, std::uint32_t n, std::uint32_t hash) {
  std::vector<std::uint32_t> rows;
  for (std::uint32_t j = 0; j < n; ++j) rows.push_back(fit.points.first + (j ^ (hash & (kPlantPoints - 1))));
  return rows;
}

}  // namespace manzana::foliage
