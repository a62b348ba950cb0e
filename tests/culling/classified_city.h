#pragma once
/// A city of many classes, and any view and filter of it.
#include "tests/culling/polytope.h"
#include "tests/culling/scene.h"

namespace manzana::culling::test {

/// 3000 objects of one to three classes, most of a common one; some blocks hold cars of a class of their own.
inline Scene classified(Random& random) {
  City city = baselines::make_city(3000, 81);
  std::vector<ClassMask> classes;
  for (std::uint32_t i = 0; i < city.objects(); ++i)
    classes.push_back(
        static_cast<ClassMask>(1U << random.below(2) | (random.chance(0.2) ? 1U << random.below(15) : 0U)));
  for (std::size_t b = 0; b < city.blocks.size(); ++b) {
    city.blocks[b].classes = random.chance(0.2) ? 0x8000 : 0;
    if (random.chance(0.4))  // whole blocks of one class, so that whole lanes can be taken or left
      std::fill(classes.begin() + city.first[b], classes.begin() + city.first[b + 1], ClassMask{4});
  }
  return make_scene(std::move(city), std::move(classes));
}

inline View any_view(const Scene& s, Random& random) {
  if (random.chance(0.5)) return baselines::flight(s.city, random.scale(50, 1e5), random.unit());
  return random_view(random, random.direction() * random.in(0, 1000));
}

inline ClassMask any_mask(Random& random) {
  if (random.chance(0.1)) return kAllClasses;
  if (random.chance(0.3)) return static_cast<ClassMask>(1U << random.below(16));
  return static_cast<ClassMask>(random.below(0x10000));
}

}  // namespace manzana::culling::test
