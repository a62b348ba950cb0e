#pragma once
/// A tree under edits, beside a plain list of what must be in it; and what holds for every tree that was edited, by
/// brute force over all that lies below each lane.
#include "culling/bqr_edit.h"
#include "tests/culling/scene.h"
#include "tests/culling/tree_checks.h"

namespace manzana::culling::test {

/// What is inserted at once.
struct NewBlock {
  BlockVolume volume;
  std::vector<BoxD> boxes;
  std::vector<ClassMask> classes;
  NewObjects objects() const { return {boxes, classes}; }
};

struct EditedCity {
  /// Objects are rows [first, last) of the lists below.
  struct Block {
    BlockVolume volume;
    std::uint32_t first = 0, last = 0;
    bool there = false;
  };
  BqrTree tree;
  std::vector<Block> blocks;       ///< a row a block of the tree
  std::vector<BoxD> boxes;         ///< a row an object, those that are gone too, as in tree.object_order
  std::vector<ClassMask> classes;  ///< the same
  std::vector<bool> there;         ///< the same

  void insert(const NewBlock& block) {
    REQUIRE(insert_block(tree, block.volume, block.objects()) == blocks.size());
    blocks.emplace_back();
    append(static_cast<std::uint32_t>(blocks.size() - 1), block);
  }
  void remove(std::uint32_t block) {
    remove_block(tree, block);
    forget(block);
  }
  void change(std::uint32_t block, const NewBlock& by) {
    change_block(tree, block, by.volume, by.objects());
    forget(block);
    append(block, by);
  }
  /// As many objects as before, in the same room.
  void move(std::uint32_t block, const NewBlock& by) {
    const std::size_t objects = tree.objects(), packets = tree.packets.size();
    change_block(tree, block, by.volume, by.objects(), remove_block(tree, block));
    REQUIRE((tree.objects() == objects && tree.packets.size() == packets));
    Block& b = blocks[block];
    b.volume = by.volume;
    std::copy(by.boxes.begin(), by.boxes.end(), boxes.begin() + b.first);
    std::fill(classes.begin() + b.first, classes.begin() + b.last, kAllClasses);
    std::copy(by.classes.begin(), by.classes.end(), classes.begin() + b.first);
  }

  std::vector<std::uint32_t> living() const {
    std::vector<std::uint32_t> all;
    for (std::uint32_t b = 0; b < blocks.size(); ++b)
      if (blocks[b].there) all.push_back(b);
    return all;
  }

 private:
  void append(std::uint32_t block, const NewBlock& by) {
    const auto first = static_cast<std::uint32_t>(boxes.size());
    blocks[block] = {by.volume, first, first + static_cast<std::uint32_t>(by.boxes.size()), true};
    boxes.insert(boxes.end(), by.boxes.begin(), by.boxes.end());
    classes.insert(classes.end(), by.classes.begin(), by.classes.end());
    classes.resize(boxes.size(), kAllClasses);
    there.resize(boxes.size(), true);
  }
  void forget(std::uint32_t block) {
    blocks[block].there = false;
    for (std::uint32_t i = blocks[block].first; i < blocks[block].last; ++i) there[i] = false;
  }
};

inline EditedCity edited(const City& city, const std::vector<ClassMask>& classes = {}) {
  EditedCity e;
  e.tree = build_bqr_tree(city.blocks, {city.first, city.boxes, classes});
  for (const std::uint32_t row : e.tree.order)
    e.blocks.push_back({city.blocks[row], city.first[row], city.first[row + 1], true});
  e.boxes = city.boxes;
  e.classes = classes;
  e.classes.resize(e.boxes.size(), kAllClasses);
  e.there.assign(e.boxes.size(), true);
  return e;
}

/// A tree built anew from what is there.
inline BqrTree built_anew(const EditedCity& e) {
  Input in;
  for (const std::uint32_t b : e.living()) {
    const EditedCity::Block& block = e.blocks[b];
    in.blocks.push_back(block.volume);
    in.boxes.insert(in.boxes.end(), e.boxes.begin() + block.first, e.boxes.begin() + block.last);
    in.first.push_back(static_cast<std::uint32_t>(in.boxes.size()));
  }
  return build_bqr_tree(in.blocks, in.objects());
}

class EditChecks {
 public:
  explicit EditChecks(const EditedCity& e) : e_(e), tree_(e.tree), volumes_(e.tree), found_(e.blocks.size()) {}

