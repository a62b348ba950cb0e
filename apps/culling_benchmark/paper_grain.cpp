#include "apps/culling_benchmark/paper_grain.h"

#include <numeric>

#include "apps/culling_benchmark/paper.h"
#include "apps/culling_benchmark/paper_values.h"
#include "culling/baselines/cases.h"
#include "culling/baselines/vam.h"
#include "culling/cull.h"

namespace manzana::paper {
namespace {

using baselines::City;

/// A tree over a city's blocks, and how many triangles are in the blocks before each of its positions.
struct Pages {
  Pages(const City& city, std::span<const culling::BoxD> blocks, std::uint32_t page)
      : tree(baselines::build_vam_tree(blocks, page)) {
    for (const std::uint32_t block : tree.order) {
      const auto first = city.triangles.begin() + city.first[block],
                 last = city.triangles.begin() + city.first[block + 1];
      before.push_back(std::accumulate(first, last, before.back()));
    }
  }
  std::uint64_t sent(const culling::FrustumD& frustum, std::vector<culling::ObjectRun>& runs) const {
    cull(tree, baselines::BoxPlanes(frustum, tree.origin, tree.reach), baselines::VamGrain::pages, runs);
    std::uint64_t sum = 0;
    for (const culling::ObjectRun& run : runs) sum += before[run.last] - before[run.first];
    return sum;
  }
  baselines::VamTree tree;
  std::vector<std::uint64_t> before{0};
};

/// What the BqR-Tree finds: the blocks that are not outside.
std::uint64_t sent_by_bqr(const culling::BqrTree& tree, const City& city, const culling::FrustumD& frustum,
                          culling::Answer& answer) {
  cull(tree, make_planes(tree, frustum), answer, {.blocks = true});
  std::uint64_t sum = 0;
  for (const culling::LeafRun& run : answer.blocks())
    for (std::uint32_t leaf = run.first; leaf < run.last; ++leaf)
      for (std::uint32_t row = city.first[tree.order[leaf]]; row < city.first[tree.order[leaf] + 1]; ++row)
        sum += city.triangles[row];
  return sum;
}

GrainCounts count_grains(const City& city, int frames) {
  std::vector<culling::BoxD> boxes;
  for (const culling::BlockVolume& block : city.blocks) boxes.push_back(block.box);
  std::vector<Pages> pages;
  for (const std::uint32_t page : kPageBlocks) pages.emplace_back(city, boxes, page);
  const culling::BqrTree tree = culling::build_bqr_tree(city.blocks);
  culling::Answer answer(tree);
  GrainCounts counts;
  std::vector<culling::ObjectRun> runs;
  for (int i = 0; i < frames; ++i) {
    const auto frustum =
        culling::make_frustum(baselines::flight(city, std::numeric_limits<double>::infinity(), flight_at(i, frames)));
    counts.none += std::accumulate(city.triangles.begin(), city.triangles.end(), std::uint64_t{0});
    counts.bqr += sent_by_bqr(tree, city, frustum, answer);
    for (std::size_t p = 0; p < pages.size(); ++p) counts.vam[p] += pages[p].sent(frustum, runs);
  }
  return counts;
}

}  // namespace

GrainTable count_grains(int frames, std::uint64_t seed) {
  GrainTable table;
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = count_grains(baselines::make_city(*baselines::find_case(kPaperCities[i].name), seed), frames);
  return table;
}

}  // namespace manzana::paper
