// The tests of culling/lattice.h on whole vectors; compiled once for each kind of processor (culling/cull.cpp).
#if defined(MANZANA_CULLING_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef MANZANA_CULLING_LANES_INL_H_
#undef MANZANA_CULLING_LANES_INL_H_
#else
#define MANZANA_CULLING_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <type_traits>

#include "culling/lattice.h"
#include "culling/planes.h"

HWY_BEFORE_NAMESPACE();
namespace manzana::culling::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using NodeTag = hn::CappedTag<std::uint16_t, kLanes>;
using LaneTag = hn::CappedTag<std::uint32_t, kLanes>;
using PacketTag = hn::CappedTag<std::uint16_t, kPacket>;
using PlanesTag = hn::CappedTag<double, kMaxPlanes>;

/// What is known of a node's lanes. Not initialised: a query has many, and fills those that it uses.
struct alignas(64) NodeResult {
  std::array<Lanes16, kMaxPlanes> need;  ///< t_out of the lattice of a block that crosses plane k
  Lanes16 planes;                        ///< bit k: lane i may cross plane k
  std::uint32_t alive;                   ///< not outside
  std::uint32_t inside;                  ///< alive, and certainly inside all planes
};

/// What the signs of a normal say: bit i of the index is set where n_i < 0.
struct Signs {
  std::array<std::uint16_t, 3> flip;          ///< all ones where n_i < 0: ~u instead of u
  std::array<std::uint16_t, 3> inner, outer;  ///< columns of a box: its reach inward, and outward
};
inline constexpr auto kSigns = [] {
  std::array<Signs, 8> all{};
  for (unsigned bits = 0; bits < 8; ++bits)
    for (std::uint16_t i = 0; i < 3; ++i) {
      const bool back = (bits >> i & 1) != 0;
      all[bits].flip[i] = back ? 0xFFFF : 0;
      all[bits].inner[i] = static_cast<std::uint16_t>(back ? i + 3 : i);
      all[bits].outer[i] = static_cast<std::uint16_t>(back ? i : i + 3);
    }
  return all;
}();

/// The slope of a plane.
struct alignas(64) Slope {
  std::array<std::array<std::uint16_t, kPacket>, 3> a;  ///< A_i in every lane, so that none is spread while asking
  Signs signs;
};

/// Planes as a query asks them.
struct SpreadPlanes {
  const Planes* planes;
  std::array<Slope, kMaxPlanes> slopes;  ///< filled where used
};

HWY_INLINE void spread(const Planes& planes, SpreadPlanes& to) {
  const PacketTag d;
  to.planes = &planes;
  for (unsigned which = planes.used; which != 0; which &= which - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(which));
    const std::array<double, 3> n{planes.x[k], planes.y[k], planes.z[k]};
    to.slopes[k].signs = kSigns[(n[0] < 0 ? 1U : 0U) | (n[1] < 0 ? 2U : 0U) | (n[2] < 0 ? 4U : 0U)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = hn::Set(d, lattice_factor(n[axis]));
      for (std::size_t i = 0; i < kPacket; i += hn::Lanes(d)) hn::Store(a, d, &to.slopes[k].a[axis][i]);
    }
  }
}

/// t_out and t_in of a node's lattice.
struct alignas(64) Thresholds {
  std::array<std::int32_t, kMaxPlanes> out, in;
};

template <class D>
HWY_INLINE std::uint32_t bits_where(D d, hn::Mask<D> mask) {
  constexpr std::size_t kBytes = (hn::MaxLanes(d) + 7) / 8;
  using Bits =
      std::conditional_t<kBytes == 1, std::uint8_t, std::conditional_t<kBytes == 2, std::uint16_t, std::uint32_t>>;
  Bits bits = 0;
  hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}
template <class D>
HWY_INLINE std::uint32_t bits_zero(D d, hn::Vec<D> v) {
  return bits_where(d, hn::Eq(v, hn::Zero(d)));
}

template <class D>
HWY_INLINE hn::Vec<D> set16(D d, std::int32_t x) {
  return hn::Set(d, static_cast<std::uint16_t>(x));
}

