#include "culling/baselines/bqr.h"
#include "culling/cull.h"

namespace manzana::baselines {
namespace {

using namespace culling;

class Bqr : public Peer {
 public:
  explicit Bqr(const City& city) : tree_(build_bqr_tree(city.blocks, {city.first, city.boxes, {}})), answer_(tree_) {}

  void query(const FrustumD& frustum, Answer& answer) override {
    cull(tree_, make_planes(tree_, frustum), answer_);
    answer.runs.assign(answer_.objects().begin(), answer_.objects().end());
  }

  std::span<const std::uint32_t> order() const override { return tree_.object_order; }
  std::size_t bytes() const override { return query_bytes(tree_); }

 private:
  BqrTree tree_;
  culling::Answer answer_;
};

}  // namespace

std::unique_ptr<Peer> make_bqr(const City& city) { return std::make_unique<Bqr>(city); }

}  // namespace manzana::baselines
