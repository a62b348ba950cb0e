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
  const float *x, *y, *z;
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
    test[k] = {(n.x >= 0 ? t.max_x : t.min_x).data(),
               (n.y >= 0 ? t.max_y : t.min_y).data(),
               (n.z >= 0 ? t.max_z : t.min_z).data(),
               n.x,
               n.y,
               n.z,
               d + margin};
  }
  return test;
}

/// Objects of one block or several, and the planes (bits) that they may reach beyond.
struct Doubtful {
  std::uint32_t first, last;
  unsigned planes;
};

/// Bit j: object i + j is not outside, for the eight objects from i on.
unsigned kept(const Test& test, unsigned planes, std::size_t i) {
  Float4 left = splat(std::numeric_limits<float>::infinity());
  Float4 right = left;
  for (; planes != 0; planes &= planes - 1) {
    const PlaneColumns& p = test[static_cast<std::size_t>(std::countr_zero(planes))];
    const Float4 a = splat(p.a), b = splat(p.b), c = splat(p.c), d = splat(p.d);
    // A NaN leaves the object in: minimum() then answers its second operand.
    left = minimum(a * load(p.x + i) + b * load(p.y + i) + c * load(p.z + i) + d, left);
    right = minimum(a * load(p.x + i + 4) + b * load(p.y + i + 4) + c * load(p.z + i + 4) + d, right);
  }
  const Float4 zero = splat(0);
  return ~(less(left, zero) | less(right, zero) << 4) & 0xFFU;
}

bool kept_alone(const Test& test, unsigned planes, std::size_t i) {
  for (; planes != 0; planes &= planes - 1) {
    const PlaneColumns& p = test[static_cast<std::size_t>(std::countr_zero(planes))];
    if (p.a * p.x[i] + p.b * p.y[i] + p.c * p.z[i] + p.d < 0) return false;
  }
  return true;
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

void test_objects(const Test& test, const Doubtful& objects, std::vector<ObjectRun>& out) {
  std::uint32_t i = objects.first;
  for (; i + kPacket <= objects.last; i += kPacket) append_bits(out, i, kept(test, objects.planes, i));
  if (i == objects.last) return;
  if (objects.last >= kPacket) {  // a whole packet that ends with the last object, less what was tested already
    const std::uint32_t start = objects.last - kPacket;
    append_bits(out, i, kept(test, objects.planes, start) >> (i - start));
  } else {
    for (; i < objects.last; ++i)
      if (kept_alone(test, objects.planes, i)) append(out, i, i + 1);
  }
}

}  // namespace

ObjectTable build_object_table(const Vec3d& origin, std::span<const BoxD> boxes, std::vector<std::uint32_t> first) {
  assert(!first.empty() && first.front() == 0 && first.back() == boxes.size());
  ObjectTable t;
  t.first = std::move(first);
  t.reach = Vec3(0);
  for (std::vector<float>* column : {&t.min_x, &t.min_y, &t.min_z, &t.max_x, &t.max_y, &t.max_z})
    column->reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box box = narrow(boxes[i], origin);
    if (box.empty() || !finite(box.min) || !finite(box.max))
      throw std::invalid_argument("object " + std::to_string(i) + ": its box is empty or not finite");
    t.min_x.push_back(box.min.x);
    t.min_y.push_back(box.min.y);
    t.min_z.push_back(box.min.z);
    t.max_x.push_back(box.max.x);
    t.max_y.push_back(box.max.y);
    t.max_z.push_back(box.max.z);
    t.reach = glm::max(t.reach, glm::max(glm::abs(box.min), glm::abs(box.max)));
  }
  return t;
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
      test_objects(test, {first, last, run.planes & all}, out);
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
