// What edits leave behind: as few objects taken, and as fast, as by a tree built anew.
#include <chrono>
#include <iostream>

#include "culling/bqr_edit.h"
#include "tests/culling/edited_city.h"

namespace manzana::culling::test {
namespace {

/// A city to which the blocks of another one come, for which its own go, or which take their places.
EditedCity redeveloped(const City& city, const City& other, int edits, std::uint64_t seed) {
  Random random(seed);
  EditedCity e = edited(city);
  const auto any_other = [&] {
    const std::size_t b = random.below(other.blocks.size());
    return NewBlock{
        other.blocks[b], {other.boxes.begin() + other.first[b], other.boxes.begin() + other.first[b + 1]}, {}};
  };
  for (int i = 0; i < edits; ++i) {
    const std::vector<std::uint32_t> living = e.living();
    const std::uint32_t block = living[random.below(living.size())];
    if (i % 3 == 0) e.insert(any_other());
    if (i % 3 == 1) e.remove(block);
    if (i % 3 == 2) e.change(block, any_other());
  }
  return e;
}

TEST_CASE("edits: after a thousand as few objects are taken as by a tree built anew") {
  const City city = baselines::make_city(10'000, 1);
  const EditedCity e = redeveloped(city, baselines::make_city(10'000, 2), 1000, 81);
  EditChecks(e).run();
  const BqrTree anew = built_anew(e);
  Answer answer;
  std::uint64_t of_edited = 0, of_anew = 0;
  for (int i = 0; i < 60; ++i) {
    const FrustumD frustum = make_frustum(baselines::flight(city, i % 2 == 0 ? 1e30 : 900, i / 59.0));
    cull(e.tree, make_planes(e.tree, frustum), answer);
    of_edited += count(answer.objects());
    cull(anew, make_planes(anew, frustum), answer);
    of_anew += count(answer.objects());
  }
  const double ratio = static_cast<double>(of_edited) / static_cast<double>(of_anew);
  std::cout << "seed 81: accepted after 1000 edits / built anew " << ratio << '\n';
  CHECK(of_anew > 10'000);
  CHECK(ratio == Approx(1).epsilon(0.01));
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Microseconds a query, over a flight.
double flown(const BqrTree& tree, const City& city, Answer& answer) {
  constexpr int kFrames = 200;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < kFrames; ++i)
    cull(tree, make_planes(tree, make_frustum(baselines::flight(city, i % 2 == 0 ? 1e30 : 900, i / (kFrames - 1.0)))),
         answer);
  return seconds_since(start) / kFrames * 1e6;
}

TEST_CASE("time of a query after edits", "[.bench]") {
  for (const int edits : {100, 1000, 10'000}) {
    const City city = baselines::make_city(10'000, 1);
    const EditedCity e = redeveloped(city, baselines::make_city(10'000, 2), edits, 82);
    const BqrTree anew = built_anew(e);
    Answer a(e.tree), b(anew);
    std::vector<double> of_edited, of_anew;
    for (int i = 0; i < 101; ++i) {
      of_edited.push_back(flown(e.tree, city, a));
      of_anew.push_back(flown(anew, city, b));
    }
    std::cout << "seed 82, " << edits << " edits: " << median(of_edited) << " us a query, built anew "
              << median(of_anew) << " us, ratio " << median(of_edited) / median(of_anew) << '\n';
  }
}

TEST_CASE("time of an insertion", "[.bench]") {
  const City other = baselines::make_city(100'000, 2);
  for (const std::uint32_t objects : {10'000U, 100'000U, 1'000'000U}) {
    BqrTree tree = edited(baselines::make_city(objects, 1)).tree;
    Random random(83);
    std::vector<double> each;
    for (int i = 0; i < 1000; ++i) {
      const std::size_t b = random.below(other.blocks.size());
      const auto boxes = std::span(other.boxes).subspan(other.first[b], other.first[b + 1] - other.first[b]);
      const auto start = std::chrono::steady_clock::now();
      insert_block(tree, other.blocks[b], {boxes, {}});
      each.push_back(seconds_since(start) * 1e6);
    }
    double sum = 0;
    for (const double t : each) sum += t;
    std::cout << "seed 83, an insertion into " << objects << " objects: median " << median(each) << " us, mean "
              << sum / 1000 << " us, longest " << *std::max_element(each.begin(), each.end()) << " us\n";
  }
}

}  // namespace
}  // namespace manzana::culling::test
