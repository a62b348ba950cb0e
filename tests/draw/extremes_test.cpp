// Trees where numbers are at their ends: what reaches the GPU is finite, both processors agree to the bit, and what
// must be seen is.
#include <glad/gl.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <functional>

#include "foliage/far_pack.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/ldm_sampler.h"
#include "foliage/make_ldm.h"
#include "gl/context.h"
#include "gl/error_log.h"
#include "scenegraph/draw/frame_data.h"
#include "scenegraph/draw/tree_layer.h"
#include "scenegraph/tree_sites.h"
#include "tests/draw/extreme_plants.h"
#include "tests/draw/hand_scene.h"

namespace manzana::draw {
namespace {

using foliage::Law;
using foliage::PreparedPlant;

constexpr Size kSize{160, 120};
constexpr float kHeight = 11, kSpacing = 14;

template <class T>
std::vector<T> read(const gl::Buffer& buffer, std::size_t n) {
  std::vector<T> values(n);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(n * sizeof(T)), values.data());
  return values;
}

bool finite(const Vec4& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}
bool finite(const foliage::TreeRecord& t) {
  return finite(t.row_x) && finite(t.row_y) && finite(t.row_z) && std::isfinite(t.error2_from_1m);
}
bool finite(const foliage::Item& i) {
  return std::isfinite(i.edge) && std::isfinite(i.fade) && i.fade >= 1 && std::isfinite(i.scale);
}
bool finite(const foliage::LdmTree& t) {
  return finite(t.row_x) && finite(t.row_y) && finite(t.row_z) && finite(Vec4(t.to_eye, 0));
}
bool finite(const foliage::LdmItem& i) {
  return std::isfinite(i.low) && std::isfinite(i.high) && std::isfinite(i.grown) && i.low <= i.high;
}
bool finite(const foliage::GroveDrawer::Shown& s) {
  return std::isfinite(s.points.edge) && std::isfinite(s.points.fade) && std::isfinite(s.points.scale) &&
         std::isfinite(s.points.light);
}
template <class List>
bool all_finite(const List& list) {
  return std::all_of(list.begin(), list.end(), [](const auto& row) { return finite(row); });
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// A framebuffer of floats: what shaders put out as it is.
struct FloatTarget {
  gl::Texture colour, depth;
  gl::Framebuffer framebuffer;

  FloatTarget() {
    std::array<GLuint, 2> names{};
    glCreateTextures(GL_TEXTURE_2D, 2, names.data());
    colour = gl::Texture(names[0]), depth = gl::Texture(names[1]);
    glTextureStorage2D(names[0], 1, GL_RGBA32F, kSize.width, kSize.height);
    glTextureStorage2D(names[1], 1, GL_DEPTH_COMPONENT32F, kSize.width, kSize.height);
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    framebuffer = gl::Framebuffer(name);
    glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, names[0], 0);
    glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, names[1], 0);
  }
  void begin() const {
    const Vec4 nothing{0};
    glClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, &nothing.x);
    glClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &nothing.x);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.name());
    glViewport(0, 0, kSize.width, kSize.height);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
  }
  std::vector<Vec4> texels() const {
    std::vector<Vec4> all(static_cast<std::size_t>(kSize.width) * static_cast<std::size_t>(kSize.height));
    glGetTextureImage(colour.name(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(all.size() * sizeof(Vec4)), all.data());
    return all;
  }
};

/// Trees of some plants, seen as the product draws them: layer and picture checked each time.
class Trees {
 public:
  Trees(std::vector<PreparedPlant> plants, std::vector<TreeInstance> trees, const Vec3d& origin = Vec3d(0))
      : plants_(std::move(plants)),
        scene_(make_scene({block_of(std::move(trees), origin)})),
        layer_(scene_, plants_, limits_for(scene_, plants_, true)) {}
  ~Trees() { CHECK(errors_.messages().empty()); }

  /// What mosaics and groves need.
  void add_far() {
    for (std::uint32_t p = 0; p < plants_.size(); ++p) {
      add_pack(layer_.far, p,
               make_ldm_pack(ldm_ball(plants_[p]), foliage::kFarPack, foliage::LdmSampler(plants_[p], 1)));
    }
  }

