#include "culling/object_table.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

namespace manzana::culling {
namespace {

constexpr std::size_t kPacket = 8;

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// One plane over the whole table: the columns of the corners farthest along its normal, and the plane pushed out by
/// the largest margin that any of its objects can need.
struct PlaneColumns {
  const float *x, *y, *z;
  float a, b, c, d;
};

struct Test {
  std::array<PlaneColumns, 6> planes;
  std::size_t count = 0;
};

Test make_test(const ObjectTable& t, const Frustum& frustum) {
  Test test;
  for (std::size_t k = 0; k < static_cast<std::size_t>(frustum.count); ++k) {
    const auto& [n, d] = frustum.planes[k];
    const Vec3 sizes = glm::abs(n) * t.reach;
    // Twice the margin of overlap.h: the sum with d rounds once more here.
    const float margin = 2 * kMargin * (sizes.x + sizes.y + sizes.z + std::abs(d)) + frustum.slack[k];
    test.planes[test.count++] = {(n.x >= 0 ? t.max_x : t.min_x).data(),
                                 (n.y >= 0 ? t.max_y : t.min_y).data(),
                                 (n.z >= 0 ? t.max_z : t.min_z).data(),
                                 n.x,
                                 n.y,
                                 n.z,
                                 d + margin};
  }
  return test;
}

/// The least of the planes' answers for `Count` objects from `i` on. Plain loops over fixed counts: compilers turn them
/// into packed multiplications and minima.
template <std::size_t Count>
void least_distances(const Test& test, std::size_t i, std::array<float, Count>& least) {
  least.fill(std::numeric_limits<float>::infinity());
  for (std::size_t k = 0; k < test.count; ++k) {
    const PlaneColumns p = test.planes[k];
    for (std::size_t j = 0; j < Count; ++j) {
      const float s = p.a * p.x[i + j] + p.b * p.y[i + j] + p.c * p.z[i + j] + p.d;
      least[j] = s < least[j] ? s : least[j];  // a NaN leaves the object in
    }
  }
}

/// Bit j: object i + j is not outside.
template <std::size_t Count>
unsigned kept(const Test& test, std::size_t i) {
  std::array<float, Count> least;
  least_distances(test, i, least);
  unsigned bits = 0;
  for (std::size_t j = 0; j < Count; ++j) bits |= least[j] < 0 ? 0U : 1U << j;
  return bits;
}

void append(std::vector<ObjectRun>& runs, std::uint32_t first, std::uint32_t last) {
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

void test_objects(const Test& test, ObjectRun objects, std::vector<ObjectRun>& out) {
  std::uint32_t i = objects.first;
  for (; i + kPacket <= objects.last; i += kPacket) append_bits(out, i, kept<kPacket>(test, i));
  for (; i < objects.last; ++i) append_bits(out, i, kept<1>(test, i));
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
  for (const LeafRun& run : blocks) {
    const ObjectRun objects{table.first[run.first], table.first[run.last]};
    if (objects.first == objects.last) continue;
    if (run.where == Overlap::inside)
      append(out, objects.first, objects.last);
    else
      test_objects(test, objects, out);
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
