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

constexpr double kWhole =
    0x1.8p52;  ///< added to a small number: leaves the whole number nearest to it in the last bits

/// What is known of a node's lanes. Not initialised: a query has many, and fills those that it uses.
struct alignas(64) NodeResult {
  std::array<Lanes16, kMaxPlanes> need;  ///< t_out of the lattice of a block that crosses plane k
  Lanes16 planes;                        ///< bit k: lane i may cross plane k
  std::uint32_t alive;                   ///< not outside
  std::uint32_t inside;                  ///< alive, and certainly inside all planes
};

/// t_out and t_in of a node's lattice.
struct alignas(64) Thresholds {
  std::array<std::uint16_t, kMaxPlanes> out, in;
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

/// The last bits of x, a whole number from kWhole on, and no more than N.
template <class D>
HWY_INLINE void store_whole(D d, hn::Vec<D> x, std::uint16_t* to) {
  const hn::RebindToUnsigned<D> bits;
  const hn::Rebind<std::uint16_t, D> d16;
  const auto whole = hn::Min(hn::Max(x, hn::Set(d, kWhole)), hn::Set(d, kWhole + kLatticeEnd));
  hn::Store(hn::TruncateTo(d16, hn::BitCast(bits, whole)), d16, to);
}

/// Rounded to the nearest whole numbers: half a unit beside 2 and 3 of culling/lattice.h makes that floor and ceil, or
/// less and more.
HWY_INLINE Thresholds thresholds_of(const Planes& p, const BqrNode& n) {
  const PlanesTag d;
  const auto per_step = std::bit_cast<float>(0x7F000000U - std::bit_cast<std::uint32_t>(n.step));  // a power of two
  const auto step = hn::Set(d, static_cast<double>(n.step)),
             k = hn::Set(d, kTestScale / 65536 * static_cast<double>(per_step)), whole = hn::Set(d, kWhole);
  const auto x = hn::Set(d, static_cast<double>(n.corner.x)), y = hn::Set(d, static_cast<double>(n.corner.y)),
             z = hn::Set(d, static_cast<double>(n.corner.z));
  const auto in_metres = [&](double units) { return hn::Set(d, units * 65536 / kTestScale); };  // times the step
  Thresholds t;
  for (std::size_t i = 0; i < kMaxPlanes; i += hn::Lanes(d)) {
    const auto turned = hn::MulSub(hn::Load(d, &p.turned[i]), step, hn::Load(d, &p.offset[i]));
    const auto along_yz = hn::MulAdd(hn::Load(d, &p.y[i]), y, hn::Mul(hn::Load(d, &p.z[i]), z));
    const auto minus_d = hn::Sub(hn::NegMulAdd(hn::Load(d, &p.x[i]), x, turned), along_yz);
    const auto m = hn::Load(d, &p.margin[i]);
    const auto out = hn::Sub(minus_d, hn::MulAdd(step, in_metres(2.5), m)),
               in = hn::Add(minus_d, hn::MulAdd(step, in_metres(3.5), m));
    store_whole(d, hn::MulAdd(out, k, whole), &t.out[i]);
    store_whole(d, hn::MulAdd(in, k, whole), &t.in[i]);
  }
  return t;
}

/// F of points with distances x, y, z.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V distance(D d, const Slope& p, V x, V y, V z) {
  const auto a = [&](std::size_t axis) { return hn::LoadDup128(d, p.a[axis].data()); };
  return hn::Add(hn::Add(hn::MulHigh(a(0), x), hn::MulHigh(a(1), y)), hn::MulHigh(a(2), z));
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
HWY_INLINE Verdict<V> test_balls(const Planes& planes, unsigned which, const Thresholds& t, const BqrNode& n,
                                 std::size_t i) {
  const NodeTag d;
  Verdict<V> verdict{hn::Zero(d), hn::Zero(d)};
  const V x = hn::Load(d, &n.sphere[0][i]), y = hn::Load(d, &n.sphere[1][i]), z = hn::Load(d, &n.sphere[2][i]),
          r = hn::Load(d, &n.sphere[3][i]);
  for (; which != 0; which &= which - 1) {
    const int k = std::countr_zero(which);
    const Slope& p = planes.slopes[static_cast<std::size_t>(k)];
    const V out = set16(d, t.out[static_cast<std::size_t>(k)]), in = set16(d, t.in[static_cast<std::size_t>(k)]);
    const V f = distance(d, p, hn::Xor(x, hn::Set(d, p.flip[0])), hn::Xor(y, hn::Set(d, p.flip[1])),
                         hn::Xor(z, hn::Set(d, p.flip[2])));
    verdict.gone = hn::Or(verdict.gone, hn::SaturatedSub(out, hn::SaturatedAdd(f, r)));
    verdict.planes = hn::Or(verdict.planes, plane_bit(hn::SaturatedSub(hn::SaturatedAdd(in, r), f), k));
  }
  return verdict;
}

/// And leaves in `need` what the objects are to be asked where a lane is a block.
template <class V = hn::Vec<NodeTag>>
HWY_INLINE Verdict<V> test_boxes(const Planes& planes, unsigned which, const Thresholds& t, const BqrNode& n,
                                 std::size_t i, std::array<Lanes16, kMaxPlanes>& need) {
  const NodeTag d;
  Verdict<V> verdict{hn::Zero(d), hn::Zero(d)};
  const int shift = n.shift;
  const V most = set16(d, 65535 >> shift);
  const std::uint16_t* const box = n.box[0].data();
  for (; which != 0; which &= which - 1) {
    const int k = std::countr_zero(which);
    const Slope& p = planes.slopes[static_cast<std::size_t>(k)];
    const V out = set16(d, t.out[static_cast<std::size_t>(k)]), in = set16(d, t.in[static_cast<std::size_t>(k)]);
    const auto inner = [&](std::size_t axis) { return hn::Load(d, box + p.inner[axis] + i); };
    const auto outer = [&](std::size_t axis) { return hn::Not(hn::Load(d, box + p.outer[axis] + i)); };
    const V nearest = distance(d, p, outer(0), outer(1), outer(2));
    verdict.gone = hn::Or(verdict.gone, hn::SaturatedSub(out, distance(d, p, inner(0), inner(1), inner(2))));
    verdict.planes = hn::Or(verdict.planes, plane_bit(hn::SaturatedSub(in, nearest), k));
    const V left = hn::Min(hn::SaturatedSub(hn::SaturatedSub(out, nearest), set16(d, 1)), most);
    hn::Store(hn::SaturatedSub(hn::ShiftLeftSame(left, shift), set16(d, 2)), d, &need[static_cast<std::size_t>(k)][i]);
  }
  return verdict;
}

/// All lanes of a node against the planes of `which`.
HWY_INLINE void test_node(const Planes& planes, unsigned which, const BqrNode& n, NodeResult& result) {
  const NodeTag d;
  const Thresholds t = thresholds_of(planes, n);
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

/// Of a packet; `at` is where a node's box has it.
HWY_INLINE const std::uint16_t* column_of(const Packet& packet, std::size_t at) {
  return packet.box[0].data() + at * (kPacket / kLanes);
}

/// Bit i: box i of a packet is not outside; bits of unused rows mean nothing. `need` as in NodeResult, of one lane.
HWY_INLINE std::uint32_t kept(const Planes& planes, unsigned which, const Packet& packet, const std::uint16_t* need) {
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
      const auto inner = [&](std::size_t axis) { return hn::Load(d, column_of(packet, p.inner[axis]) + i); };
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

inline ObjectRun* write_one_by_one(std::uint32_t first, std::uint32_t rows, ObjectRun* to) {
  for (std::uint32_t starts = rows & ~(rows << 1), ends = rows & ~(rows >> 1); starts != 0;
       starts &= starts - 1, ends &= ends - 1)
    *to++ = {first + static_cast<std::uint32_t>(std::countr_zero(starts)),
             first + static_cast<std::uint32_t>(std::countr_zero(ends)) + 1};
  return to;
}

/// Neighbouring rows whose bit is set are one run; row 0 is object `first`. There is room for 16 runs; the next goes to
/// what is returned. How many there are nobody can foretell, so where vectors can they are written without a loop:
/// starts and ends in turn are the rows whose bit is not the last one's.
HWY_INLINE ObjectRun* write_runs(std::uint32_t first, std::uint32_t rows, ObjectRun* to) {
#if HWY_TARGET == HWY_AVX3_DL
  const std::uint32_t turns = rows ^ rows << 1;
  const int n = std::popcount(turns);
  if (n > 16) [[unlikely]]
    return write_one_by_one(first, rows, to);
  const hn::RebindToSigned<PacketTag> d;
  const hn::RebindToSigned<LaneTag> wide;
  // Counted from the packet's end: what is left of the vector is 0, so a run that goes to the end ends there.
  const auto at =
      hn::LowerHalf(hn::RebindToSigned<NodeTag>{}, squeezed(d, hn::Iota(d, -static_cast<int>(kPacket)), turns));
  const auto end = hn::Set(wide, static_cast<std::int32_t>(first + kPacket));
  hn::StoreU(hn::Add(hn::PromoteTo(wide, at), end), wide, reinterpret_cast<std::int32_t*>(to));
  return to + (n + 1) / 2;
#else
  return write_one_by_one(first, rows, to);
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
