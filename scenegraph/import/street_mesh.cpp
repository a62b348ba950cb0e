#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenegraph/import/street_sections.h"
#include "scenegraph/import/surface_piece.h"

namespace manzana {
namespace {

constexpr double kSlab = 0.8;           // metres: thickness of a bridge's deck below its line
constexpr double kParapet = 1.1;        // height above the walkway
constexpr double kParapetWidth = 0.25;  // outside of the street
constexpr double kRaised = 0.5;         // a street higher than this above ground has parapets
constexpr double kLeastHeight = 0.02;   // below it lies on the ground
constexpr double kFooting = -0.2;       // ramps' walls end below the ground
constexpr double kSquareHeight = 0.076;

/// A height on a section: above its line, or above the ground.
struct Level {
  double z = 0;
  bool from_ground = false;
};

/// A long face: between two lines beside the street. Seen from outside it runs from a to b, left to right along +s.
struct Strip {
  double s0;
  Level z0;
  double s1;
  Level z1;
  std::uint32_t colour;
  double v0 = 0, v1 = 0;
};

Vec3d point(const Section& section, double s, const Level& level) {
  return {section.at(s), level.from_ground ? level.z : section.height + level.z};
}

Vec3d strip_normal(const Section& section, const Vec3d& a, const Vec3d& b) {
  const Vec2d forward{-section.right.y, section.right.x};
  const double across = glm::dot(Vec2d(b - a), section.right), rise = b.z - a.z;
  const Vec3d normal = Vec3d(-forward * section.grade, 1) * across - Vec3d(section.right, 0) * rise;
  return glm::length(normal) > 1e-9 ? normal : Vec3d{0, 0, 1};
}

void lay_strip(PieceBuilder& piece, std::span<const Section> sections, const Strip& strip) {
  std::uint32_t a = 0, b = 0;
  Vec3d pa{0, 0, 0}, pb{0, 0, 0};
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const Section& at = sections[i];
    const Vec3d qa = point(at, strip.s0, strip.z0), qb = point(at, strip.s1, strip.z1);
    const Vec3d normal = strip_normal(at, qa, qb);
    const std::uint32_t c = piece.vertex(qa, normal, strip.colour, {at.along, strip.v0});
    const std::uint32_t d = piece.vertex(qb, normal, strip.colour, {at.along, strip.v1});
    const auto faces_out = [&](const Vec3d& p, const Vec3d& q, const Vec3d& r) {
      return glm::dot(glm::cross(q - p, r - p), normal) > 1e-9;  // not where the inner side of a bend folds up
    };
    if (i > 0 && faces_out(pa, pb, qb)) piece.triangle(a, b, d);
    if (i > 0 && faces_out(pa, qb, qa)) piece.triangle(a, d, c);
    a = c;
    b = d;
    pa = qa;
    pb = qb;
  }
}

/// A rectangle across the street, from (s0, z0) to (s1, z1), seen along the street or against it.
void lay_end(PieceBuilder& piece, const Section& at, const Strip& strip, bool forward) {
  const Vec2d along{-at.right.y, at.right.x};
  const Vec3d normal(forward ? along : -along, 0);
  const auto vertex = [&](double s, const Level& level) {
    return piece.vertex(point(at, s, level), normal, strip.colour, {s, level.z});
  };
  const std::uint32_t a = vertex(strip.s0, strip.z0), b = vertex(strip.s1, strip.z0);
  const std::uint32_t c = vertex(strip.s1, strip.z1), d = vertex(strip.s0, strip.z1);
  piece.triangle(a, forward ? c : b, forward ? b : c);
  piece.triangle(a, forward ? d : c, forward ? c : d);
}

/// An edge while it is laid.
class Layer {
 public:
  Layer(const StreetFeature& street, StreetLine& line) : street_(street), line_(line), look_(street_look(street.kind)) {
    length_ = length_in_plan(line.points);
    count_ = static_cast<std::size_t>(std::max(1.0, std::ceil(length_ / kSurfacePiece - 1e-9)));
    limit_clearances();
  }

  std::vector<SurfacePiece> run() {
    const std::vector<Run> runs = street_runs(line_, cuts(), look_.pavement);
    for (std::size_t k = 0; k < count_; ++k) pieces_.emplace_back(middle((double(k) + 0.5) * length_ / double(count_)));
    for (const Run& run : runs) lay(run);
    for (const Wedge& wedge : line_.wedges) lay(wedge);
    std::vector<SurfacePiece> result;
    for (PieceBuilder& piece : pieces_)
      if (!piece.empty()) result.push_back(piece.take());
    return result;
  }

 private:
  /// One cut an end where lines and parapets end together; none that would fall on the end itself.
  void limit_clearances() {
    EdgeEnd &a = line_.ends[0], &b = line_.ends[1];
    const double least = std::max(1.0, line_.half_width);  // nearer cuts would move to the ends: street_runs
    for (EdgeEnd* end : {&a, &b})
      if (end->clear > 0) end->clear = end->open = std::max({end->clear, end->open, least + 1e-3});
    if (a.clear + b.clear > length_ - least) a.clear = b.clear = a.clear + b.clear > 0 ? length_ : 0;
  }

