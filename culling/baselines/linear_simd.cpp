#include <hwy/highway.h>

#include "culling/baselines/linear.h"
#include "culling/baselines/narrowed.h"
#include "culling/baselines/pushed_planes.h"
#include "culling/baselines/run_list.h"

namespace manzana::baselines {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::uint32_t kWide = 16;
using Tag = hn::CappedTag<float, kWide>;
constexpr Tag kTag;
constexpr std::size_t kLanes = hn::MaxLanes(kTag);
using Lanes = hn::Vec<Tag>;

/// Four cache lines of spheres.
struct alignas(64) Packet {
  std::array<float, kWide> x{}, y{}, z{}, radius{};
};

/// A plane in every lane.
struct WidePlane {
  explicit WidePlane(const PushedPlane& plane)
      : x(hn::Set(kTag, plane.normal.x)),
        y(hn::Set(kTag, plane.normal.y)),
        z(hn::Set(kTag, plane.normal.z)),
        outer(hn::Set(kTag, plane.outer)) {}
  Lanes distance(const Packet& packet, std::size_t from) const {
    const Lanes px = hn::Load(kTag, &packet.x[from]), py = hn::Load(kTag, &packet.y[from]);
    return hn::Add(hn::MulAdd(z, hn::Load(kTag, &packet.z[from]), hn::MulAdd(y, py, hn::Mul(x, px))), outer);
  }
  Lanes x, y, z, outer;
};

/// Of a frustum: five, and a sixth where it has a far plane.
struct WidePlanes {
  explicit WidePlanes(const PushedPlanes& planes)
      : a(planes.planes[0]),
        b(planes.planes[1]),
        c(planes.planes[2]),
        d(planes.planes[3]),
        e(planes.planes[4]),
        f(planes.planes[5]),
        six(planes.count == 6) {}

  /// Bit i: sphere i is not outside. A NaN keeps it in. The bits above 15 mean nothing.
  std::uint32_t seen(const Packet& packet) const {
    std::uint32_t bits = 0;
    for (std::size_t from = 0; from < kWide; from += kLanes) bits |= outside(packet, from) << from;
    return ~bits;
  }

 private:
  std::uint32_t outside(const Packet& packet, std::size_t from) const {
    const Lanes ab = hn::Min(a.distance(packet, from), b.distance(packet, from));
    const Lanes cd = hn::Min(c.distance(packet, from), d.distance(packet, from));
    Lanes least = hn::Min(hn::Min(ab, cd), e.distance(packet, from));
    if (six) least = hn::Min(least, f.distance(packet, from));
    const auto out = hn::Lt(hn::Add(least, hn::Load(kTag, &packet.radius[from])), hn::Zero(kTag));
    std::array<std::uint8_t, 8> bytes{};
    hn::StoreMaskBits(kTag, out, bytes.data());
    return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
  }

  WidePlane a, b, c, d, e, f;
  bool six;
};

/// A bit each of the next objects, when so many are left.
std::uint32_t present(std::uint32_t left) { return left < kWide ? (1U << left) - 1U : 0xFFFFU; }

class LinearSimd : public Peer {
 public:
  explicit LinearSimd(const City& city)
      : origin_(origin_of(city)), objects_(city.objects()), packets_((city.boxes.size() + kWide - 1) / kWide) {
    for (std::size_t i = 0; i < city.boxes.size(); ++i)
      put(packets_[i / kWide], i % kWide, narrow(culling::enclosing_sphere(city.boxes[i]), origin_));
  }

  void query(const culling::FrustumD& frustum, Answer& answer) override {
    const WidePlanes planes(push_out(narrow(frustum, origin_), reach_));
    answer.runs.clear();
    for (std::uint32_t first = 0; first < objects_; first += kWide)
      append_bits(answer.runs, first, planes.seen(packets_[first / kWide]) & present(objects_ - first));
  }

  std::size_t bytes() const override { return packets_.size() * sizeof(Packet); }

 private:
  void put(Packet& packet, std::size_t lane, const culling::Sphere& sphere) {
    packet.x[lane] = sphere.center.x;
    packet.y[lane] = sphere.center.y;
    packet.z[lane] = sphere.center.z;
    packet.radius[lane] = sphere.radius;
    reach_ = glm::max(reach_, glm::abs(sphere.center) + sphere.radius);
  }

  Vec3d origin_;
  std::uint32_t objects_;
  std::vector<Packet> packets_;
  Vec3 reach_{0, 0, 0};
};

}  // namespace

std::unique_ptr<Peer> make_linear_simd(const City& city) { return std::make_unique<LinearSimd>(city); }

}  // namespace manzana::baselines
