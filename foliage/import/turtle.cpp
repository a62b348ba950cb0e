#include "foliage/import/turtle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "foliage/import/polygon.h"
#include "foliage/leaf_image.h"
#include "foliage/stems.h"
#include "foliage/tube.h"

namespace manzana::foliage {
namespace {

constexpr std::size_t kMaxDepth = 10'000;
constexpr double kDegree = 3.14159265358979323846 / 180;

/// Steps of the turtle. Columns of the frame: left, up, heading.
struct State {
  Vec3d position{0};
  Mat3d frame{1};
  double radius_m = 0;
  int colour = 0;
  int stem = -1;        // the branch that it draws or came from
  bool on_tip = false;  // of that branch: F goes on with it
  bool in_gap = false;  // f left it: F begins another of the same level
};

struct Surface {
  std::vector<Vec3d> corners;
  int colour = 0, stem = -1;
  Organ organ = Organ::leaf;
};

/// What the turtle left: stems in steps, their radii in metres.
struct Drawing {
  std::vector<Stem> stems;
  std::vector<Surface> surfaces;
};

class Turtle {
 public:
  explicit Turtle(const LSystem& system)
      : system_(system), cos_(std::cos(system.angle_deg * kDegree)), sin_(std::sin(system.angle_deg * kDegree)) {
    state_.radius_m = system.look.radius_m;
  }