  void run() {
    check_rows();
    if (!tree_.nodes.empty()) {
      REQUIRE(tree_.nodes.at(tree_.root).parent == tree_.root);
      check_node(tree_.root);
    }
    for (std::uint32_t b = 0; b < found_.size(); ++b) REQUIRE(found_[b] == e_.blocks[b].there);
  }

 private:
  using Blocks = std::vector<std::uint32_t>;

  void check_rows() const {
    REQUIRE(tree_.blocks() == e_.blocks.size());
    REQUIRE(tree_.place.size() == e_.blocks.size());
    REQUIRE(tree_.objects() == e_.boxes.size());
    if (!tree_.classes.empty()) REQUIRE(tree_.classes.size() == tree_.objects() + kPacket);
    check_permutation(tree_.order);
    check_permutation(tree_.object_order);
    for (std::uint32_t b = 0; b < tree_.blocks(); ++b) {
      const ObjectRun run = tree_.block_objects[b];
      const EditedCity::Block& block = e_.blocks[b];
      REQUIRE(run.last - run.first == (block.there ? block.last - block.first : 0));
      for (std::uint32_t i = run.first; i < run.last; ++i) {
        REQUIRE((tree_.object_order[i] >= block.first && tree_.object_order[i] < block.last));
        if (!tree_.classes.empty()) REQUIRE(tree_.classes[i] == e_.classes[tree_.object_order[i]]);
      }
    }
  }

  /// The blocks below.
  Blocks check_node(std::uint32_t at) {
    const BqrNode& node = tree_.nodes.at(at);
    REQUIRE(((node.blocks | node.whole) & ~node.lanes) == 0);
    volumes_.check_lattice(lattice_of(node));
    Blocks all;
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      if ((node.lanes >> i & 1) == 0) continue;
      const Blocks below = (node.blocks >> i & 1) != 0 ? check_block(at, i) : check_child(at, i);
      for (const std::uint32_t b : below) volumes_.check_below(node, i, e_.blocks[b].volume);
      for (const std::uint32_t b : below) REQUIRE((classes_of(b) & ~node.classes[i]) == 0);
      if ((node.whole >> i & 1) != 0) check_whole(node, i, below);
      all.insert(all.end(), below.begin(), below.end());
    }
    check_ordered(node);
    return all;
  }

  Blocks check_child(std::uint32_t at, std::uint32_t i) {
    REQUIRE(tree_.nodes.at(tree_.nodes[at].child[i]).parent == at);
    return check_node(tree_.nodes[at].child[i]);
  }

  Blocks check_block(std::uint32_t at, std::uint32_t i) {
    const std::uint32_t block = tree_.nodes[at].first_block[i];
    REQUIRE(tree_.place.at(block) == at * kLanes + i);
    REQUIRE_FALSE(found_[block]);
    found_[block] = true;
    volumes_.check_packets(block, [&](std::uint32_t k) { return e_.boxes[tree_.object_order[k]]; });
    return {block};
  }

  ClassMask classes_of(std::uint32_t block) const {
    ClassMask all = 0;
    for (std::uint32_t i = e_.blocks[block].first; i < e_.blocks[block].last; ++i) all |= e_.classes[i];
    return all | (tree_.classes.empty() ? ClassMask{0} : e_.blocks[block].volume.classes);
  }

  /// The lane's runs are of these blocks, and of nothing else.
  void check_whole(const BqrNode& node, std::uint32_t i, Blocks below) const {
    std::sort(below.begin(), below.end());
    REQUIRE(node.last_block[i] - node.first_block[i] == below.size());
    std::uint32_t objects = node.first[i];
    for (std::size_t k = 0; k < below.size(); ++k) {
      REQUIRE(below[k] == node.first_block[i] + k);
      REQUIRE(tree_.block_objects[below[k]].first == objects);
      objects = tree_.block_objects[below[k]].last;
    }
    REQUIRE(objects == node.last[i]);
  }

  static void check_ordered(const BqrNode& node) {
    if (!node.ordered) return;
    for (std::uint32_t i = 0; i + 1 < kLanes; ++i) {
      if ((node.whole >> i & 3) != 3) continue;
      REQUIRE(node.last[i] == node.first[i + 1]);
      REQUIRE(node.last_block[i] == node.first_block[i + 1]);
    }
  }

  const EditedCity& e_;
  const BqrTree& tree_;
  VolumeChecks volumes_;
  std::vector<bool> found_;
};

}  // namespace manzana::culling::test