  /// Pixels that show something, by each way of drawing them in turn: all the same things are checked of each.
  struct Seen {
    int full = 0, ours = 0, far = 0;
  };
  Seen look(const culling::View& view) {
    Seen seen;
    seen.full = draw(view, {.law = Law::full});
    seen.ours = draw(view, {});
    const TreeDetail far{.mosaics = true, .groves = true};
    draw(view, far);
    for (const GroveWanted& wanted : std::vector(layer_.groves.wanted))
      add_grove(layer_.groves, wanted, make_grove(plants_, *layer_.sites, wanted));
    seen.far = draw(view, far);
    return seen;
  }
  culling::View view(const Vec3d& eye, const Vec3d& forward, double fovy_deg = 60) const {
    return look_in(scene_.blocks[0], eye, forward, fovy_deg, static_cast<double>(kSize.width) / kSize.height);
  }

 private:
  static HandBlock block_of(std::vector<TreeInstance> trees, const Vec3d& origin) {
    HandBlock block;
    block.plan = Vec2d(origin);
    block.trees = std::move(trees);
    return block;
  }

  int draw(const culling::View& view, TreeDetail detail) {
    const Camera camera = camera_of(view);
    detail.error_at_1m = 0.85 / focal_px(camera, kSize.height);
    const VisibleSets sets = visible(scene_, view, Structure::none);
    const std::vector<Rows> rows{relative_to(view.eye, scene_.blocks[0])};
    DrawOptions options;
    options.layers.fog = false;
    const FrameData frame = make_frame(scene_.frame, camera, options, scene_.blocks[0]);
    stream_.begin(gl::StreamBuffer::padded(sizeof frame) + gl::StreamBuffer::padded(sizeof(Rows)) +
                  stream_bytes(layer_));
    const auto uniforms = stream_.take<FrameData>(1);
    *uniforms.items = frame;
    const auto blocks = stream_.take<Rows>(1);
    *blocks.items = rows[0];
    glBindBufferRange(GL_UNIFORM_BUFFER, 0, stream_.name(), uniforms.offset, sizeof frame);
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, foliage::kBlockRowsBinding, stream_.name(), blocks.offset,
                      sizeof(Rows));
    target_.begin();
    extract_trees(layer_, scene_.trees, sets.objects(), rows, detail, stream_);
    draw_trees(layer_, {static_cast<float>(focal_px(camera, kSize.height)), 1, {}});
    stream_.end();
    glFinish();
    check_lists(detail.mosaics, rows);
    return count_seen();
  }

  void check_lists(bool far, const std::vector<Rows>& rows) {
    CHECK(std::isfinite(layer_.error_at_1m));
    CHECK(newest_shown(layer_).missing == 0);
    for (const FarTrees::Shown& shown : layer_.far.packs) {
      CHECK(all_finite(shown.chosen.trees));
      CHECK(all_finite(shown.chosen.items));
    }
    CHECK(all_finite(layer_.groves.shown));
    const std::uint32_t trees = layer_.trees_in_view;
    if (trees == 0) return;
    const auto records = read<foliage::TreeRecord>(layer_.extractor.trees, trees);
    const auto totals = read<foliage::glsl::Totals>(layer_.extractor.totals, 1).front();
    const auto items =
        read<foliage::Item>(layer_.extractor.items, totals.all_trees * foliage::glsl::kFixedItems + totals.cells);
    CHECK(all_finite(records));
    CHECK(all_finite(items));
    check_commands(totals);
    if (!far) check_twin(rows, records, items);
  }

  void check_twin(const std::vector<Rows>& rows, const std::vector<foliage::TreeRecord>& records,
                  const std::vector<foliage::Item>& items) {
    foliage::Selection expected;
    select(layer_.store.table,
           {*layer_.sites, {rows[0].data(), 3}, layer_.runs, layer_.error_at_1m, layer_.law == Law::ours}, expected);
    CHECK(same_bits(records, expected.trees));
    CHECK(same_bits(items, expected.items));
  }

  /// Indices and points of all commands are what groups ask for, and no more.
  void check_commands(const foliage::glsl::Totals& totals) {
    const auto& room = layer_.extractor.capacity;
    const foliage::CommandPlaces places = foliage::command_places(room);
    const auto words = read<GLuint>(layer_.extractor.commands, static_cast<std::size_t>(places.points) / 4 + 4);
    std::uint64_t quads = 0;
    for (std::size_t i = 0; i < room.quad_draws; ++i) quads += words[5 * i] / 6 * words[5 * i + 1];
    CHECK(quads == std::uint64_t{totals.groups.x} * foliage::glsl::kQuadGroup);
    CHECK(words[static_cast<std::size_t>(places.points) / 4] == totals.groups.z * foliage::glsl::kPointGroup);
    CHECK(totals.groups.x <= room.quad_groups);
    CHECK(totals.groups.y <= room.line_groups);
    CHECK(totals.groups.z <= room.point_groups);
  }

  int count_seen() const {
    const std::vector<Vec4> texels = target_.texels();
    CHECK(all_finite(texels));
    return static_cast<int>(
        std::count_if(texels.begin(), texels.end(), [](const Vec4& t) { return t.x + t.y + t.z > 0; }));
  }

  gl::HeadlessContext context_;
  gl::ErrorLog errors_;
  std::vector<PreparedPlant> plants_;
  Scene scene_;
  TreeLayerGpu layer_;
  gl::StreamBuffer stream_;
  FloatTarget target_;
};