  Drawing run(const std::string& string) {
    for (at_ = 0; at_ < string.size(); ++at_) obey(string);
    if (!stack_.empty()) fail("[ without a ]");
    if (!open_.empty()) fail("{ without a }");
    return std::move(drawing_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(system_.name + ": symbol " + std::to_string(at_ + 1) + ": " + what);
  }

  void obey(const std::string& string) {
    switch (string[at_]) {
      case 'F':
        return forward(true, true);
      case 'f':
        return forward(false, true);
      case 'G':
        return forward(true, false);
      case '+':
        return rotate(2, 0, sin_);
      case '-':
        return rotate(2, 0, -sin_);
      case '&':
        return rotate(1, 2, sin_);
      case '^':
        return rotate(1, 2, -sin_);
      case '\\':
        return rotate(1, 0, sin_);
      case '/':
        return rotate(1, 0, -sin_);
      case '|':
        state_.frame[0] = -state_.frame[0];
        state_.frame[2] = -state_.frame[2];
        return;
      case '$':
        return upright();
      case '[':
        return push();
      case ']':
        return pop();
      case '{':
        return open();
      case '.':
        return corner();
      case '}':
        return close();
      case '!':
        state_.radius_m *= system_.look.narrowing;
        return;
      case '\'':
        state_.colour = std::min(state_.colour + 1, static_cast<int>(system_.look.colours.size()) - 1);
        return;
      case '~':
        return predefined(string);
      case '%':
        return skip_branch(string);
      default:
        return;
    }
  }

  /// Turns axis a towards axis b.
  void rotate(int a, int b, double sine) {
    const Vec3d from = state_.frame[a], to = state_.frame[b];
    state_.frame[a] = from * cos_ + to * sine;
    state_.frame[b] = to * cos_ - from * sine;
  }

  void upright() {
    const Vec3d left = glm::cross(Vec3d(0, 0, 1), state_.frame[2]);
    const double length = glm::length(left);
    if (length < 1e-9) return;  // it heads up or down
    state_.frame[0] = left / length;
    state_.frame[1] = glm::cross(state_.frame[2], state_.frame[0]);
  }

  void forward(bool draws, bool sets_corner) {
    const Vec3d from = state_.position;
    state_.position += state_.frame[2];
    if (!open_.empty()) {
      if (sets_corner) corner();
    } else if (draws) {
      draw_from(from);
    } else {
      state_.in_gap = state_.in_gap || state_.on_tip;
      state_.on_tip = false;
    }
  }

  StemPoint point(const Vec3d& position) const {
    return {Vec3(position), Mat3(state_.frame), static_cast<float>(state_.radius_m)};
  }

  void draw_from(const Vec3d& from) {
    if (!state_.on_tip) begin_stem(from);
    Stem& stem = drawing_.stems[static_cast<std::size_t>(state_.stem)];
    StemPoint& last = stem.points.back();
    const StemPoint next = point(state_.position);
    last.radius = next.radius;
    if (stem.points.size() > 1 && goes_straight(stem, next)) {
      last = next;
    } else {
      stem.points.push_back(next);
      count_vertices(static_cast<std::size_t>(stem_sides(stem.level)) + 1);
    }
    state_.on_tip = true;
    state_.in_gap = false;
  }

  void begin_stem(const Vec3d& from) {
    Stem stem;
    stem.parent = state_.stem;
    if (stem.parent >= 0)
      stem.level = drawing_.stems[static_cast<std::size_t>(stem.parent)].level + (state_.in_gap ? 0 : 1);
    stem.points.push_back(point(from));
    count_vertices(static_cast<std::size_t>(stem_sides(stem.level)) + 1);
    state_.stem = static_cast<int>(drawing_.stems.size());
    drawing_.stems.push_back(std::move(stem));
  }

  /// The last point lies between its neighbours on a line, and the tube is as wide there.
  static bool goes_straight(const Stem& stem, const StemPoint& next) {
    const StemPoint &before = *(stem.points.end() - 2), &last = stem.points.back();
    if (before.radius != next.radius) return false;
    const Vec3 way = glm::normalize(last.position - before.position);
    return glm::dot(way, next.frame[2]) > 0 && glm::length(glm::cross(way, next.frame[2])) < 1e-4F;
  }

  void count_vertices(std::size_t count) {
    vertices_ += count;
    if (vertices_ > kMaxPlantVertices) fail("more than " + std::to_string(kMaxPlantVertices) + " vertices");
  }

  void push() {
    if (stack_.size() >= kMaxDepth) fail("brackets nested deeper than " + std::to_string(kMaxDepth));
    stack_.push_back(state_);
    state_.on_tip = state_.in_gap = false;
  }

  void pop() {
    if (stack_.empty()) fail("] without a [");
    state_ = stack_.back();
    stack_.pop_back();
  }

  void open() {
    if (open_.size() >= kMaxDepth) fail("polygons nested deeper than " + std::to_string(kMaxDepth));
    open_.push_back({{}, state_.colour, state_.stem, Organ::leaf});
  }

  void corner() {
    if (open_.empty()) return;
    count_vertices(1);
    std::vector<Vec3d>& corners = open_.back().corners;
    if (corners.empty() || glm::distance(corners.back(), state_.position) > 1e-6) corners.push_back(state_.position);
  }

  void close() {
    if (open_.empty()) fail("} without a {");
    Surface surface = std::move(open_.back());
    open_.pop_back();
    auto& corners = surface.corners;
    if (corners.size() > 1 && glm::distance(corners.front(), corners.back()) < 1e-6) corners.pop_back();
    if (glm::length(area_vector(corners)) > 1e-9) drawing_.surfaces.push_back(std::move(surface));
  }

  /// The leaf of ABOP's figure 1.25, as long as the look says.
  void predefined(const std::string& string) {
    static constexpr std::array<std::array<double, 2>, 6> kLeaf{
        {{0, 0}, {.32, .13}, {.68, .13}, {1, 0}, {.68, -.13}, {.32, -.13}}};
    const char name = ++at_ < string.size() ? string[at_] : ' ';
    if (name != 'L' && name != 'K') fail(std::string("there is no surface ~") + name + ", only ~L and ~K");
    Surface surface{{}, state_.colour, state_.stem, name == 'K' ? Organ::flower : Organ::leaf};
    for (const auto& [along, across] : kLeaf)
      surface.corners.push_back(state_.position +
                                (state_.frame[2] * along + state_.frame[0] * across) * system_.look.surface_steps);
    count_vertices(surface.corners.size());
    drawing_.surfaces.push_back(std::move(surface));
  }

  /// To before the ] that closes it.
  void skip_branch(const std::string& string) {
    int depth = 0;
    for (; at_ + 1 < string.size(); ++at_) {
      const char c = string[at_ + 1];
      if (c == ']' && depth-- == 0) return;
      if (c == '[') ++depth;
    }
  }

  const LSystem& system_;
  double cos_, sin_;
  State state_;
  std::vector<State> stack_;
  std::vector<Surface> open_;  // polygons begun
  Drawing drawing_;
  std::size_t at_ = 0, vertices_ = 0;
};

Vec3 across(const Vec3& v) {  // a unit vector
  return glm::normalize(glm::cross(v, std::abs(v.z) < 0.8F ? Vec3(0, 0, 1) : Vec3(1, 0, 0)));
}

/// Metres a step: the highest point is as high as the look says; where nothing rises, the farthest one.
double step_length(const Drawing& drawing, double height_m) {
  double top = 0, far = 0;
  const auto reach = [&](const Vec3d& p) { top = std::max(top, p.z), far = std::max(far, glm::length(p)); };
  for (const Stem& stem : drawing.stems)
    for (const StemPoint& p : stem.points) reach(Vec3d(p.position));
  for (const Surface& surface : drawing.surfaces)
    for (const Vec3d& corner : surface.corners) reach(corner);
  return height_m / (top > 1e-3 * far ? top : far);
}

/// Rings stand across the mean of both segments, and do not roll from one to the next as the turtle does.
void turn_rings(Stem& stem) {
  const auto along = [&](std::size_t i) {  // from point i to the next
    return glm::normalize(stem.points[i + 1].position - stem.points[i].position);
  };
  const std::size_t last = stem.points.size() - 1;
  Vec3 side = stem.points[0].frame[0];
  for (std::size_t i = 0; i <= last; ++i) {
    const Vec3 before = along(i == 0 ? 0 : i - 1), after = along(i == last ? last - 1 : i), sum = before + after;
    const Vec3 heading = glm::length(sum) > 0.1F ? glm::normalize(sum) : after;
    side -= heading * glm::dot(side, heading);
    side = glm::length(side) > 0.1F ? glm::normalize(side) : across(heading);
    stem.points[i].frame = {side, glm::cross(heading, side), heading};
  }
}

/// Where a branch forks at its tip, a cap beyond it, so that the tube is not drawn to a point there.
void cap_forked_tips(std::vector<Stem>& stems) {
  std::vector<bool> forked(stems.size());
  for (const Stem& stem : stems)
    if (stem.parent >= 0) {
      const auto parent = static_cast<std::size_t>(stem.parent);
      forked[parent] = forked[parent] || stems[parent].points.back().position == stem.points.front().position;
    }
  for (std::size_t i = 0; i < stems.size(); ++i) {
    if (!forked[i]) continue;
    StemPoint cap = stems[i].points.back();
    cap.position += cap.frame[2] * cap.radius;
    stems[i].points.push_back(cap);
  }
}

void scale(Drawing& drawing, double step) {
  for (Stem& stem : drawing.stems) {
    for (StemPoint& p : stem.points) p.position *= static_cast<float>(step);
    for (std::size_t i = 1; i < stem.points.size(); ++i)
      stem.length += glm::distance(stem.points[i - 1].position, stem.points[i].position);
    turn_rings(stem);
  }
  for (Surface& surface : drawing.surfaces)
    for (Vec3d& corner : surface.corners) corner *= step;
}

/// A strip for each colour; surfaces wear its middle.
Image palette(const std::vector<std::uint32_t>& colours) {
  Image image{kPlantImageSize, {}};
  for (std::size_t i = 0; i < std::size_t{kPlantImageSize} * kPlantImageSize; ++i) {
    const std::uint32_t rgb = colours[i % kPlantImageSize * colours.size() / kPlantImageSize];
    for (const int shift : {16, 8, 0}) image.rgba.push_back(static_cast<std::uint8_t>(rgb >> shift));
    image.rgba.push_back(255);
  }
  return image;
}

void add_surface(Plant& plant, const Surface& surface, std::size_t colours) {
  MeshPart& leaves = plant.mesh.leaves;
  const auto first_vertex = static_cast<std::uint32_t>(leaves.vertices.size());
  const auto first = static_cast<std::uint32_t>(leaves.triangles());
  const Vec3 normal(glm::normalize(area_vector(surface.corners)));
  const Vec2 uv((static_cast<float>(surface.colour) + 0.5F) / static_cast<float>(colours), 0.5F);
  for (const Vec3d& corner : surface.corners) leaves.vertices.push_back({Vec3(corner), normal, uv});
  for (const auto& triangle : triangulated(surface.corners))
    for (const std::uint32_t i : triangle) leaves.indices.push_back(first_vertex + i);
  plant.terminals.push_back({{first, static_cast<std::uint32_t>(leaves.triangles())}, surface.stem, surface.organ});
}

}  // namespace

Plant grow_plant(const LSystem& system) {
  Drawing drawing = Turtle(system).run(derive(system, system.steps));
  if (drawing.stems.empty() && drawing.surfaces.empty())
    throw std::runtime_error(system.name + ": its string draws nothing");
  scale(drawing, step_length(drawing, system.look.height_m));
  cap_forked_tips(drawing.stems);
  Plant plant;
  plant.name = system.name;
  for (const Stem& stem : drawing.stems) add_branch(plant, stem, stem.points);
  for (const Surface& surface : drawing.surfaces) add_surface(plant, surface, system.look.colours.size());
  plant.leaf_image = palette(system.look.colours);
  plant.bark_image = bark_image(system.look.bark_rgb, 1);
  CrownLight(plant.mesh.leaves).apply(plant.mesh);
  return plant;
}

}  // namespace manzana::foliage
