#include "culling/baselines/osg_peers.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <osg/CullStack>
#include <osg/DisplaySettings>
#include <osg/Geode>
#include <osgUtil/CullVisitor>

#include "culling/baselines/run_list.h"

namespace manzana::baselines {
namespace {

using culling::BoxD;
using culling::FrustumD;

constexpr std::uint32_t kMostPerLeaf = 32;  // from 8 to 64 the fastest, by a little
constexpr int kMostDepth = 30;

osg::Vec3f to_osg(const Vec3& v) { return {v.x, v.y, v.z}; }
osg::Vec3d to_osg(const Vec3d& v) { return {v.x, v.y, v.z}; }

/// An object: its bounds, and nothing to draw.
struct Shape : osg::Drawable {
  Shape(const osg::BoundingBox& box, std::uint32_t at) : position(at) { setInitialBound(box); }
  const std::uint32_t position;
};

/// A cell of the quadtree; its objects are at [first, last).
struct Cell : osg::Geode {
  std::uint32_t first = 0, last = 0;
  bool leaf = false;
};

struct OsgScene {
  Vec3d origin{0, 0, 0};  ///< in L; all of OSG's coordinates are relative to it
  osg::ref_ptr<Cell> root;
  std::vector<std::uint32_t> order;
  std::size_t bytes = 0;
};

std::size_t heap() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

class Builder {
 public:
  explicit Builder(const City& city) : city_(city) {}

  OsgScene run() {
    OsgScene scene;
    if (city_.objects() == 0) return scene;
    // Drawables hold a place for each context that there may be, 32 by default: they are half as large with one.
    osg::DisplaySettings::instance()->setMaxNumberOfGraphicsContexts(1);
    scene.origin = origin_;
    order_.resize(city_.objects());
    std::iota(order_.begin(), order_.end(), 0U);
    const Vec2d low(city_.bounds.min), size(city_.bounds.max - city_.bounds.min);
    const std::size_t before = heap();
    scene.root = cell(0, city_.objects(), {low, std::max(size.x, size.y)}, 0);
    scene.root->getBound();  // of everything below as well
    scene.bytes = heap() - before;
    scene.order = std::move(order_);
    return scene;
  }

 private:
  struct Square {
    Vec2d low;
    double side;
  };

  Vec2d middle(std::uint32_t row) const { return Vec2d(center(city_.boxes[row])); }

  osg::ref_ptr<Cell> cell(std::uint32_t first, std::uint32_t last, const Square& square, int depth) {
    osg::ref_ptr<Cell> made = new Cell;
    made->first = first;
    made->last = last;
    made->leaf = last - first <= kMostPerLeaf || depth == kMostDepth;
    if (made->leaf)
      for (std::uint32_t at = first; at < last; ++at) made->addDrawable(new Shape(bounds(order_[at]), at));
    else
      quarter(*made, square, depth);
    return made;
  }

  void quarter(Cell& parent, const Square& square, int depth) {
    const double half = square.side / 2;
    const Vec2d cut = square.low + half;
    const auto split = [&](std::uint32_t from, std::uint32_t to, int axis) {
      const auto below = [&](std::uint32_t row) { return middle(row)[axis] < cut[axis]; };
      const auto at = std::partition(order_.begin() + from, order_.begin() + to, below);
      return static_cast<std::uint32_t>(at - order_.begin());
    };
    const std::uint32_t y = split(parent.first, parent.last, 1);
    const std::array ends{parent.first, split(parent.first, y, 0), y, split(y, parent.last, 0), parent.last};
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2d low = square.low + half * Vec2d(i % 2, i / 2);
      if (ends[i] < ends[i + 1]) parent.addChild(cell(ends[i], ends[i + 1], {low, half}, depth + 1));
    }
  }

  osg::BoundingBox bounds(std::uint32_t row) const {
    const BoxD& box = city_.boxes[row];
    const culling::Box narrowed = narrow(BoxD{box.min - margin_, box.max + margin_}, origin_);
    return {to_osg(narrowed.min), to_osg(narrowed.max)};
  }