std::vector<PreparedPlant> oaks() {
  static const PreparedPlant oak = prepare(grow_plant(foliage::builtin_species("oak"), 3), {.visibility_side = 5});
  return {oak};
}

TreeInstance tree_at(const Vec3& position, const PreparedPlant& plant) {
  TreeInstance tree;
  tree.position = position;
  tree.height_m = kHeight;
  tree.crown_radius_m = kHeight * plant.crown_radius_m / plant.height_m;
  tree.plant = 0;
  return tree;
}

std::vector<TreeInstance> one(const PreparedPlant& plant) { return {tree_at(Vec3(0), plant)}; }

/// Rows by rows trees, a crown apart.
std::vector<TreeInstance> wood(int rows) {
  const float first = -0.5F * kSpacing * static_cast<float>(rows - 1);
  std::vector<TreeInstance> trees;
  for (int i = 0; i < rows * rows; ++i)
    trees.push_back(
        tree_at({first + kSpacing * static_cast<float>(i % rows), first + kSpacing * static_cast<float>(i / rows), 0},
                oaks().front()));
  return trees;
}

constexpr int kPixels = kSize.width * kSize.height;
const std::array kAllSides{Vec3d(1, 0, 0),    Vec3d(0, 1, 0),    Vec3d(-1, 0.2, 0),
                           Vec3d(0, -1, 0.1), Vec3d(0, 0.01, 1), Vec3d(0.01, 0, -1)};

}  // namespace

TEST_CASE("extremes: the eye inside a crown sees leaves on all sides") {
  Trees trees(oaks(), wood(3));
  trees.add_far();
  for (const Vec3d& forward : kAllSides) {
    const auto seen = trees.look(trees.view({0.3, -0.2, 0.7 * static_cast<double>(kHeight)}, forward));
    CAPTURE(forward.x, forward.y, forward.z);
    CHECK(seen.full > kPixels / 4);
    CHECK(seen.ours == Approx(seen.full).epsilon(0.02));
    CHECK(seen.far == Approx(seen.full).epsilon(0.02));
  }
}

TEST_CASE("extremes: an eye a millimetre from bark and from a leaf, with a near plane before and behind it") {
  Trees trees(oaks(), one(oaks().front()));
  trees.add_far();
  const PreparedPlant oak = oaks().front();
  const float size = kHeight / oak.height_m;
  const auto middle = [&](const foliage::PlantQuad& quad) {
    return Vec3d(0.5F * (quad.corners[0].position + quad.corners[2].position) * size);
  };
  for (const foliage::PlantQuad& quad : {oak.bark.front(), oak.leaves[oak.leaves.size() / 2]})
    for (const Vec3d& forward : {Vec3d(1, 0, 0), Vec3d(0, 0.1, 1)})
      for (const double near_m : {0.1, 1e-5}) {
        culling::View view = trees.view(middle(quad) - 1e-3 * glm::normalize(forward), forward);
        view.near_m = near_m;
        const auto seen = trees.look(view);
        CAPTURE(forward.x, near_m);
        CHECK(seen.full > 0);
        CHECK(seen.ours > 0);
        CHECK(seen.far > 0);
      }
}

