#include "apps/culling_benchmark/paper_streets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "culling/hash.h"

namespace manzana::paper {
namespace {

using baselines::City;
using culling::BoxD;

constexpr std::size_t kSides = 4;  // of a block: west, north, east, south, each driven from its corner to the next
constexpr double kLane = 2;        // metres from the middle of the street
constexpr double kCutCorner = 4;   // metres of a side before its end where a car begins to turn
constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// Corners from the south-west, clockwise.
Vec2d corner(const BoxD& box, std::size_t i) {
  return {i % kSides < 2 ? box.min.x : box.max.x, i % kSides == 1 || i % kSides == 2 ? box.max.y : box.min.y};
}

/// Blocks by their corner at one place: at [i] the one whose corner i it is.
using Junction = std::array<std::uint32_t, kSides>;
using Place = std::pair<long long, long long>;

Place place_of(const Vec2d& at) { return {std::llround(at.x * 1000), std::llround(at.y * 1000)}; }

/// Lives for one call of make_traffic.
class StreetMaker {
 public:
  StreetMaker(const City& city, std::uint64_t seed) : city_(city), seed_(seed) {
    for (std::uint32_t b = 0; b < city.blocks.size(); ++b)
      for (std::size_t i = 0; i < kSides; ++i) {
        auto [junction, is_new] = junctions_.try_emplace(place_of(corner(city.blocks[b].box, i)));
        if (is_new) junction->second.fill(kNone);
        junction->second[i] = b;
      }
  }

  Traffic run(std::uint32_t cars) {
    std::vector<char> done(kSides * city_.blocks.size(), 0);
    for (std::size_t side = 0; side < done.size(); ++side)
      if (!done[side]) add_circuit(side, done);
    index_blocks(out_, static_cast<std::uint32_t>(city_.blocks.size()));
    place_cars(cars);
    return std::move(out_);
  }

 private:
  const BoxD& box(std::size_t side) const { return city_.blocks[side / kSides].box; }

  std::size_t next(std::size_t side) const {
    const Place end = place_of(corner(box(side), side % kSides + 1));
    const Junction& junction = junctions_.at(end);
    const bool full = std::find(junction.begin(), junction.end(), kNone) == junction.end();
    const auto id = static_cast<std::uint64_t>(end.first * 1'000'003 + end.second);
    if (full && hash_unit(seed_, id) < 0.5) return kSides * junction[side % kSides] + side % kSides;
    return side - side % kSides + (side + 1) % kSides;
  }

  static Vec3d direction(std::size_t side) {
    constexpr std::array kWays{Vec3d(0, 1, 0), Vec3d(1, 0, 0), Vec3d(0, -1, 0), Vec3d(-1, 0, 0)};
    return kWays[side % kSides];
  }
  /// Where the lane of a side begins: by the corner, in from both streets.
  Vec3d begin(std::size_t side) const {
    const Vec3d way = direction(side), right(way.y, -way.x, 0);
    return Vec3d(corner(box(side), side % kSides), box(side).min.z) + right * kLane + way * (kLane + kCutCorner);
  }
  Vec3d end(std::size_t side) const {
    const Vec3d way = direction(side), right(way.y, -way.x, 0);
    return Vec3d(corner(box(side), side % kSides + 1), box(side).min.z) + right * kLane - way * (kLane + kCutCorner);
  }

  void add_half(std::size_t side) {
    HalfStreet half;
    half.block = static_cast<std::uint32_t>(side / kSides);
    half.circuit = static_cast<std::uint32_t>(out_.circuits.size());
    half.first_point = static_cast<std::uint32_t>(out_.points.size());
    const Vec3d a = begin(side), b = end(side), c = begin(next(side));
    const double straight = glm::distance(a, b), all = straight + glm::distance(b, c);
    out_.points.own().insert(
        out_.points.own().end(),
        {{a, 0, direction(side)}, {b, straight, direction(side)}, {c, all, direction(next(side))}});
    half.last_point = half.first_point + 3;
    half.first_piece = static_cast<std::uint32_t>(out_.pieces.size());
    half.last_piece = half.first_piece + 1;
    out_.pieces.push_back({0, 0, static_cast<float>(kCarSpeed), 0});
    half.duration_s = all / kCarSpeed;
    out_.halves.push_back(half);
  }