HWY_INLINE Thresholds thresholds_of(const Planes& p, const BqrNode& n) {
  const PlanesTag d;
  const hn::Rebind<std::int32_t, PlanesTag> di;
  const auto per_step = std::bit_cast<float>(0x7F000000U - std::bit_cast<std::uint32_t>(n.step));  // a power of two
  const auto step = hn::Set(d, static_cast<double>(n.step)),
             k = hn::Set(d, kTestScale / 65536 * static_cast<double>(per_step));
  const auto x = hn::Set(d, static_cast<double>(n.corner.x)), y = hn::Set(d, static_cast<double>(n.corner.y)),
             z = hn::Set(d, static_cast<double>(n.corner.z));
  const auto low = hn::Zero(d), high = hn::Set(d, kLatticeEnd);
  Thresholds t;
  for (std::size_t i = 0; i < kMaxPlanes; i += hn::Lanes(d)) {
    const auto turned = hn::MulSub(hn::Load(d, &p.turned[i]), step, hn::Load(d, &p.offset[i]));
    const auto minus_d =
        hn::NegMulAdd(hn::Load(d, &p.x[i]), x,
                      hn::NegMulAdd(hn::Load(d, &p.y[i]), y, hn::NegMulAdd(hn::Load(d, &p.z[i]), z, turned)));
    const auto m = hn::Load(d, &p.margin[i]);
    const auto out = hn::MulAdd(hn::Sub(minus_d, m), k, hn::Set(d, -2.0));
    const auto in = hn::MulAdd(hn::Add(minus_d, m), k, hn::Set(d, 4.0));  // cut to a whole number: ceil + 3
    hn::Store(hn::DemoteTo(di, hn::Min(hn::Max(out, low), high)), di, &t.out[i]);
    hn::Store(hn::DemoteTo(di, hn::Min(hn::Max(in, low), high)), di, &t.in[i]);
  }
  return t;
}

/// F of points with distances x, y, z.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V distance(D d, const Slope& p, V x, V y, V z) {
  return hn::Add(hn::Add(hn::MulHigh(hn::Load(d, p.a[0].data()), x), hn::MulHigh(hn::Load(d, p.a[1].data()), y)),
                 hn::MulHigh(hn::Load(d, p.a[2].data()), z));
}

/// Gathers, plane by plane, which lanes are outside and which planes they may cross.
template <class V>
struct Verdict {
  V gone, planes;  ///< gone != 0: outside
};

/// Plane k's bit where v is not zero.
HWY_INLINE hn::Vec<NodeTag> plane_bit(hn::Vec<NodeTag> v, int k) {
  const NodeTag d;
  return hn::IfThenZeroElse(hn::Eq(v, hn::Zero(d)), set16(d, 1 << k));
}

template <class V = hn::Vec<NodeTag>>
HWY_INLINE Verdict<V> test_balls(const SpreadPlanes& planes, unsigned which, const Thresholds& t, const BqrNode& n,
                                 std::size_t i) {
  const NodeTag d;
  Verdict<V> verdict{hn::Zero(d), hn::Zero(d)};
  const V x = hn::Load(d, &n.sphere[0][i]), y = hn::Load(d, &n.sphere[1][i]), z = hn::Load(d, &n.sphere[2][i]),
          r = hn::Load(d, &n.sphere[3][i]);
  for (; which != 0; which &= which - 1) {
    const int k = std::countr_zero(which);
    const Slope& p = planes.slopes[static_cast<std::size_t>(k)];
    const V out = set16(d, t.out[static_cast<std::size_t>(k)]), in = set16(d, t.in[static_cast<std::size_t>(k)]);
    const V f = distance(d, p, hn::Xor(x, hn::Set(d, p.signs.flip[0])), hn::Xor(y, hn::Set(d, p.signs.flip[1])),
                         hn::Xor(z, hn::Set(d, p.signs.flip[2])));
    verdict.gone = hn::Or(verdict.gone, hn::SaturatedSub(out, hn::SaturatedAdd(f, r)));
    verdict.planes = hn::Or(verdict.planes, plane_bit(hn::SaturatedSub(hn::SaturatedAdd(in, r), f), k));
  }
  return verdict;
}

