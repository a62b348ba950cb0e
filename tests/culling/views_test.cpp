// Filters of classes and several views at once: what they answer is what one view without a filter does, filtered; by
// every kind of vectors.
#include <iostream>

#include "tests/culling/classified_city.h"

namespace manzana::culling::test {
namespace {

std::vector<bool> wanted_objects(const Scene& s, std::vector<bool> seen, ClassMask mask) {
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = seen[i] && (s.classes[s.tree.object_order[i]] & mask) != 0;
  return seen;
}

ClassMask classes_of(const Scene& s, std::uint32_t block) {
  const std::uint32_t row = s.tree.order[block];
  ClassMask all = s.city.blocks[row].classes;
  for (std::uint32_t i = s.city.first[row]; i < s.city.first[row + 1]; ++i) all |= s.classes[i];
  return all;
}
std::vector<bool> wanted_blocks(const Scene& s, std::vector<bool> seen, ClassMask mask) {
  for (std::uint32_t b = 0; b < seen.size(); ++b) seen[b] = seen[b] && (classes_of(s, b) & mask) != 0;
  return seen;
}

TEST_CASE("a filter in the traversal takes what a filter after it does") {
  Random random(82);
  const Scene s = classified(random);
  Answer all(s.tree), some(s.tree);
  std::uint64_t taken = 0, left = 0;
  for (int i = 0; i < 400; ++i) {
    const Planes planes = planes_of(s, any_view(s, random));
    const ClassMask mask = any_mask(random);
    INFO("seed 82, view " << i << ", classes " << mask);
    on_each_target([&](const char*) {
      cull(s.tree, planes, all, {.blocks = true});
      cull(s.tree, planes, some, {.classes = mask, .blocks = true});
      const auto unfiltered = seen_objects(s, all), seen = seen_objects(s, some);
      REQUIRE(seen == wanted_objects(s, unfiltered, mask));
      REQUIRE(flags(some.blocks(), s.tree.blocks()) == wanted_blocks(s, flags(all.blocks(), s.tree.blocks()), mask));
      taken += count(seen);
      left += count(unfiltered) - count(seen);
    });
  }
  CHECK(taken > 10'000);
  CHECK(left > 10'000);
}

TEST_CASE("a filter: no class takes nothing, a tree without classes is of all") {
  Random random(83);
  const Scene s = classified(random), plain = city_10k();
  const View above = look({0, 0, 1e5}, {0, 0, -1}, {0, 1, 0}, 1, 1);
  Answer answer;
  cull(s.tree, planes_of(s, above), answer, {.classes = 0});
  CHECK(answer.objects().empty());
  cull(plain.tree, planes_of(plain, above), answer, {.classes = 0x40});
  CHECK(count(answer.objects()) == plain.tree.objects());
  cull(plain.tree, planes_of(plain, above), answer, {.classes = 0, .blocks = true});
  CHECK(answer.objects().empty());
  CHECK(answer.blocks().empty());
}

void check_views(const Scene& s, const std::vector<Planes>& planes, const CullOptions& options) {
  std::array<Answer, kMaxViews> answers;
  Answer alone(s.tree);
  cull(s.tree, planes, std::span(answers).first(planes.size()), options);
  for (std::size_t v = 0; v < planes.size(); ++v) {
    INFO("view " << v << " of " << planes.size() << ", classes " << options.classes);
    cull(s.tree, planes[v], alone, options);
    REQUIRE(seen_objects(s, answers[v]) == seen_objects(s, alone));
    REQUIRE(flags(answers[v].blocks(), s.tree.blocks()) == flags(alone.blocks(), s.tree.blocks()));
  }
}

TEST_CASE("several views in one traversal take what each alone does") {
  Random random(84);
  const Scene s = classified(random);
  for (int i = 0; i < 240; ++i) {
    std::vector<Planes> planes(1 + static_cast<std::size_t>(i) % kMaxViews);
    for (Planes& p : planes) p = planes_of(s, any_view(s, random));
    INFO("seed 84, trial " << i);
    on_each_target([&](const char*) {
      check_views(s, planes, {.blocks = random.chance(0.5)});
      check_views(s, planes, {.classes = any_mask(random), .blocks = random.chance(0.5)});
    });
  }
}

TEST_CASE("whole lanes and their order are short cuts, no more") {
  Random random(85);
  const Scene s = classified(random);
  Scene slow = s;
  for (BqrNode& node : slow.tree.nodes) {
    node.whole &= static_cast<std::uint16_t>(random.below(0x10000));
    node.ordered = random.chance(0.5);
  }
  Answer quick(s.tree), answer(s.tree);
  for (int i = 0; i < 200; ++i) {
    const Planes planes = planes_of(s, any_view(s, random));
    const CullOptions options{.classes = any_mask(random), .blocks = true};
    cull(s.tree, planes, quick, options);
    cull(slow.tree, planes, answer, options);
    INFO("seed 85, view " << i << ", classes " << options.classes);
    REQUIRE(seen_objects(s, answer) == seen_objects(s, quick));
    REQUIRE(flags(answer.blocks(), s.tree.blocks()) == flags(quick.blocks(), s.tree.blocks()));
  }
}

/// One enormous object (a plain round the city, a dome) makes the lattices of its node and of those above it coarse.
TEST_CASE("an enormous object: nothing is lost, and how much else is taken") {
  for (const double size : {0.0, 1e4, 1e5, 1e6, 1e7}) {
    City city = baselines::make_city(10'000, 1);
    const std::size_t middle = city.blocks.size() / 2;
    BoxD& box = city.boxes[city.first[middle]];
    if (size > 0) box = {Vec3d(-size, -size, 0), Vec3d(size, size, 1)};
    city.blocks[middle].box = merge(city.blocks[middle].box, box);
    city.blocks[middle].sphere = enclosing_sphere(city.blocks[middle].box);
    const City small = baselines::make_city(10'000, 1);
    const Scene s = make_scene(std::move(city));
    Answer answer(s.tree);
    std::uint64_t taken = 0, truly = 0, lost = 0;
    for (int i = 0; i < 60; ++i) {
      const View view = baselines::flight(small, 1e30, i / 59.0);
      cull(s.tree, planes_of(s, view), answer);
      const auto seen = seen_objects(s, answer), exact = exactly_visible(view, s.boxes);
      for (std::size_t k = 0; k < seen.size(); ++k) lost += exact[k] && !seen[k] ? 1U : 0U;
      taken += count(seen);
      truly += count(exact);
    }
    std::cout << "an object of " << size << " m: accepted/exact "
              << static_cast<double>(taken) / static_cast<double>(truly) << ", root's step " << s.tree.nodes[0].step
              << " m\n";
    CHECK(lost == 0);
  }
}

}  // namespace
}  // namespace manzana::culling::test