  static std::uint64_t phase(double lap) { return static_cast<std::uint64_t>(std::ldexp(lap, 64)); }

  void add_circuit(std::size_t first, std::vector<char>& done) {
    Circuit circuit;
    circuit.first_half = static_cast<std::uint32_t>(out_.halves.size());
    for (std::size_t side = first; !done[side]; side = next(side)) {
      done[side] = 1;
      add_half(side);
      circuit.period_s += out_.halves.back().duration_s;
    }
    circuit.last_half = static_cast<std::uint32_t>(out_.halves.size());
    circuit.step = phase(1 / (circuit.period_s * kTicksPerSecond));
    double t = 0;
    for (std::uint32_t h = circuit.first_half; h < circuit.last_half; ++h) {
      out_.halves[h].phase_begin = phase(t / circuit.period_s);
      t += out_.halves[h].duration_s;
    }
    for (std::uint32_t h = circuit.first_half; h < circuit.last_half; ++h) {
      const std::uint32_t after = h + 1 < circuit.last_half ? h + 1 : circuit.first_half;
      out_.halves[h].phase_length = out_.halves[after].phase_begin - out_.halves[h].phase_begin;
    }
    out_.circuits.push_back(circuit);
  }

  /// Uniform over the length of all circuits.
  void place_cars(std::uint32_t cars) {
    double length = 0;
    for (const Circuit& circuit : out_.circuits) length += circuit.period_s;
    std::vector<double> places;
    for (std::uint32_t i = 0; i < cars; ++i) places.push_back(hash_unit(hash_bits(seed_, 1), i) * length);
    std::sort(places.begin(), places.end());
    double begin = 0;
    for (Circuit& circuit : out_.circuits) {
      circuit.first_car = out_.cars();
      for (; out_.cars() < cars && places[out_.cars()] < begin + circuit.period_s;)
        out_.offsets.push_back(phase((places[out_.cars()] - begin) / circuit.period_s));
      circuit.last_car = out_.cars();
      begin += circuit.period_s;
    }
    out_.circuits.back().last_car = out_.cars();
  }

  const City& city_;
  std::uint64_t seed_;
  std::map<Place, Junction> junctions_;
  Traffic out_;
};

BoxD streets_of(const Traffic& traffic, std::uint32_t block) {
  BoxD box;
  for (std::uint32_t i = traffic.block_first[block]; i < traffic.block_first[block + 1]; ++i)
    box = merge(box, half_street_bounds(traffic, traffic.block_halves[i]));
  return box;
}

void add_block(City& city, const City& from, std::uint32_t block, const BoxD& streets) {
  culling::BlockVolume volume = from.blocks[block];
  volume.box = merge(volume.box, streets);
  volume.sphere = culling::enclosing_sphere(volume.box);
  city.blocks.push_back(volume);
  for (std::uint32_t row = from.first[block]; row < from.first[block + 1]; ++row) {
    city.boxes.push_back(from.boxes[row]);
    city.kinds.push_back(from.kinds[row]);
    city.triangles.push_back(from.triangles[row]);
  }
  city.boxes.push_back(streets);
  city.kinds.push_back(baselines::ObjectKind::car);
  city.triangles.push_back(0);
  city.first.push_back(city.objects());
  city.bounds = merge(city.bounds, volume.box);
}

}  // namespace

Traffic make_traffic(const City& city, std::uint32_t cars, std::uint64_t seed) {
  return StreetMaker(city, seed).run(cars);
}

City with_streets(const City& city, const Traffic& traffic) {
  City wider;
  for (std::uint32_t b = 0; b < city.blocks.size(); ++b) add_block(wider, city, b, streets_of(traffic, b));
  wider.flown = city.flown.empty() ? city.bounds : city.flown;  // the flight stays as it is
  return wider;
}

}  // namespace manzana::paper