/// And leaves in `need` what the objects are to be asked where a lane is a block.
template <class V = hn::Vec<NodeTag>>
HWY_INLINE Verdict<V> test_boxes(const SpreadPlanes& planes, unsigned which, const Thresholds& t, const BqrNode& n,
                                 std::size_t i, std::array<Lanes16, kMaxPlanes>& need) {
  const NodeTag d;
  Verdict<V> verdict{hn::Zero(d), hn::Zero(d)};
  const int shift = n.shift;
  const V most = set16(d, 65535 >> shift);
  for (; which != 0; which &= which - 1) {
    const int k = std::countr_zero(which);
    const Slope& p = planes.slopes[static_cast<std::size_t>(k)];
    const V out = set16(d, t.out[static_cast<std::size_t>(k)]), in = set16(d, t.in[static_cast<std::size_t>(k)]);
    const auto inner = [&](std::size_t axis) { return hn::Load(d, &n.box[p.signs.inner[axis]][i]); };
    const auto outer = [&](std::size_t axis) { return hn::Not(hn::Load(d, &n.box[p.signs.outer[axis]][i])); };
    const V nearest = distance(d, p, outer(0), outer(1), outer(2));
    verdict.gone = hn::Or(verdict.gone, hn::SaturatedSub(out, distance(d, p, inner(0), inner(1), inner(2))));
    verdict.planes = hn::Or(verdict.planes, plane_bit(hn::SaturatedSub(in, nearest), k));
    const V left = hn::Min(hn::SaturatedSub(hn::SaturatedSub(out, nearest), set16(d, 1)), most);
    hn::Store(hn::SaturatedSub(hn::ShiftLeftSame(left, shift), set16(d, 2)), d, &need[static_cast<std::size_t>(k)][i]);
  }
  return verdict;
}

/// All lanes of a node against the planes of `which`.
HWY_INLINE void test_node(const SpreadPlanes& planes, unsigned which, const BqrNode& n, NodeResult& result) {
  const NodeTag d;
  const Thresholds t = thresholds_of(*planes.planes, n);
  std::uint32_t alive = 0, inside = 0;
  for (std::size_t i = 0; i < kLanes; i += hn::Lanes(d)) {
    auto [gone, crossed] = test_boxes(planes, which, t, n, i, result.need);
    if (n.balls != 0) {  // outside where either is, inside a plane where either is [numerics 2.3]
      const auto ball = test_balls(planes, which, t, n, i);
      gone = hn::Or(gone, ball.gone);
      crossed = hn::And(crossed, ball.planes);
    }
    hn::Store(crossed, d, &result.planes[i]);
    alive |= bits_zero(d, gone) << i;
    inside |= bits_zero(d, crossed) << i;
  }
  result.alive = alive & n.lanes;
  result.inside = inside & result.alive;
}

/// Bit i: classes[i] has one of `wanted`. 16 lanes.
HWY_INLINE std::uint32_t lanes_of(const ClassMask* classes, ClassMask wanted) {
  const NodeTag d;
  std::uint32_t none = 0;
  for (std::size_t i = 0; i < kLanes; i += hn::Lanes(d))
    none |= bits_zero(d, hn::And(hn::LoadU(d, classes + i), hn::Set(d, wanted))) << i;
  return ~none & 0xFFFFU;
}

/// Bit i: box i of a packet is not outside; bits of unused rows mean nothing. `need` as in NodeResult, of one lane.
HWY_INLINE std::uint32_t kept(const SpreadPlanes& planes, unsigned which, const Packet& packet,
                              const std::uint16_t* need) {
  const PacketTag d;
  constexpr std::size_t kWidth = hn::MaxLanes(d), kVectors = kPacket / kWidth;
  std::array<hn::Vec<PacketTag>, kVectors> gone;
  for (auto& v : gone) v = hn::Zero(d);
  for (; which != 0; which &= which - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(which));
    const Slope& p = planes.slopes[k];
    const auto out = hn::Set(d, need[k * kLanes]);
    for (std::size_t v = 0; v < kVectors; ++v) {
      const std::size_t i = v * kWidth;
      const auto inner = [&](std::size_t axis) { return hn::Load(d, &packet.box[p.signs.inner[axis]][i]); };
      const auto f = distance(d, p, inner(0), inner(1), inner(2));
      gone[v] = hn::Or(gone[v], hn::SaturatedSub(out, f));
    }
  }
  std::uint32_t keep = 0;
  for (std::size_t v = 0; v < kVectors; ++v) keep |= bits_zero(d, gone[v]) << (v * kWidth);
  return keep;
}

