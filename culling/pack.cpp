#include "culling/pack.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

namespace manzana::culling {
namespace {

constexpr std::uint32_t kColumns = 6;

std::uint32_t filled(std::uint32_t objects) { return (objects + kPacket - 1) / kPacket; }

/// Packets whose boxes enclose a packet each, of a block with so many objects.
std::uint32_t enclosing(std::uint32_t objects) { return filled(objects) > kFew ? filled(filled(objects)) : 0; }

/// Bits 0 to 15 of x to every second place.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 8) & 0x00FF00FFU;
  x = (x | x << 4) & 0x0F0F0F0FU;
  x = (x | x << 2) & 0x33333333U;
  return (x | x << 1) & 0x55555555U;
}

/// Of the box's middle in plan.
std::uint32_t z_order(const Reaches& r) {
  const auto middle = [&](std::size_t axis) { return (r[axis] + (65535U - r[axis + 3])) / 2; };
  return spread(middle(0)) | spread(middle(1)) << 1;
}

bool holds(const BoxD& outer, const BoxD& inner) {
  return glm::all(glm::lessThanEqual(outer.min, inner.min)) && glm::all(glm::lessThanEqual(inner.max, outer.max));
}

bool encloses(const SphereD& ball, const BoxD& box) {
  const Vec3d farthest = glm::max(glm::abs(box.min - ball.center), glm::abs(box.max - ball.center));
  return glm::length(farthest) <= ball.radius;
}

/// Of the way to a box's corners: spheres that reach no farther are asked. Wider ones spare no packet and hardly a node
/// (docs/measurements.md).
constexpr double kNarrow = 0.8;

struct Packing {
  std::uint32_t key;
  std::uint32_t row;  // of the input
  Reaches reaches;
};

/// Row i encloses what it did, and r.
void widen(Packet& packet, std::size_t i, const Reaches& r) {
  for (std::size_t k = 0; k < kColumns; ++k) packet.box[k][i] = std::max(packet.box[k][i], r[k]);
}

/// From a row of the first packet on.
void write_packets(Packet* out, std::size_t row, const std::vector<Packing>& objects) {
  Packet* const packets = out + enclosing(static_cast<std::uint32_t>(objects.size()));
  for (std::size_t i = 0; i < objects.size(); ++i, ++row) {
    const std::size_t p = row / kPacket;
    widen(packets[p], row % kPacket, objects[i].reaches);
    if (packets != out) widen(out[p / kPacket], p % kPacket, objects[i].reaches);
  }
}

constexpr double kFarthest = 1e37;  // metres; what is drawn from it must still be finite in float

bool near(const Vec3d& v) { return glm::all(glm::lessThanEqual(glm::abs(v), Vec3d(kFarthest))); }

bool good(const BlockVolume& b) {
  return !b.box.empty() && near(b.box.min) && near(b.box.max) && !b.sphere.empty() && near(b.sphere.center) &&
         b.sphere.radius <= kFarthest && std::isfinite(b.center.x) && std::isfinite(b.center.y);
}

void refuse(const char* kind, std::size_t index, const char* what) {
  throw std::invalid_argument(kind + std::to_string(index) + ": " + what);
}

}  // namespace

void refuse_bad_block(const BlockVolume& volume, std::size_t index) {
  if (!good(volume)) refuse("block ", index, "centre or volume is empty, not finite or too far");
}

void refuse_bad_objects(std::span<const BoxD> boxes, std::span<const ClassMask> classes, const BlockVolume& volume,
                        std::size_t from) {
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (boxes[i].empty() || !holds(volume.box, boxes[i]))
      refuse("object ", from + i, "its box is empty or reaches out of its block");
  for (std::size_t i = 0; i < classes.size(); ++i)
    if (classes[i] == 0) refuse("object ", from + i, "it has no class");
}

SphereD relative(const SphereD& sphere, const Vec3d& origin) {
  const Vec3d c = sphere.center - origin;
  return {c, (sphere.radius + 0x1p-50 * glm::length(c)) * (1 + 0x1p-50)};
}

BqrNode empty_node(const Lattice& lattice) {
  BqrNode node;
  node.corner = Vec3(lattice.corner);
  node.step = static_cast<float>(lattice.step);
  return node;
}

Lattice lattice_of(const BqrNode& node) { return {Vec3d(node.corner), static_cast<double>(node.step)}; }

void set_volumes(BqrNode& node, std::uint32_t lane, const BoxD& box, const SphereD& ball) {
  const Lattice l = lattice_of(node);
  const Vec3d at = glm::clamp(glm::round((ball.center - l.corner) / l.step), 0.0, kLatticeEnd);
  for (int k = 0; k < 3; ++k) node.sphere[static_cast<std::size_t>(k)][lane] = static_cast<std::uint16_t>(at[k]);
  node.sphere[3][lane] = lattice_radius(ball.radius, l.step);
  set_box(node, lane, box);
  if (!encloses(ball, box)) node.balls |= static_cast<std::uint16_t>(1U << lane);
}

