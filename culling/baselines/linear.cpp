#include "culling/baselines/linear.h"
#include "culling/baselines/narrowed.h"
#include "culling/baselines/pushed_planes.h"
#include "culling/baselines/run_list.h"

namespace manzana::baselines {
namespace {

using culling::Box;

/// The corner farthest along the plane's normal.
Vec3 farthest(const Box& box, const Vec3& n) {
  return {n.x >= 0 ? box.max.x : box.min.x, n.y >= 0 ? box.max.y : box.min.y, n.z >= 0 ? box.max.z : box.min.z};
}

bool outside(const Box& box, const PushedPlane& plane) {
  return glm::dot(plane.normal, farthest(box, plane.normal)) + plane.outer < 0;
}

class Linear : public Peer {
 public:
  explicit Linear(const City& city) : city_(narrowed(city)), reach_(reach_of(city_.boxes)) {}

  void query(const culling::FrustumD& frustum, Answer& answer) override {
    const PushedPlanes planes = push_out(narrow(frustum, city_.origin), reach_);
    answer.runs.clear();
    for (std::uint32_t i = 0; i < city_.boxes.size(); ++i)
      if (seen(planes, city_.boxes[i])) append(answer.runs, i, i + 1);
  }

  std::size_t bytes() const override { return city_.boxes.size() * sizeof(Box); }

 private:
  static bool seen(const PushedPlanes& planes, const Box& box) {
    for (const PushedPlane& plane : planes.all())
      if (outside(box, plane)) return false;
    return true;
  }

  Narrowed city_;
  Vec3 reach_;
};

}  // namespace

std::unique_ptr<Peer> make_linear(const City& city) { return std::make_unique<Linear>(city); }

}  // namespace manzana::baselines
