#include "culling/baselines/linear.h"
#include "culling/baselines/narrowed.h"
#include "culling/baselines/pushed_planes.h"
#include "culling/baselines/run_list.h"

namespace manzana::baselines {
namespace {

class Linear : public Peer {
 public:
  explicit Linear(const City& city) : Linear(narrowed(city)) {}

  void query(const culling::FrustumD& frustum, Answer& answer) override {
    const PushedPlanes planes = push_out(narrow(frustum, origin_), reach_);
    const auto count = static_cast<std::uint32_t>(boxes_.size());
    answer.runs.clear();
    for (std::uint32_t i = 0; i < count; ++i)
      if (seen(planes, boxes_[i])) append(answer.runs, i, i + 1);
  }

  std::size_t bytes() const override { return boxes_.size() * sizeof(Corners); }

 private:
  explicit Linear(const Narrowed& city) : origin_(city.origin), reach_(reach_of(city.boxes)) {
    for (const culling::Box& box : city.boxes) boxes_.push_back(to_corners(box));
  }

  static bool seen(const PushedPlanes& planes, const Corners& box) {
    for (const PushedPlane& plane : planes.all())
      if (plane.is_beyond(box)) return false;
    return true;
  }

  Vec3d origin_;
  Vec3 reach_;
  std::vector<Corners> boxes_;
};

}  // namespace

std::unique_ptr<Peer> make_linear(const City& city) { return std::make_unique<Linear>(city); }

}  // namespace manzana::baselines