void set_box(BqrNode& node, std::uint32_t lane, const BoxD& box) {
  const Lattice l = lattice_of(node);
  const Reaches r = reaches_of(box, l.corner, l.far_corner(), 1 / l.step);
  for (std::size_t k = 0; k < kColumns; ++k) node.box[k][lane] = r[k];
}

void leave_out_wide_balls(BqrNode& node) {
  for (std::uint32_t i = 0; i < kLanes; ++i) {
    const SphereD ball = lane_sphere(node, i);
    if (encloses({ball.center, ball.radius / kNarrow}, lane_box(node, i)))
      node.balls &= static_cast<std::uint16_t>(~(1U << i));
  }
}

SphereD lane_sphere(const BqrNode& node, std::uint32_t lane) {
  const Lattice l = lattice_of(node);
  const auto& s = node.sphere;
  return {l.corner + l.step * Vec3d(s[0][lane], s[1][lane], s[2][lane]), s[3][lane] * (65536 / kTestScale) * l.step};
}

BoxD lane_box(const BqrNode& node, std::uint32_t lane) {
  const Lattice l = lattice_of(node);
  const auto& b = node.box;
  return {l.far_corner() - l.step * Vec3d(b[3][lane], b[4][lane], b[5][lane]),
          l.corner + l.step * Vec3d(b[0][lane], b[1][lane], b[2][lane])};
}

std::uint8_t finest_shift(const BqrNode& node) {
  std::uint32_t extent = 1;
  for (std::uint32_t i = 0; i < kLanes; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if ((node.blocks >> i & 1) != 0) extent = std::max(extent, node.box[k][i] + node.box[k + 3][i] - 65535U);
  return static_cast<std::uint8_t>(std::bit_width(65535U / extent) - 1);
}

std::uint32_t rows_of(std::uint32_t objects) { return enclosing(objects) * kPacket + objects; }

std::uint32_t first_row(std::uint32_t free, std::uint32_t objects) {
  return free % kPacket + objects <= kPacket ? free : filled(free) * kPacket;
}

void pack_objects(BqrTree& tree, std::uint32_t block, const BlockObjects& objects, std::uint32_t from,
                  const BlockVolume& volume, ObjectOrder order) {
  const BqrNode& node = tree.nodes[tree.place[block] / kLanes];
  const std::uint32_t lane = tree.place[block] % kLanes;
  const BoxD frame = lane_box(node, lane);
  const double steps = std::ldexp(1 / static_cast<double>(node.step), node.shift);
  const ObjectRun run = tree.block_objects[block];
  const std::uint32_t n = run.last - run.first;
  refuse_bad_objects(objects.boxes.subspan(from, n),
                     objects.classes.empty() ? objects.classes : objects.classes.subspan(from, n), volume, from);
  std::vector<Packing> packing(n);
  for (std::uint32_t i = 0; i < packing.size(); ++i) {
    const BoxD& box = objects.boxes[from + i];
    packing[i].row = from + i;
    packing[i].reaches = reaches_of({box.min - tree.origin, box.max - tree.origin}, frame.min, frame.max, steps);
    packing[i].key = order == ObjectOrder::z_curve ? z_order(packing[i].reaches) : 0;
  }
  std::sort(packing.begin(), packing.end(),
            [](const Packing& a, const Packing& b) { return std::pair(a.key, a.row) < std::pair(b.key, b.row); });
  write_packets(tree.packets.data() + node.child[lane] / kPacket, node.child[lane] % kPacket, packing);
  for (std::uint32_t i = 0; i < packing.size(); ++i) {
    tree.object_order[run.first + i] = packing[i].row;
    if (tree.classes.empty()) continue;
    tree.classes[run.first + i] = objects.classes[packing[i].row];
  }
}

ClassMask block_classes(const BqrTree& tree, std::uint32_t block, ClassMask others) {
  if (tree.classes.empty()) return kAllClasses;
  const ObjectRun run = tree.block_objects[block];
  ClassMask all = others;
  for (std::uint32_t i = run.first; i < run.last; ++i) all |= tree.classes[i];
  return all;
}

ClassMask all_classes(const BqrNode& node) {
  ClassMask all = 0;
  for (std::uint32_t i = 0; i < kLanes; ++i)
    if ((node.lanes >> i & 1) != 0) all |= node.classes[i];
  return all;
}

}  // namespace manzana::culling
