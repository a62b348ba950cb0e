#include <algorithm>

#include "culling/answer_access.h"

namespace manzana::culling {

void Answer::reserve(const BqrTree& tree) {
  objects_.reserve(std::size_t{tree.objects()} + kLanes);  // a run holds an object; one is written ahead
  blocks_.reserve(tree.blocks());
  queue_.reserve(tree.nodes.size());
}

std::span<const ObjectRun> ordered(Answer& answer) {
  List<ObjectRun>& runs = Answer::Access::objects(answer);
  ObjectRun* const begin = runs.begin();
  ObjectRun* const end = begin + runs.items().size();
  std::sort(begin, end, [](const ObjectRun& a, const ObjectRun& b) { return a.first < b.first; });
  ObjectRun* to = begin;
  for (const ObjectRun* run = begin; run != end; ++run)
    if (to != begin && to[-1].last == run->first)
      to[-1].last = run->last;
    else
      *to++ = *run;
  runs.end_at(to);
  return runs.items();
}

std::uint64_t count(std::span<const ObjectRun> runs) {
  std::uint64_t sum = 0;
  for (const ObjectRun& run : runs) sum += run.last - run.first;
  return sum;
}

}  // namespace manzana::culling
