#include "culling/baselines/bvh8.h"

#include <hwy/highway.h>

#include "culling/baselines/bvh8_build.h"
#include "culling/baselines/narrowed.h"
#include "culling/baselines/pushed_planes.h"
#include "culling/baselines/run_list.h"

namespace manzana::baselines {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 8>;
using Lanes = hn::Vec<Tag>;
constexpr Tag kTag;
constexpr hn::RebindToSigned<Tag> kBits;
constexpr std::size_t kLanes = hn::MaxLanes(kTag);

/// Signed distances of eight corners, `offset` from the plane.
Lanes distance(const Boxes8& boxes, const Vec3& normal, const CornerPlaces& corner, std::size_t from, float offset) {
  const auto at = [&](std::size_t axis) { return hn::Load(kTag, &boxes.columns[corner[axis]][from]); };
  const Lanes x = hn::Mul(hn::Set(kTag, normal.x), at(0));
  const Lanes xyz = hn::MulAdd(hn::Set(kTag, normal.z), at(2), hn::MulAdd(hn::Set(kTag, normal.y), at(1), x));
  return hn::Add(xyz, hn::Set(kTag, offset));
}

/// Lives for one query.
class Visit {
 public:
  Visit(const Tree8& tree, const PushedPlanes& planes, std::vector<culling::ObjectRun>& runs)
      : tree_(tree), runs_(runs), planes_(planes.planes) {}

  /// What of a node's objects is not outside. Bits of `planes`: the node may reach beyond.
  void node(const Node8& at, unsigned planes) {
    alignas(32) std::array<std::int32_t, 8> crossed{};
    std::uint32_t seen = at.children & ask(at.bounds, planes, crossed);
    for (; seen != 0; seen &= seen - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(seen));
      const auto beyond = static_cast<unsigned>(crossed[i]);
      if (beyond == 0)
        append(runs_, at.first[i], at.first[i + 1]);
      else if (at.lowest)
        packet(at.first[i], at.first[i + 1], beyond);
      else
        node(tree_.nodes[at.below + i], beyond);
    }
  }

 private:
  void packet(std::uint32_t first, std::uint32_t last, unsigned planes) {
    const std::uint32_t present = (1U << (last - first)) - 1U;
    append_bits(runs_, first, present & ask(tree_.packets[first / 8], planes));
  }

  /// Bit i: box i is not outside. A NaN keeps it in.
  std::uint32_t ask(const Boxes8& boxes, unsigned planes) const {
    std::uint32_t outside = 0;
    for (std::size_t from = 0; from < 8; from += kLanes) {
      Lanes least = hn::Zero(kTag);
      for (unsigned left = planes; left != 0; left &= left - 1) {
        const PushedPlane& p = planes_[static_cast<std::size_t>(std::countr_zero(left))];
        least = hn::Min(least, distance(boxes, p.normal, p.best, from, p.outer));
      }
      outside |= bits(hn::Lt(least, hn::Zero(kTag))) << from;
    }
    return ~outside;
  }

  /// And for each box, the planes that it may reach beyond.
  std::uint32_t ask(const Boxes8& boxes, unsigned planes, std::array<std::int32_t, 8>& crossed) const {
    std::uint32_t outside = 0;
    for (std::size_t from = 0; from < 8; from += kLanes) {
      Lanes least = hn::Zero(kTag);
      auto beyond = hn::Zero(kBits);
      for (unsigned left = planes; left != 0; left &= left - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(left));
        const PushedPlane& p = planes_[k];
        least = hn::Min(least, distance(boxes, p.normal, p.best, from, p.outer));
        const auto crosses = hn::Le(distance(boxes, p.normal, p.worst, from, p.inner), hn::Zero(kTag));
        const auto bit = hn::Set(kBits, static_cast<std::int32_t>(1U << k));
        beyond = hn::Or(beyond, hn::IfThenElseZero(hn::RebindMask(kBits, crosses), bit));
      }
      hn::Store(beyond, kBits, &crossed[from]);
      outside |= bits(hn::Lt(least, hn::Zero(kTag))) << from;
    }
    return ~outside;
  }

  static std::uint32_t bits(hn::Mask<Tag> mask) {
    std::array<std::uint8_t, 8> bytes{};
    hn::StoreMaskBits(kTag, mask, bytes.data());
    return bytes[0];
  }

  const Tree8& tree_;
  std::vector<culling::ObjectRun>& runs_;
  std::array<PushedPlane, 6> planes_;
};

class Bvh8 : public Peer {
 public:
  explicit Bvh8(const City& city) : Bvh8(narrowed(city)) {}

  void query(const culling::FrustumD& frustum, Answer& answer) override {
    const PushedPlanes planes = push_out(narrow(frustum, origin_), reach_);
    answer.runs.clear();
    Visit(tree_, planes, answer.runs).node(tree_.nodes[0], (1U << planes.count) - 1U);
  }

  std::span<const std::uint32_t> order() const override { return tree_.order; }

  std::size_t bytes() const override {
    return tree_.nodes.size() * sizeof(Node8) + tree_.packets.size() * sizeof(Boxes8);
  }

 private:
  explicit Bvh8(const Narrowed& city)
      : origin_(city.origin), tree_(build_tree8(city.boxes)), reach_(reach_of(city.boxes)) {}

  Vec3d origin_;
  Tree8 tree_;
  Vec3 reach_;
};

}  // namespace

std::unique_ptr<Peer> make_bvh8(const City& city) { return std::make_unique<Bvh8>(city); }

}  // namespace manzana::baselines