  bool deck() const { return street_.bridge; }
  bool raised() const {
    return deck() ||
           std::any_of(line_.points.begin(), line_.points.end(), [](const Vec3d& p) { return p.z > kRaised; });
  }
  double total() const { return line_.half_width + look_.pavement; }
  double top() const { return look_.pavement > 0 ? kPavementHeight : look_.height; }
  std::size_t piece_at(double along) const {
    return std::min(count_ - 1, static_cast<std::size_t>(std::max(0.0, along / length_ * double(count_))));
  }

  Vec2d middle(double along) const {
    double from = 0;
    for (std::size_t i = 1; i < line_.points.size(); ++i) {
      const Vec2d a(line_.points[i - 1]), b(line_.points[i]);
      const double step = glm::distance(a, b);
      if (from + step >= along && step > 0) return a + (b - a) * ((along - from) / step);
      from += step;
    }
    return Vec2d(line_.points.back());
  }

  /// Where a new piece begins, lane lines or parapets begin or end, or the street leaves the ground.
  std::vector<double> cuts() const {
    std::vector<double> at;
    for (std::size_t k = 1; k < count_; ++k) at.push_back(length_ * double(k) / double(count_));
    at.insert(at.end(), {line_.ends[0].clear, length_ - line_.ends[1].clear});
    if (raised()) at.insert(at.end(), {line_.ends[0].open, length_ - line_.ends[1].open});
    double from = 0;
    for (std::size_t i = 1; i < line_.points.size(); ++i) {
      const Vec3d &a = line_.points[i - 1], &b = line_.points[i];
      const double step = glm::distance(Vec2d(a), Vec2d(b));
      for (const double z : {kLeastHeight, kRaised})
        if ((a.z < z) != (b.z < z)) at.push_back(from + step * (z - a.z) / (b.z - a.z));
      from += step;
    }
    std::sort(at.begin(), at.end());
    return at;
  }

  /// What is laid between two sections; runs of equal kinds become one strip.
  struct Kind {
    std::size_t piece;
    bool lines, raised, parapet;
    bool operator==(const Kind&) const = default;
  };
  Kind kind(const Section& a, const Section& b) const {
    const double along = (a.along + b.along) / 2, height = (a.height + b.height) / 2;
    const EdgeEnd &start = line_.ends[0], &end = line_.ends[1];
    const bool lines = along > start.clear && along < length_ - end.clear;
    const bool open = along < start.open || along > length_ - end.open;
    const bool raised = deck() || std::max(a.height, b.height) > kLeastHeight;
    return {piece_at(along), lines, raised, raised && !open && (deck() || height > kRaised)};
  }

  template <class Same, class Lay>
  void each(const Run& run, Same&& same, Lay&& lay_range) {
    for (std::size_t first = 0; first + 1 < run.size();) {
      const Kind k = kind(run[first], run[first + 1]);
      std::size_t last = first + 1;
      while (last + 1 < run.size() && same(k, kind(run[last], run[last + 1]))) ++last;
      lay_range(pieces_[k.piece], std::span(run).subspan(first, last - first + 1), k);
      first = last;
    }
  }

  void lay(const Run& run) {
    const double half = line_.half_width, lanes = std::max(1, street_.lanes);
    each(
        run, [](const Kind& a, const Kind& b) { return a.piece == b.piece && a.lines == b.lines; },
        [&](PieceBuilder& piece, std::span<const Section> part, const Kind& k) {
          const bool marked = look_.road && k.lines;
          const Material material = look_.road && !marked ? Material::junction : look_.material;
          const double v1 = look_.road ? lanes : 2 * half;
          lay_strip(piece, part, {-half, {look_.height}, half, {look_.height}, ground_colour(material), 0, v1});
        });
    if (look_.pavement > 0)
      each(
          run, [](const Kind& a, const Kind& b) { return a.piece == b.piece; },
          [&](PieceBuilder& piece, std::span<const Section> part, const Kind&) {
            const Level z{kPavementHeight};
            lay_strip(piece, part, {-total(), z, total(), z, ground_colour(Material::pavement), 0, 2 * total()});
          });
    each(
        run,
        [](const Kind& a, const Kind& b) {
          return a.piece == b.piece && a.raised == b.raised && a.parapet == b.parapet;
        },
        [&](PieceBuilder& piece, std::span<const Section> part, const Kind& k) {
          if (k.raised) lay_raised(piece, part, k.parapet);
        });
    lay_abutments(run);
  }

