#include "culling/baselines/boost_rtree.h"

#define BOOST_ALLOW_DEPRECATED_HEADERS  // its own headers include some
#include <hwy/highway.h>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include "culling/baselines/narrowed.h"
#include "culling/baselines/pushed_planes.h"
#include "culling/baselines/run_list.h"
#include "culling/baselines/view_box.h"

namespace manzana::baselines {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

using Point = bg::model::point<float, 3, bg::cs::cartesian>;
using BoostBox = bg::model::box<Point>;
using Value = std::pair<BoostBox, std::uint32_t>;

BoostBox to_boost(const culling::Box& box) {
  return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
}

/// Planes as a geometry: the convex body that they bound. In columns, so that a box is tested against all at once.
struct alignas(32) Body {
  using Column = std::array<float, 8>;
  Column x{}, y{}, z{}, outer;

  explicit Body(const PushedPlanes& planes) {
    outer.fill(1);  // a column without a plane has everything on its kept side
    for (std::size_t k = 0; k < planes.count; ++k) {
      x[k] = planes.planes[k].normal.x;
      y[k] = planes.planes[k].normal.y;
      z[k] = planes.planes[k].normal.z;
      outer[k] = planes.planes[k].outer;
    }
  }

  /// Not when all of the box lies beyond some plane: when even its farthest corner along the normal does.
  bool meets(const BoostBox& box) const {
    const hn::CappedTag<float, 8> d;
    for (std::size_t k = 0; k < x.size(); k += hn::Lanes(d)) {
      const auto reach = [&](const Column& n, float low, float high) {
        const auto along = hn::Load(d, &n[k]);
        return hn::Max(along * hn::Set(d, low), along * hn::Set(d, high));
      };
      const auto most = reach(x, bg::get<bg::min_corner, 0>(box), bg::get<bg::max_corner, 0>(box)) +
                        reach(y, bg::get<bg::min_corner, 1>(box), bg::get<bg::max_corner, 1>(box)) +
                        reach(z, bg::get<bg::min_corner, 2>(box), bg::get<bg::max_corner, 2>(box));
      if (!hn::AllFalse(d, hn::Lt(most + hn::Load(d, &outer[k]), hn::Zero(d)))) return false;
    }
    return true;
  }
};

/// Counts the bytes of a tree's nodes.
template <class T>
struct Counting {
  using value_type = T;
  std::size_t* sum;

  explicit Counting(std::size_t& total) : sum(&total) {}
  template <class U>
  Counting(const Counting<U>& other) : sum(other.sum) {}
  T* allocate(std::size_t n) {
    *sum += n * sizeof(T);
    return std::allocator<T>().allocate(n);
  }
  void deallocate(T* at, std::size_t n) {
    *sum -= n * sizeof(T);
    std::allocator<T>().deallocate(at, n);
  }
  friend bool operator==(const Counting& a, const Counting& b) { return a.sum == b.sum; }
};

}  // namespace
}  // namespace manzana::baselines

/// What intersects(Body) asks of a node's box, and of an object's.
namespace boost::geometry::index::detail {

using MeetsBody = predicates::spatial_predicate<manzana::baselines::Body, predicates::intersects_tag, false>;

template <>
struct predicate_check<MeetsBody, bounds_tag> {
  template <class V, class Box, class Strategy>
  static bool apply(const MeetsBody& predicate, const V&, const Box& box, const Strategy&) {
    return predicate.geometry.meets(box);
  }
};
template <>
struct predicate_check<MeetsBody, value_tag> : predicate_check<MeetsBody, bounds_tag> {};

}  // namespace boost::geometry::index::detail

namespace manzana::baselines {
namespace {

constexpr std::size_t kMostPerNode = 16;  // 6 to 32 make 5 % of difference

class BoostTree : public Peer {
 public:
  explicit BoostTree(const City& city) : BoostTree(city, narrowed(city)) {}
  std::size_t bytes() const override { return bytes_; }

 protected:
  Body body(const culling::FrustumD& frustum) const { return Body(push_out(narrow(frustum, origin_), reach_)); }
  const Vec3d& origin() const { return origin_; }

  template <class Predicates>
  void ask(const Predicates& predicates, Answer& answer) const {
    answer.runs.clear();
    tree_.query(predicates, boost::make_function_output_iterator([&](const Value& found) {
                  answer.runs.push_back({found.second, found.second + 1});
                }));
  }

 private:
  BoostTree(const City&, const Narrowed& all)
      : origin_(all.origin), reach_(reach_of(all.boxes)), tree_(values(all), {}, {}, {}, Counting<Value>(bytes_)) {}

  static std::vector<Value> values(const Narrowed& all) {
    std::vector<Value> rows;
    rows.reserve(all.boxes.size());
    for (const culling::Box& box : all.boxes) rows.emplace_back(to_boost(box), static_cast<std::uint32_t>(rows.size()));
    return rows;
  }

  Vec3d origin_;
  Vec3 reach_;
  std::size_t bytes_ = 0;  // before the tree, which counts into it to its end
  bgi::rtree<Value, bgi::quadratic<kMostPerNode>, bgi::indexable<Value>, bgi::equal_to<Value>, Counting<Value>> tree_;
};

class BoostFrustum : public BoostTree {
 public:
  using BoostTree::BoostTree;
  void query(const culling::FrustumD& frustum, Answer& answer) override { ask(bgi::intersects(body(frustum)), answer); }
};

class BoostBoxes : public BoostTree {
 public:
  explicit BoostBoxes(const City& city) : BoostTree(city), bounds_(city.bounds) {}
  void query(const culling::FrustumD& frustum, Answer& answer) override {
    answer.runs.clear();
    const culling::BoxD box = view_box(frustum, bounds_);
    if (box.empty()) return;
    const Body planes = body(frustum);
    const auto seen = [&](const Value& value) { return planes.meets(value.first); };
    ask(bgi::intersects(to_boost(narrow(box, origin()))) && bgi::satisfies(seen), answer);
  }

 private:
  culling::BoxD bounds_;
};

}  // namespace

std::unique_ptr<Peer> make_boost_frustum(const City& city) { return std::make_unique<BoostFrustum>(city); }

std::unique_ptr<Peer> make_boost_box(const City& city) { return std::make_unique<BoostBoxes>(city); }

}  // namespace manzana::baselines
