#include "culling/object_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

#include "culling/simd.h"

namespace manzana::culling {
namespace {

constexpr std::uint32_t kPacket = 8;

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// One plane over the whole table: the columns of the corners farthest along its normal, and the plane pushed out by
/// the largest margin that any of its objects can need.
struct PlaneColumns {
  std::uint32_t x, y, z;
  float a, b, c, d;
};

using Test = std::array<PlaneColumns, 6>;

Test make_test(const ObjectTable& t, const Frustum& frustum) {
  Test test{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(frustum.count); ++k) {
    const auto& [n, d] = frustum.planes[k];
    const Vec3 sizes = glm::abs(n) * t.reach;
    // Twice the margin of overlap.h: the sum with d rounds once more here.
    const float margin = 2 * kMargin * (sizes.x + sizes.y + sizes.z + std::abs(d)) + frustum.slack[k];
    test[k] = {n.x >= 0 ? 3U : 0U, n.y >= 0 ? 4U : 1U, n.z >= 0 ? 5U : 2U, n.x, n.y, n.z, d + margin};
  }
  return test;
}

/// Objects of one block or several, and the planes (bits) that they may reach beyond.
struct Doubtful {
  std::uint32_t first, last;
  unsigned planes;
};

/// Bit j: the packet's object j is not outside.
unsigned kept(const Test& test, unsigned planes, const ObjectPacket& packet) {
  Float4 left = splat(std::numeric_limits<float>::infinity());
  Float4 right = left;
  for (; planes != 0; planes &= planes - 1) {
    const PlaneColumns& p = test[static_cast<std::size_t>(std::countr_zero(planes))];
    const float *x = packet.columns[p.x].data(), *y = packet.columns[p.y].data(), *z = packet.columns[p.z].data();
    const Float4 a = splat(p.a), b = splat(p.b), c = splat(p.c), d = splat(p.d);
    // A NaN leaves the object in: minimum() then answers its second operand.
    left = minimum(a * load(x) + b * load(y) + c * load(z) + d, left);
    right = minimum(a * load(x + 4) + b * load(y + 4) + c * load(z + 4) + d, right);
  }
  const Float4 zero = splat(0);
  return ~(less(left, zero) | less(right, zero) << 4) & 0xFFU;
}

void append(std::vector<ObjectRun>& runs, std::uint32_t first, std::uint32_t last) {
  if (first == last) return;
  if (!runs.empty() && runs.back().last == first)
    runs.back().last = last;
  else
    runs.push_back({first, last});
}

void append_bits(std::vector<ObjectRun>& runs, std::uint32_t first, unsigned bits) {
  while (bits != 0) {
    const auto skip = static_cast<unsigned>(std::countr_zero(bits));
    const auto length = static_cast<unsigned>(std::countr_one(bits >> skip));
    append(runs, first + skip, first + skip + length);
    bits &= ~(((1U << length) - 1U) << skip);
  }
}

/// Lanes of packet p that hold objects of [first, last).
unsigned lanes(std::uint32_t p, std::uint32_t first, std::uint32_t last) {
  const std::uint32_t start = p * kPacket;
  const unsigned from = first > start ? 0xFFU << (first - start) : 0xFFU;
  const unsigned to = last < start + kPacket ? (1U << (last - start)) - 1U : 0xFFU;
  return from & to;
}

void test_objects(const ObjectTable& t, const Test& test, const Doubtful& objects, std::vector<ObjectRun>& out) {
  const std::uint32_t end = (objects.last + kPacket - 1) / kPacket;
  for (std::uint32_t p = objects.first / kPacket; p < end; ++p)
    append_bits(out, p * kPacket, kept(test, objects.planes, t.packets[p]) & lanes(p, objects.first, objects.last));
}

}  // namespace

ObjectTable build_object_table(const Vec3d& origin, std::span<const BoxD> boxes, std::vector<std::uint32_t> first) {
  assert(!first.empty() && first.front() == 0 && first.back() == boxes.size());
  ObjectTable t;
  t.first = std::move(first);
  t.reach = Vec3(0);
  t.packets.resize((boxes.size() + kPacket - 1) / kPacket);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box box = narrow(boxes[i], origin);
    if (box.empty() || !finite(box.min) || !finite(box.max))
      throw std::invalid_argument("object " + std::to_string(i) + ": its box is empty or not finite");
    for (int axis = 0; axis < 3; ++axis) {
      auto& columns = t.packets[i / kPacket].columns;
      columns[static_cast<std::size_t>(axis)][i % kPacket] = box.min[axis];
      columns[static_cast<std::size_t>(axis) + 3][i % kPacket] = box.max[axis];
    }
    t.reach = glm::max(t.reach, glm::max(glm::abs(box.min), glm::abs(box.max)));
  }
  return t;
}

Box ObjectTable::box(std::uint32_t i) const {
  const auto& c = packets[i / kPacket].columns;
  const std::uint32_t lane = i % kPacket;
  return {{c[0][lane], c[1][lane], c[2][lane]}, {c[3][lane], c[4][lane], c[5][lane]}};
}

void prefetch(const ObjectTable& table, const LeafRun& run) {
  const std::uint32_t first = table.first[run.first], last = table.first[run.last];
  const auto* begin = reinterpret_cast<const char*>(table.packets.data() + first / kPacket);
  const auto* end = reinterpret_cast<const char*>(table.packets.data() + (last + kPacket - 1) / kPacket);
  for (; begin < end; begin += 64) __builtin_prefetch(begin);
}

void reserve_runs(std::vector<ObjectRun>& runs, const ObjectTable& table) { runs.reserve(table.size()); }

void cull_objects(const ObjectTable& table, std::span<const LeafRun> blocks, const Frustum& frustum,
                  std::vector<ObjectRun>& out) {
  out.clear();
  const Test test = make_test(table, frustum);
  const unsigned all = (1U << frustum.count) - 1U;
  for (const LeafRun& run : blocks) {
    const std::uint32_t first = table.first[run.first], last = table.first[run.last];
    if (run.where == Overlap::crosses)
      test_objects(table, test, {first, last, run.planes & all}, out);
    else
      append(out, first, last);
  }
}

void take_all(const ObjectTable& table, std::vector<ObjectRun>& out) {
  out.clear();
  if (table.size() > 0) out.push_back({0, table.size()});
}

std::uint64_t count(std::span<const ObjectRun> runs) {
  std::uint64_t sum = 0;
  for (const ObjectRun& run : runs) sum += run.last - run.first;
  return sum;
}

}  // namespace manzana::culling
