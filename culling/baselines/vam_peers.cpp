#include "culling/baselines/vam_peers.h"

#include "culling/baselines/block_rows.h"
#include "culling/baselines/vam.h"

namespace manzana::baselines {
namespace {

constexpr std::uint32_t kObjectsPerPage = 16;

void query_tree(const VamTree& tree, const culling::FrustumD& frustum, VamGrain grain, Answer& answer) {
  cull(tree, BoxPlanes(frustum, tree.origin, tree.reach), grain, answer.runs);
}

class VamObjects : public Peer {
 public:
  explicit VamObjects(const City& city) : tree_(build_vam_tree(city.boxes, kObjectsPerPage)) {}

  void query(const culling::FrustumD& frustum, Answer& answer) override {
    query_tree(tree_, frustum, VamGrain::items, answer);
  }
  std::span<const std::uint32_t> order() const override { return tree_.order; }
  std::size_t bytes() const override { return baselines::bytes(tree_); }

 private:
  VamTree tree_;
};

std::vector<culling::BoxD> block_boxes(const City& city) {
  std::vector<culling::BoxD> boxes;
  boxes.reserve(city.blocks.size());
  for (const culling::BlockVolume& block : city.blocks) boxes.push_back(block.box);
  return boxes;
}

class VamBlocks : public Peer {
 public:
  VamBlocks(const City& city, std::uint32_t page)
      : tree_(build_vam_tree(block_boxes(city), page)), objects_(rows_of(city, tree_.order)) {}

  void query(const culling::FrustumD& frustum, Answer& answer) override {
    query_tree(tree_, frustum, VamGrain::pages, answer);
    for (culling::ObjectRun& run : answer.runs) run = {objects_.first[run.first], objects_.first[run.last]};
  }
  std::span<const std::uint32_t> order() const override { return objects_.rows; }
  std::size_t bytes() const override { return baselines::bytes(tree_) + objects_.first.size() * sizeof(std::uint32_t); }

 private:
  VamTree tree_;  ///< of blocks
  BlockRows objects_;
};

}  // namespace

std::unique_ptr<Peer> make_vam16(const City& city) { return std::make_unique<VamObjects>(city); }

template <std::uint32_t blocks>
std::unique_ptr<Peer> make_vam_blocks(const City& city) {
  return std::make_unique<VamBlocks>(city, blocks);
}

template std::unique_ptr<Peer> make_vam_blocks<1>(const City&);
template std::unique_ptr<Peer> make_vam_blocks<2>(const City&);
template std::unique_ptr<Peer> make_vam_blocks<4>(const City&);
template std::unique_ptr<Peer> make_vam_blocks<6>(const City&);
template std::unique_ptr<Peer> make_vam_blocks<8>(const City&);

}  // namespace manzana::baselines