TEST_CASE("extremes: an eye in the middle of a tree, at its foot and at its tip") {
  Trees trees(oaks(), one(oaks().front()));
  trees.add_far();
  for (const float height : {0.0F, 0.5F * kHeight, kHeight})
    for (const Vec3d& forward : kAllSides) trees.look(trees.view(Vec3d(0, 0, height), forward));
}

TEST_CASE("extremes: a wood a thousand kilometres below, and a tree as far to the side") {
  Trees trees(oaks(), wood(12));
  trees.add_far();
  constexpr double kFar = 1e6, kNarrowDeg = 0.02;
  const auto narrow = trees.look(trees.view({0, 0, kFar}, {0, 0.0001, -1}, kNarrowDeg));
  CHECK(narrow.full > 1000);
  CHECK(narrow.ours == Approx(narrow.full).epsilon(0.1));
  CHECK(narrow.far == Approx(narrow.full).epsilon(0.1));
  trees.look(trees.view({0, 0, kFar}, {0, 0.0001, -1}));  // less than a thousandth of a pixel
  trees.look(trees.view({kFar, 0, 1.7}, {-1, 0, 0}, 1));
}

TEST_CASE("extremes: fields of view of 1 and of 170 degrees") {
  Trees trees(oaks(), wood(3));
  trees.add_far();
  for (const auto& [fovy_deg, distance] : {std::pair{1.0, 400.0}, {170.0, 3.0}, {170.0, 30.0}}) {
    const auto seen =
        trees.look(trees.view({0, -distance - static_cast<double>(kSpacing), kHeight / 2}, {0, 1, 0}, fovy_deg));
    CAPTURE(fovy_deg, distance);
    CHECK(seen.full > (distance == 30 ? 5 : 1000));
    CHECK(seen.ours == Approx(seen.full).epsilon(0.1).margin(9));
    CHECK(seen.far == Approx(seen.full).epsilon(0.1).margin(9));
  }
}

TEST_CASE("extremes: no tree, one, and none of those there are in view") {
  Trees none(oaks(), {}), alone(oaks(), one(oaks().front()));
  const auto empty = none.look(none.view({0, -20, 5}, {0, 1, 0}));
  CHECK(empty.full + empty.ours + empty.far == 0);
  const auto seen = alone.look(alone.view({0, -20, 5}, {0, 1, 0}));
  CHECK(seen.full > 300);
  CHECK(seen.ours > 300);
  const auto behind = alone.look(alone.view({0, -20, 5}, {0, -1, 0}));
  CHECK(behind.full + behind.ours + behind.far == 0);
}

TEST_CASE("extremes: a tree of one leaf, from near to far") {
  for (const bool whole : {true, false}) {
    const PreparedPlant leaf = single_leaf(whole);
    Trees trees({leaf}, one(leaf));
    trees.add_far();
    for (const double distance : {1e-3, 3.0, 30.0, 300.0, 1e6}) {
      const auto seen = trees.look(trees.view({0.1, -distance, kHeight / 3}, {0, 1, 0}));
      CAPTURE(whole, distance);
      if (distance > 1 && distance < 100) CHECK(seen.full > 30);
      if (distance > 1 && distance < 100) CHECK(seen.ours == Approx(seen.full).epsilon(0.1));
      if (distance > 1 && distance < 100) CHECK(seen.far == Approx(seen.full).epsilon(0.1));
    }
  }
}

// Two minutes, 5 GB: not among those that always run.
TEST_CASE("extremes: a tree of 10 million triangles is prepared and drawn from near to far", "[.][long]") {
  const PreparedPlant ready = prepare(many_cards(5'000'000), {.visibility_side = 0});
  REQUIRE(ready.leaves.size() == 5'000'000);
  Trees trees({ready}, one(ready));
  for (const double distance : {0.0, 15.0, 60.0, 1000.0}) {
    const auto seen = trees.look(trees.view({0.1, -distance, 0.5 * static_cast<double>(kHeight)}, {0, 1, 0}));
    CAPTURE(distance);
    CHECK(seen.full >= (distance < 100 ? 50 : 0));
    CHECK(seen.ours == Approx(seen.full).epsilon(0.1).margin(4));
  }
}

}  // namespace manzana::draw
