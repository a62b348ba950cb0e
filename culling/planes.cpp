#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "culling/planes.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <hwy/highway.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "culling/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace manzana::culling::HWY_NAMESPACE {

constexpr std::size_t kRoom = std::tuple_size_v<decltype(FrustumD::planes)>;
constexpr double kUnit = 0x1p-53;

/// Normals and offsets of planes side by side.
template <class V>
struct Columns {
  V x, y, z, offset;
};

/// Planes kFrom and on, as many as fit; 0 where a frustum has no room for one. In registers all the way: what is
/// written in parts is slow to be read as a whole.
template <std::size_t kFrom, class D>
HWY_INLINE Columns<hn::Vec<D>> columns_of(D d, const FrustumD& f) {
  constexpr std::size_t kWidth = hn::MaxLanes(d);
  Columns<hn::Vec<D>> c{hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  if constexpr (kFrom + kWidth <= kRoom) {
    hn::LoadInterleaved4(d, &f.planes[kFrom].normal.x, c.x, c.y, c.z, c.offset);
#if HWY_TARGET != HWY_SCALAR
  } else if constexpr (kFrom < kRoom) {
    const hn::Half<D> half;
    const auto low = columns_of<kFrom>(half, f), high = columns_of<kFrom + kWidth / 2>(half, f);
    c = {hn::Combine(d, high.x, low.x), hn::Combine(d, high.y, low.y), hn::Combine(d, high.z, low.z),
         hn::Combine(d, high.offset, low.offset)};
#endif
  }
  return c;
}

/// What is asked of slopes, before it is spread: A_i, and the index of the signs.
struct alignas(64) Factors {
  std::array<std::array<std::int32_t, kMaxPlanes>, 3> a;
  std::array<std::uint64_t, kMaxPlanes> signs;
};

template <class D, class V>
HWY_INLINE void set_factors(D d, const Columns<V>& c, std::size_t from, Factors& to) {
  const hn::Rebind<std::int32_t, D> di;
  const hn::RebindToUnsigned<D> du;
  const auto factor = [&](V n) {
    return hn::Add(hn::DemoteTo(di, hn::Mul(hn::Abs(n), hn::Set(d, kTestScale))), hn::Set(di, 1));
  };
  const auto sign = [&](V n, std::uint64_t bit) {
    return hn::IfThenElseZero(hn::RebindMask(du, hn::Lt(n, hn::Zero(d))), hn::Set(du, bit));
  };
  hn::Store(factor(c.x), di, &to.a[0][from]);
  hn::Store(factor(c.y), di, &to.a[1][from]);
  hn::Store(factor(c.z), di, &to.a[2][from]);
  hn::Store(hn::Or(hn::Or(sign(c.x, 1), sign(c.y, 2)), sign(c.z, 4)), du, &to.signs[from]);
}

/// Planes kFrom and on. `shift` is the tree's origin seen from the eye. Bits of those that can be used.
/// Normals are exact to 4 units, so a plane is off by 4 units of its distance from the eye; volumes and what is
/// computed here and for each node round some ten times more, by a unit of what is farthest.
template <std::size_t kFrom>
HWY_INLINE unsigned set_planes(const FrustumD& f, const Vec3d& shift, double farthest, Planes& to, Factors& factors) {
  const PlanesTag d;
  const auto zero = hn::Zero(d);
  const auto c = columns_of<kFrom>(d, f);
  const auto size = hn::Add(hn::Add(hn::Abs(c.x), hn::Abs(c.y)), hn::Abs(c.z));
  const auto offset = hn::Add(hn::MulAdd(c.x, hn::Set(d, shift.x), hn::Mul(c.y, hn::Set(d, shift.y))),
                              hn::MulAdd(c.z, hn::Set(d, shift.z), c.offset));
  const auto margin = hn::Mul(hn::Add(hn::Set(d, farthest), hn::Abs(c.offset)), hn::Set(d, 64 * kUnit));
  const auto back = hn::Add(hn::Add(hn::Min(c.x, zero), hn::Min(c.y, zero)), hn::Min(c.z, zero));
  hn::Store(c.x, d, &to.x[kFrom]);
  hn::Store(c.y, d, &to.y[kFrom]);
  hn::Store(c.z, d, &to.z[kFrom]);
  hn::Store(offset, d, &to.offset[kFrom]);
  hn::Store(hn::Mul(back, hn::Set(d, -kLatticeEnd)), d, &to.turned[kFrom]);
  hn::Store(margin, d, &to.margin[kFrom]);
  set_factors(d, c, kFrom, factors);
  const auto usable = hn::And(hn::Gt(size, zero), hn::IsFinite(hn::Add(hn::Add(offset, size), margin)));
  return bits_where(d, usable) << kFrom;
}

template <std::size_t... kPart>
HWY_INLINE unsigned set_all(std::index_sequence<kPart...> /*parts*/, const FrustumD& f, const Vec3d& shift,
                            double farthest, Planes& to, Factors& factors) {
  return (set_planes<kPart * hn::MaxLanes(PlanesTag{})>(f, shift, farthest, to, factors) | ...);
}

/// What the signs of a normal say: bit i of the index is set where n_i < 0.
constexpr auto kSigns = [] {
  std::array<Slope, 8> all{};
  for (unsigned bits = 0; bits < 8; ++bits)
    for (unsigned i = 0; i < 3; ++i) {
      const bool back = (bits >> i & 1) != 0;
      all[bits].flip[i] = back ? 0xFFFF : 0;
      all[bits].inner[i] = static_cast<std::uint8_t>((back ? i + 3 : i) * kLanes);
      all[bits].outer[i] = static_cast<std::uint8_t>((back ? i : i + 3) * kLanes);
    }
  return all;
}();

Planes planes_of(const BqrTree& tree, const FrustumD& frustum) {
  Planes planes;
  Factors factors;
  const Vec3d shift = tree.origin - frustum.eye;
  const double farthest = glm::length(shift) + 2 * tree.reach;
  planes.used = set_all(std::make_index_sequence<kMaxPlanes / hn::MaxLanes(PlanesTag{})>{}, frustum, shift, farthest,
                        planes, factors) &
                ((1U << frustum.count) - 1);
  const hn::CappedTag<std::uint16_t, 8> d;
  for (unsigned which = planes.used; which != 0; which &= which - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(which));
    Slope& slope = planes.slopes[k];
    slope = kSigns[factors.signs[k]];
    for (std::size_t axis = 0; axis < 3; ++axis)
      hn::Store(hn::Set(d, static_cast<std::uint16_t>(factors.a[axis][k])), d, slope.a[axis].data());
  }
  return planes;
}

}  // namespace manzana::culling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace manzana::culling {

HWY_EXPORT(planes_of);

namespace {

/// A longer normal would not fit into 16 bits.
[[maybe_unused]] bool wrong(const PlaneD& p) {
  const double length = glm::length(p.normal);
  return length > 0 && std::isfinite(length) && std::abs(length - 1) > 1e-6;
}

}  // namespace

Planes make_planes(const BqrTree& tree, const FrustumD& frustum) {
  assert(std::none_of(frustum.planes.begin(), frustum.planes.end(), wrong));
  return HWY_DYNAMIC_DISPATCH(planes_of)(tree, frustum);
}

}  // namespace manzana::culling
#endif
