#include "apps/culling_benchmark/trade.h"

#include <algorithm>
#include <array>

#include "apps/culling_benchmark/slabs.h"
#include "culling/baselines/run_list.h"

namespace manzana::culling_benchmark {
namespace {

using baselines::Answer;
using baselines::City;
using baselines::Grain;
using baselines::Peer;
using baselines::PeerInfo;
using culling::BoxD;
using culling::SphereD;

Brick<float> brick_of(const culling::Box& box) { return {box.min, box.max}; }
Ball<float> ball_of(const culling::Sphere& sphere) { return {sphere.center, sphere.radius}; }

/// How volumes are kept, and what a query makes of them. `origin` is what floats are relative to.
struct World {
  using Real = float;
  explicit World(const City&) {}
  Brick<float> keep(const BoxD& box) const { return brick_of(narrow(box, origin)); }
  Ball<float> keep(const SphereD& sphere) const { return ball_of(narrow(sphere, origin)); }
  template <class Shape>
  static const Shape& ask(const Shape& kept, const Vec3d&) {
    return kept;
  }
  Vec3d origin_for(const Vec3d&) const { return origin; }
  Vec3d origin{0, 0, 0};
};

struct Local : World {
  explicit Local(const City& city) : World(city) { origin = glm::round(culling::center(city.bounds)); }
};

struct Relative {
  using Real = float;
  explicit Relative(const City&) {}
  static const BoxD& keep(const BoxD& box) { return box; }
  static const SphereD& keep(const SphereD& sphere) { return sphere; }
  static Brick<float> ask(const BoxD& box, const Vec3d& eye) { return brick_of(narrow(box, eye)); }
  static Ball<float> ask(const SphereD& sphere, const Vec3d& eye) { return ball_of(narrow(sphere, eye)); }
  static Vec3d origin_for(const Vec3d& eye) { return eye; }
};

struct Double : Relative {
  using Real = double;
  using Relative::Relative;
  static Brick<double> ask(const BoxD& box, const Vec3d& eye) { return {box.min - eye, box.max - eye}; }
  static Ball<double> ask(const SphereD& sphere, const Vec3d& eye) { return {sphere.center - eye, sphere.radius}; }
};

enum class Volume : std::uint8_t { sphere, box, both, exact };

template <class Precision, Volume kVolume>
class Variant : public Peer {
 public:
  explicit Variant(const City& city) : precision_(city) {
    for (const BoxD& box : city.boxes) {
      if constexpr (kVolume != Volume::sphere) boxes_.push_back(precision_.keep(box));
      if constexpr (kHasBalls) balls_.push_back(precision_.keep(culling::enclosing_sphere(box)));
    }
  }

  void query(const culling::FrustumD& frustum, Answer& answer) override {
    const auto slabs = kVolume == Volume::exact ? all_slabs(frustum) : face_slabs(frustum);
    const Slabs narrowed = narrow_slabs<Real>(slabs, frustum.eye, precision_.origin_for(frustum.eye));
    answer.runs.clear();
    const auto n = static_cast<std::uint32_t>(std::max(balls_.size(), boxes_.size()));
    for (std::uint32_t i = 0; i < n; ++i)
      if (!outside(narrowed, frustum.eye, i)) baselines::append(answer.runs, i, i + 1);
  }

  std::size_t bytes() const override { return balls_.size() * sizeof(KeptBall) + boxes_.size() * sizeof(KeptBox); }

 private:
  using Real = typename Precision::Real;
  using Slabs = std::vector<Slab<Real>>;
  using KeptBall = std::decay_t<decltype(std::declval<Precision>().keep(SphereD{}))>;
  using KeptBox = std::decay_t<decltype(std::declval<Precision>().keep(BoxD{}))>;
  static constexpr bool kHasBalls = kVolume == Volume::sphere || kVolume == Volume::both;

  bool outside(const Slabs& slabs, const Vec3d& eye, std::uint32_t i) const {
    if constexpr (kHasBalls)
      if (apart(slabs, precision_.ask(balls_[i], eye))) return true;
    if constexpr (kVolume != Volume::sphere) return apart(slabs, precision_.ask(boxes_[i], eye));
    return false;
  }

  Precision precision_;
  std::vector<KeptBall> balls_;
  std::vector<KeptBox> boxes_;
};

template <class Precision, Volume kVolume>
std::unique_ptr<Peer> make(const City& city) {
  return std::make_unique<Variant<Precision, kVolume>>(city);
}

template <class Precision>
constexpr std::array<PeerInfo, 4> variants(std::string_view sphere, std::string_view box, std::string_view both,
                                           std::string_view exact, std::string_view what) {
  return {PeerInfo{sphere, what, Grain::object, true, make<Precision, Volume::sphere>},
          PeerInfo{box, what, Grain::object, true, make<Precision, Volume::box>},
          PeerInfo{both, what, Grain::object, true, make<Precision, Volume::both>},
          PeerInfo{exact, what, Grain::object, true, make<Precision, Volume::exact>}};
}

std::vector<PeerInfo> make_peers() {
  std::vector<PeerInfo> all;
  for (const auto& four :
       {variants<World>("sphere-world", "box-world", "both-world", "exact-world", "float about L's origin"),
        variants<Local>("sphere-local", "box-local", "both-local", "exact-local", "float about the city's middle"),
        variants<Relative>("sphere-relative", "box-relative", "both-relative", "exact-relative",
                           "double, less the eye, then float"),
        variants<Double>("sphere-double", "box-double", "both-double", "exact-double", "double")})
    all.insert(all.end(), four.begin(), four.end());
  return all;
}

}  // namespace

std::span<const PeerInfo> trade_peers() {
  static const std::vector<PeerInfo> peers = make_peers();
  return peers;
}

std::span<const TradePlace> trade_places() {
  static const std::vector<TradePlace> places{
      {"trade-origin", "10 000 objects at the origin", {0, 0, 0}},
      {"trade-utm", "10 000 objects 676 km east and 4 613 km north of the origin", {676'000, 4'613'000, 0}},
      {"trade-ecef", "10 000 objects at earth-centred coordinates", {4'777'000, -73'500, 4'229'000}}};
  return places;
}

const TradePlace* find_trade_place(const std::string& name) {
  const auto places = trade_places();
  const auto found = std::find_if(places.begin(), places.end(), [&](const TradePlace& p) { return p.name == name; });
  return found == places.end() ? nullptr : &*found;
}

}  // namespace manzana::culling_benchmark