  void lay_raised(PieceBuilder& piece, std::span<const Section> part, bool parapet) {
    const std::uint32_t colour = ground_colour(Material::concrete);
    const double inner = total(), outer = parapet ? inner + kParapetWidth : inner;
    const Level bottom = deck() ? Level{-kSlab} : Level{kFooting, true}, walk{top()};
    const Level high = parapet ? Level{top() + kParapet} : walk;
    lay_strip(piece, part, {-outer, bottom, -outer, high, colour, 0, kParapet + kSlab});
    lay_strip(piece, part, {outer, high, outer, bottom, colour, 0, kParapet + kSlab});
    if (deck() && part.front().height + part.back().height > 2 * kSlab)
      lay_strip(piece, part, {outer, bottom, -outer, bottom, colour, 0, 2 * outer});
    if (!parapet) return;
    lay_strip(piece, part, {-outer, high, -inner, high, colour, 0, kParapetWidth});
    lay_strip(piece, part, {-inner, high, -inner, walk, colour, 0, kParapet});
    lay_strip(piece, part, {inner, walk, inner, high, colour, 0, kParapet});
    lay_strip(piece, part, {inner, high, outer, high, colour, 0, kParapetWidth});
    for (const bool forward : {false, true})
      for (const auto& [a, b] : {std::pair(-outer, -inner), std::pair(inner, outer)})
        lay_end(piece, forward ? part.back() : part.front(), {a, walk, b, high, colour}, forward);
  }

  /// Ramps are closed where they meet a bridge.
  void lay_abutments(const Run& run) {
    if (deck()) return;
    const Strip wall{-total(), {kFooting, true}, total(), {top()}, ground_colour(Material::concrete)};
    if (run.front().height > kRaised) lay_end(pieces_[piece_at(run.front().along)], run.front(), wall, false);
    if (run.back().height > kRaised) lay_end(pieces_[piece_at(run.back().along)], run.back(), wall, true);
  }

  void lay(const Wedge& wedge) {
    const bool at_start = glm::distance(Vec2d(wedge.center), Vec2d(line_.points.front())) <=
                          glm::distance(Vec2d(wedge.center), Vec2d(line_.points.back()));
    PieceBuilder& piece = at_start ? pieces_.front() : pieces_.back();
    const Material material = look_.road ? Material::junction : look_.material;
    fan(piece, wedge, 0, look_.height, ground_colour(material));
    if (wedge.pavement > 0) fan(piece, wedge, wedge.pavement, kPavementHeight, ground_colour(Material::pavement));
  }

  static void fan(PieceBuilder& piece, const Wedge& wedge, double wider, double height, std::uint32_t colour) {
    const double sweep = wedge.a1 - wedge.a0;
    const int steps = std::max(1, static_cast<int>(std::ceil(sweep / (std::numbers::pi / 8))));
    const Vec3d center = wedge.center + Vec3d(0, 0, height), up{0, 0, 1};
    const std::uint32_t hub = piece.vertex(center, up, colour, {0, 0});
    for (int i = 0; i <= steps; ++i) {
      const double t = i / double(steps), angle = wedge.a0 + sweep * t;
      const double radius = wedge.r0 + (wedge.r1 - wedge.r0) * t + wider;
      const Vec2d arm = radius * Vec2d{std::cos(angle), std::sin(angle)};
      const std::uint32_t next = piece.vertex(center + Vec3d(arm, 0), up, colour, arm);
      if (i > 0) piece.triangle(hub, next - 1, next);
    }
  }

  const StreetFeature& street_;
  StreetLine& line_;
  StreetLook look_;
  double length_ = 0;
  std::size_t count_ = 1;
  std::vector<PieceBuilder> pieces_;
};

void lay_squares(const StreetGraph& graph, std::vector<SurfacePiece>& pieces, std::vector<Issue>& issues) {
  const Geos geos;
  for (const StreetFeature& street : graph.streets) {
    if (!street.circular || street.tunnel || carries_traffic(street.kind)) continue;
    const StreetLook look = street_look(street.kind);
    const Material material = look.material == Material::asphalt ? Material::junction : look.material;
    const std::size_t first = pieces.size();
    append_area(pieces, geos, {street.line, {}}, {street.where, material, kSquareHeight}, issues);
    for (std::size_t i = first; i < pieces.size(); ++i) pieces[i].attributes = street.attributes;
  }
}

}  // namespace

std::vector<SurfacePiece> street_pieces(const StreetGraph& graph, std::vector<Issue>& issues) {
  std::vector<SurfacePiece> pieces;
  std::vector<StreetLine> lines = street_lines(graph, issues);
  for (std::size_t e = 0; e < lines.size(); ++e) {
    if (!lines[e].laid) continue;
    const StreetFeature& street = graph.streets[graph.edges[e].street];
    for (SurfacePiece& piece : Layer(street, lines[e]).run()) {
      piece.attributes = street.attributes;
      pieces.push_back(std::move(piece));
    }
  }
  lay_squares(graph, pieces, issues);
  return pieces;
}

}  // namespace manzana
