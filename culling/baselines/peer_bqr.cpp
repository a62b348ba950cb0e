#include "culling/baselines/block_rows.h"
#include "culling/baselines/bqr.h"

namespace manzana::baselines {
namespace {

using namespace culling;

class Bqr : public Peer {
 public:
  explicit Bqr(const City& city) : tree_(build_bqr_tree(city.blocks)) {
    BlockRows rows = rows_of(city, tree_.order);
    order_ = std::move(rows.rows);
    table_ = build_object_table(tree_.origin, boxes_of(city, order_), std::move(rows.first));
    runs_.reserve(tree_.order.size());
  }

  void query(const FrustumD& frustum, Answer& answer) override {
    const Frustum near = narrow(frustum, tree_.origin);
    runs_.clear();
    cull(tree_, near, [&](const LeafRun& run) {
      if (run.where == Overlap::crosses) prefetch(table_, run);
      runs_.push_back(run);
    });
    cull_objects(table_, runs_, near, answer.runs);
  }

  std::span<const std::uint32_t> order() const override { return order_; }

  std::size_t bytes() const override {
    return tree_.nodes.size() * sizeof(BqrNode) + tree_.leaf_boxes.size() * sizeof(Box) +
           table_.first.size() * sizeof(std::uint32_t) + table_.packets.size() * sizeof(ObjectPacket);
  }

 private:
  BqrTree tree_;
  std::vector<std::uint32_t> order_;
  ObjectTable table_;
  std::vector<LeafRun> runs_;
};

}  // namespace

std::unique_ptr<Peer> make_bqr(const City& city) { return std::make_unique<Bqr>(city); }

}  // namespace manzana::baselines