  const City& city_;
  const Vec3d origin_ = glm::round(center(city_.bounds));
  /// More than OSG's float arithmetic loses from a sphere to its parent's, up to the root, and in its tests.
  const double margin_ = 1e-6 + 32.0 / (1 << 24) * glm::length(city_.bounds.max - city_.bounds.min);
  std::vector<std::uint32_t> order_;
};

osg::Polytope polytope(const FrustumD& frustum, const Vec3d& origin) {
  osg::Polytope::PlaneList planes;
  for (std::size_t k = 0; k < static_cast<std::size_t>(frustum.count); ++k) {
    const auto& [normal, offset] = frustum.planes[k];
    planes.emplace_back(to_osg(normal), offset + glm::dot(normal, origin - frustum.eye));
  }
  return osg::Polytope(planes);
}

/// For the depths that CullVisitor notes beside each drawable: looks along the near plane's normal, any side up.
osg::RefMatrix* view_matrix(const FrustumD& frustum, const Vec3d& origin) {
  const osg::Vec3d eye = to_osg(frustum.eye - origin);
  const Vec3d& forward = frustum.planes[culling::kNear].normal;
  const osg::Vec3d up = std::abs(forward.z) < 0.7 ? osg::Vec3d(0, 0, 1) : osg::Vec3d(1, 0, 0);
  return new osg::RefMatrix(osg::Matrixd::lookAt(eye, eye + to_osg(forward), up));
}

class OsgPeer : public Peer {
 public:
  explicit OsgPeer(const City& city) : scene_(Builder(city).run()) {}
  std::span<const std::uint32_t> order() const override { return scene_.order; }
  std::size_t bytes() const override { return scene_.bytes; }

 protected:
  static void set_up(osg::CullSettings& settings) {
    settings.setCullingMode(osg::CullSettings::VIEW_FRUSTUM_CULLING);
    settings.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  }

  /// Calls walk() with the frustum on top of the stack.
  template <class Walk>
  void with_frustum(osg::CullStack& stack, const FrustumD& frustum, Walk&& walk) const {
    stack.pushViewport(viewport_.get());
    stack.pushProjectionMatrix(projection_.get());
    stack.pushModelViewMatrix(view_matrix(frustum, scene_.origin), osg::Transform::ABSOLUTE_RF);
    osg::Polytope planes = polytope(frustum, scene_.origin);
    stack.getCurrentCullingSet().setFrustum(planes);
    walk();
    stack.popModelViewMatrix();
    stack.popProjectionMatrix();
    stack.popViewport();
  }

  const OsgScene& scene() const { return scene_; }

 private:
  OsgScene scene_;
  osg::ref_ptr<osg::Viewport> viewport_ = new osg::Viewport(0, 0, 1920, 1080);
  osg::ref_ptr<osg::RefMatrix> projection_ = new osg::RefMatrix(osg::Matrixd::perspective(60, 16.0 / 9, 0.1, 1e4));
};

class Visitor : public OsgPeer {
 public:
  explicit Visitor(const City& city) : OsgPeer(city) { set_up(*visitor_); }

  void query(const FrustumD& frustum, Answer& answer) override {
    answer.runs.clear();
    if (!scene().root) return;
    visitor_->reset();
    leaves_->clean();
    stage_->reset();
    visitor_->setStateGraph(leaves_.get());
    visitor_->setRenderStage(stage_.get());
    with_frustum(*visitor_, frustum, [&] { scene().root->accept(*visitor_); });
    for (const auto& leaf : leaves_->_leaves) {
      const std::uint32_t at = static_cast<const Shape*>(leaf->getDrawable())->position;
      append(answer.runs, at, at + 1);
    }
  }

 private:
  osg::ref_ptr<osgUtil::CullVisitor> visitor_ = new osgUtil::CullVisitor;
  osg::ref_ptr<osgUtil::StateGraph> leaves_ = new osgUtil::StateGraph;
  osg::ref_ptr<osgUtil::RenderStage> stage_ = new osgUtil::RenderStage;
};

class Stack : public OsgPeer {
 public:
  explicit Stack(const City& city) : OsgPeer(city) { set_up(stack_); }

  void query(const FrustumD& frustum, Answer& answer) override {
    answer.runs.clear();
    if (!scene().root) return;
    stack_.reset();
    with_frustum(stack_, frustum, [&] { visit(*scene().root, answer); });
  }

 private:
  void visit(const Cell& cell, Answer& answer) {
    if (stack_.isCulled(cell)) return;
    if (stack_.getCurrentCullingSet().getFrustum().getResultMask() == 0)
      return append(answer.runs, cell.first, cell.last);
    stack_.pushCurrentMask();
    for (unsigned i = 0; i < cell.getNumChildren(); ++i) {
      const osg::Node* child = cell.getChild(i);
      if (!cell.leaf)
        visit(static_cast<const Cell&>(*child), answer);
      else if (!stack_.isCulled(static_cast<const Shape*>(child)->getBoundingBox()))
        append(answer.runs, cell.first + i, cell.first + i + 1);
    }
    stack_.popCurrentMask();
  }

  osg::CullStack stack_;
};

}  // namespace

std::unique_ptr<Peer> make_osg(const City& city) { return std::make_unique<Visitor>(city); }

std::unique_ptr<Peer> make_osg_stack(const City& city) { return std::make_unique<Stack>(city); }

}  // namespace manzana::baselines
