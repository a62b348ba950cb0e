#include "scenegraph/layer_table.h"

#include "culling/bqr_build.h"

namespace manzana {
namespace {

/// Objects block by block, as the tree's builder takes them; within a block in the order of their numbers.
struct ByBlock {
  std::vector<std::uint32_t> first, numbers;
  std::vector<culling::BoxD> boxes;
  std::vector<culling::ClassMask> classes;
};

ByBlock sort_by_block(const SceneObjects& objects, std::size_t blocks) {
  ByBlock sorted;
  sorted.first.assign(blocks + 1, 0);
  for (const std::uint32_t block : objects.blocks) ++sorted.first[block + 1];
  for (std::size_t b = 0; b < blocks; ++b) sorted.first[b + 1] += sorted.first[b];
  sorted.numbers.resize(objects.blocks.size());
  std::vector<std::uint32_t> next = sorted.first;
  for (std::uint32_t i = 0; i < objects.blocks.size(); ++i) sorted.numbers[next[objects.blocks[i]]++] = i;
  for (const std::uint32_t number : sorted.numbers) {
    sorted.boxes.push_back(objects.boxes[number]);
    sorted.classes.push_back(objects.classes[number]);
  }
  return sorted;
}

}  // namespace

std::uint64_t count(const LayerTable& table, std::span<const culling::ObjectRun> objects) {
  std::uint64_t sum = 0;
  for (const culling::ObjectRun& run : objects) sum += table.rows(run).last - table.rows(run).first;
  return sum;
}

void SceneObjects::add(std::uint32_t block, const culling::BoxD& box, culling::ClassMask kind) {
  blocks.push_back(block);
  boxes.push_back(box);
  classes.push_back(kind);
}

OrderedTree build_tree(std::span<const culling::BlockVolume> blocks, const SceneObjects& objects) {
  const ByBlock sorted = sort_by_block(objects, blocks.size());
  OrderedTree built{culling::build_bqr_tree(blocks, {sorted.first, sorted.boxes, sorted.classes},
                                            {.order = culling::ObjectOrder::given}),
                    {}};
  built.numbers.reserve(sorted.numbers.size());
  for (const std::uint32_t row : built.tree.object_order) built.numbers.push_back(sorted.numbers[row]);
  return built;
}

std::vector<std::uint32_t> numbers_of(const OrderedTree& built, culling::ClassMask kinds) {
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = 0; i < built.numbers.size(); ++i)
    if ((built.tree.classes[i] & kinds) != 0) numbers.push_back(built.numbers[i]);
  return numbers;
}

LayerTable make_table(const OrderedTree& built, const SceneObjects& objects, culling::ClassMask kinds) {
  LayerTable table;
  table.row_first.reserve(built.numbers.size() + 1);
  for (std::size_t i = 0; i < built.numbers.size(); ++i) {
    table.row_first.push_back(table.size());
    if ((built.tree.classes[i] & kinds) != 0)
      table.boxes.push_back(narrow(objects.boxes[built.numbers[i]], built.tree.origin));
  }
  table.row_first.push_back(table.size());
  return table;
}

}  // namespace manzana