template <class D>
HWY_INLINE hn::Vec<D> squeezed(D /*d*/, hn::Vec<D> v, std::uint32_t bits) {
  return hn::CompressBits(v, reinterpret_cast<const std::uint8_t*>(&bits));
}

inline ObjectRun* write_one_by_one(std::uint32_t first, std::uint32_t starts, std::uint32_t ends, ObjectRun* to) {
  for (; starts != 0; starts &= starts - 1, ends &= ends - 1)
    *to++ = {first + static_cast<std::uint32_t>(std::countr_zero(starts)),
             first + static_cast<std::uint32_t>(std::countr_zero(ends)) + 1};
  return to;
}

/// Neighbouring rows whose bit is set are one run; row 0 is object `first`. There is room for 16 runs; the next goes to
/// what is returned. How many there are nobody can foretell, so where vectors can they are written without a loop.
HWY_INLINE ObjectRun* write_runs(std::uint32_t first, std::uint32_t rows, ObjectRun* to) {
  const std::uint32_t starts = rows & ~(rows << 1), ends = rows & ~(rows >> 1);
#if HWY_TARGET == HWY_AVX3_DL
  const int n = std::popcount(starts);
  if (n > 8) [[unlikely]]
    return write_one_by_one(first, starts, ends, to);
  const PacketTag d;
  const hn::Half<NodeTag> eight;
  const LaneTag wide;
  const auto low = [&](auto v) { return hn::LowerHalf(eight, hn::LowerHalf(NodeTag{}, v)); };
  const auto a = low(squeezed(d, hn::Iota(d, 0), starts)), b = low(squeezed(d, hn::Iota(d, 1), ends));
  const auto pairs = hn::Combine(NodeTag{}, hn::InterleaveUpper(eight, a, b), hn::InterleaveLower(eight, a, b));
  hn::StoreU(hn::Add(hn::PromoteTo(wide, pairs), hn::Set(wide, first)), wide, &to->first);
  return to + n;
#else
  return write_one_by_one(first, starts, ends, to);
#endif
}

/// Bit i: lane i holds objects.
HWY_INLINE std::uint32_t holding(const BqrNode& n) {
  const LaneTag d;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < kLanes; i += hn::Lanes(d))
    bits |= bits_where(d, hn::Ne(hn::Load(d, &n.first[i]), hn::Load(d, &n.last[i]))) << i;
  return bits;
}

/// From lanes that start runs and lanes that end them.
HWY_INLINE ObjectRun* write_runs(const BqrNode& n, std::uint32_t starts, std::uint32_t ends, ObjectRun* to) {
#if HWY_TARGET <= HWY_AVX3
  if (n.ordered) {  // so there are 8 at most
    const LaneTag d;
    const hn::Half<LaneTag> half;
    const hn::Repartition<std::uint64_t, LaneTag> pairs;
    const auto firsts = hn::LowerHalf(half, squeezed(d, hn::Load(d, n.first.data()), starts)),
               lasts = hn::LowerHalf(half, squeezed(d, hn::Load(d, n.last.data()), ends));
    hn::StoreU(hn::Or(hn::PromoteTo(pairs, firsts), hn::ShiftLeft<32>(hn::PromoteTo(pairs, lasts))), pairs,
               reinterpret_cast<std::uint64_t*>(to));
    return to + std::popcount(starts);
  }
#endif
  for (; starts != 0; starts &= starts - 1, ends &= ends - 1)
    *to++ = {n.first[static_cast<std::size_t>(std::countr_zero(starts))],
             n.last[static_cast<std::size_t>(std::countr_zero(ends))]};
  return to;
}

}  // namespace manzana::culling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
