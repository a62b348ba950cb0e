#include <array>
#include <numeric>
#include <utility>

#include "culling/answer_access.h"

namespace manzana::culling {
namespace {

/// By one byte of the first object; equal ones stay as they are.
void sort_by_byte(std::span<const ObjectRun> runs, unsigned shift, List<ObjectRun>& to) {
  std::array<std::uint32_t, 256> at{};
  for (const ObjectRun& run : runs) ++at[run.first >> shift & 255U];
  std::exclusive_scan(at.begin(), at.end(), at.begin(), 0U);
  for (const ObjectRun& run : runs) to.begin()[at[run.first >> shift & 255U]++] = run;
  to.end_at(to.begin() + runs.size());
}

}  // namespace

void Answer::reserve(const BqrTree& tree) {
  objects_.reserve(std::size_t{tree.objects()} + kLanes);  // a run holds an object; one is written ahead
  sorted_.reserve(std::size_t{tree.objects()} + kLanes);
  blocks_.reserve(tree.blocks());
  queue_.reserve(tree.nodes.size());
}

std::span<const ObjectRun> ordered(Answer& answer) {
  List<ObjectRun>& runs = Answer::Access::objects(answer);
  List<ObjectRun>& sorted = Answer::Access::sorted(answer);
  std::uint32_t bits = 0;
  for (const ObjectRun& run : runs.items()) bits |= run.first;
  for (unsigned shift = 0; shift < 32 && bits >> shift != 0; shift += 8) {
    sort_by_byte(runs.items(), shift, sorted);
    std::swap(runs, sorted);
  }
  ObjectRun* to = runs.begin();
  for (const ObjectRun& run : runs.items())
    if (to != runs.begin() && to[-1].last == run.first)
      to[-1].last = run.last;
    else
      *to++ = run;
  runs.end_at(to);
  return runs.items();
}

std::uint64_t count(std::span<const ObjectRun> runs) {
  std::uint64_t sum = 0;
  for (const ObjectRun& run : runs) sum += run.last - run.first;
  return sum;
}

}  // namespace manzana::culling
