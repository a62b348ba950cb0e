#include "foliage/few_cards.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "foliage/random.h"
#include "foliage/raster.h"
#include "foliage/sets.h"

namespace manzana::foliage {
namespace {

constexpr int kPixels = 96;

/// A black and white picture of the plant's side.
class Raster {
 public:
  Raster(const Silhouette& silhouette, float angle)
      : silhouette_(silhouette),
        holes_(silhouette.leaf),
        across_(std::cos(angle), std::sin(angle), 0),
        hit_(kPixels * kPixels, false) {}

  void draw(const MeshPart& part, bool leaf) {
    for (std::size_t t = 0; t + 2 < part.indices.size(); t += 3)
      triangle(part.vertices[part.indices[t]], part.vertices[part.indices[t + 1]], part.vertices[part.indices[t + 2]],
               leaf);
  }

  float share() const { return static_cast<float>(std::count(hit_.begin(), hit_.end(), true)) / (kPixels * kPixels); }

 private:
  Vec2 project(const Vec3& p) const {
    const PlantSize& size = silhouette_.size;
    return Vec2(0.5F + 0.5F * glm::dot(p, across_) / size.radius, p.z / size.height) * static_cast<float>(kPixels);
  }

  void triangle(const MeshVertex& a, const MeshVertex& b, const MeshVertex& c, bool leaf) {
    for_each_pixel({project(a.position), project(b.position), project(c.position)}, kPixels,
                   [&](int x, int y, float v, float w) {
                     if (!leaf || holes_.opaque(a.uv + (b.uv - a.uv) * v + (c.uv - a.uv) * w))
                       hit_[static_cast<std::size_t>(y * kPixels + x)] = true;
                   });
  }

  const Silhouette& silhouette_;
  LeafHoles holes_;
  Vec3 across_;
  std::vector<bool> hit_;
};

constexpr std::array<float, 3> kViews{0.3F, 1.35F, 2.4F};  // radians; three sides of the tree

float mean_coverage(const PlantMesh& mesh, const Silhouette& silhouette) {
  float sum = 0;
  for (const float angle : kViews) sum += side_coverage(mesh, silhouette, angle);
  return sum / kViews.size();
}

struct Card {
  std::vector<std::uint32_t> triangles;  // of the fine level, each the place of its first index
  Vec3 middle{0};
  std::size_t group = 0;
};

/// For each vertex the first one at its place: where normals differ, a file has several.
std::vector<std::uint32_t> joined_by_place(const MeshPart& part) {
  std::vector<std::uint32_t> order(part.vertices.size()), first(part.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    const Vec3& p = part.vertices[i].position;
    return std::tuple(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
  return first;
}

/// Triangles that share a corner are one card.
std::vector<Card> find_cards(const MeshPart& leaves) {
  const std::vector<std::uint32_t> same = joined_by_place(leaves);
  Sets sets(leaves.vertices.size());
  for (std::size_t i = 0; i < leaves.indices.size(); ++i)
    sets.join(same[leaves.indices[i]], same[leaves.indices[i - i % 3]]);
  std::vector<Card> cards;
  std::vector<std::uint32_t> card_of(same.size(), ~0U);
  for (std::uint32_t t = 0; t + 2 < leaves.indices.size(); t += 3) {
    std::uint32_t& card = card_of[sets.find(same[leaves.indices[t]])];
    if (card == ~0U) card = static_cast<std::uint32_t>(cards.size()), cards.emplace_back();
    cards[card].triangles.push_back(t);
  }
  for (Card& card : cards) {
    for (const std::uint32_t t : card.triangles)
      for (std::size_t k = 0; k < 3; ++k) card.middle += leaves.vertices[leaves.indices[t + k]].position;
    card.middle /= 3.0F * static_cast<float>(card.triangles.size());
  }
  return cards;
}

float distance2(const Vec3& a, const Vec3& b) { return glm::dot(a - b, a - b); }

std::size_t nearest(const std::vector<Vec3>& centres, const Vec3& p) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < centres.size(); ++i)
    if (distance2(centres[i], p) < distance2(centres[best], p)) best = i;
  return best;
}

/// Lloyd's algorithm from evenly drawn cards; the groups' centres.
std::vector<Vec3> group(std::vector<Card>& cards, std::size_t count) {
  constexpr int kRounds = 6;
  std::vector<Vec3> centres;
  for (std::size_t i = 0; i < count; ++i) centres.push_back(cards[(2 * i + 1) * cards.size() / (2 * count)].middle);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Vec3> sums(count, Vec3(0));
    std::vector<float> members(count, 0);
    for (Card& card : cards) {
      card.group = nearest(centres, card.middle);
      sums[card.group] += card.middle;
      members[card.group] += 1;
    }
    for (std::size_t i = 0; i < count; ++i)
      if (members[i] > 0) centres[i] = sums[i] / members[i];
  }
  return centres;
}

/// One card of each group, the one nearest to its centre; of equals the first.
std::vector<std::size_t> representatives(const std::vector<Card>& cards, const std::vector<Vec3>& centres) {
  std::vector<std::size_t> best(centres.size(), cards.size());
  for (std::size_t i = 0; i < cards.size(); ++i) {
    std::size_t& b = best[cards[i].group];
    const Vec3& centre = centres[cards[i].group];
    if (b == cards.size() || distance2(cards[i].middle, centre) < distance2(cards[b].middle, centre)) b = i;
  }
  std::erase(best, cards.size());
  return best;
}

/// How wide each group is against the mean of all: its card must fill that, at the tip of a cone less than at its foot.
std::vector<float> group_spreads(const std::vector<Card>& cards, const std::vector<Vec3>& centres) {
  std::vector<float> spreads(centres.size(), 0), members(centres.size(), 0);
  for (const Card& card : cards) {
    spreads[card.group] += glm::length(card.middle - centres[card.group]);
    members[card.group] += 1;
  }
  float sum = 0;
  for (std::size_t i = 0; i < spreads.size(); ++i) sum += spreads[i] /= std::max(members[i], 1.0F);
  const float mean = std::max(sum / static_cast<float>(spreads.size()), 1e-6F);
  for (float& spread : spreads) spread = std::clamp(spread / mean, 0.5F, 1.5F);
  return spreads;
}

/// Moves points so that all lie within the plant's cylinder, as one body where that is possible.
void push_inside(std::span<MeshVertex> vertices, const PlantSize& size) {
  for (int round = 0; round < 3; ++round) {
    Vec3 shift(0);
    for (const MeshVertex& v : vertices) {
      const Vec2 flat(v.position.x, v.position.y);
      const float r = glm::length(flat);
      if (r > size.radius) shift -= Vec3(flat * ((r - size.radius) / r), 0) * 0.7F;
      shift.z = std::min(shift.z, size.height - v.position.z);
    }
    for (MeshVertex& v : vertices) v.position += shift;
  }
}

/// Some cards of a crown, and where each of them goes.
class Thinning {
 public:
  Thinning(const PlantMesh& fine, const PlantSize& size)
      : leaves_(fine.leaves), size_(size), cards_(find_cards(fine.leaves)) {}

  void choose_by_group(std::size_t most) {
    if (cards_.empty()) return;
    const std::vector<Vec3> centres = group(cards_, std::min(most, cards_.size()));
    const std::vector<float> spreads = group_spreads(cards_, centres);
    for (const std::size_t i : representatives(cards_, centres))
      chosen_.push_back({i, centres[cards_[i].group], spreads[cards_[i].group]});
  }

  void choose_by_hash(float share) {
    for (std::size_t i = 0; i < cards_.size(); ++i)
      if (Random(hash(i)).uniform() < share) chosen_.push_back({i, cards_[i].middle, 1});
  }

  /// At the scale that gives the coverage of `fine`.
  MeshPart fitted(const PlantMesh& fine, const MeshPart& bark, const Silhouette& silhouette) const {
    constexpr int kHalvings = 9;
    const float wanted = mean_coverage(fine, silhouette);
    float low = 0.5F, high = 16;
    for (int i = 0; i < kHalvings; ++i) {
      const float middle = std::sqrt(low * high);
      (mean_coverage({bark, scaled(middle)}, silhouette) < wanted ? low : high) = middle;
    }
    return scaled(std::sqrt(low * high));
  }

 private:
  struct Choice {
    std::size_t card;
    Vec3 place;
    float scale;  // of this one, against the others
  };

  MeshPart scaled(float scale) const {
    MeshPart out;
    std::vector<std::uint32_t> places(leaves_.vertices.size(), ~0U);  // in `out`; cards share no vertex
    for (const Choice& choice : chosen_) add_card(out, places, choice, scale * choice.scale);
    return out;
  }

  void add_card(MeshPart& out, std::vector<std::uint32_t>& places, const Choice& choice, float scale) const {
    const std::size_t first = out.vertices.size();
    const Card& card = cards_[choice.card];
    for (const std::uint32_t t : card.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t i = leaves_.indices[t + k];
        if (places[i] == ~0U) {
          MeshVertex v = leaves_.vertices[i];
          v.position = choice.place + (v.position - card.middle) * scale;
          places[i] = static_cast<std::uint32_t>(out.vertices.size());
          out.vertices.push_back(v);
        }
        out.indices.push_back(places[i]);
      }
    }
    push_inside(std::span(out.vertices).subspan(first), size_);
  }

  const MeshPart& leaves_;
  PlantSize size_;
  std::vector<Card> cards_;
  std::vector<Choice> chosen_;
};

}  // namespace

float side_coverage(const PlantMesh& mesh, const Silhouette& silhouette, float angle) {
  Raster raster(silhouette, angle);
  raster.draw(mesh.bark, false);
  raster.draw(mesh.leaves, true);
  return raster.share();
}

MeshPart few_cards(const PlantMesh& fine, const MeshPart& bark, const Silhouette& silhouette, std::size_t most) {
  Thinning thinning(fine, silhouette.size);
  thinning.choose_by_group(most);
  return thinning.fitted(fine, bark, silhouette);
}

MeshPart thinned_cards(const PlantMesh& fine, const Silhouette& silhouette, float share) {
  Thinning thinning(fine, silhouette.size);
  thinning.choose_by_hash(share);
  return thinning.fitted(fine, fine.bark, silhouette);
}

std::size_t count_cards(const MeshPart& leaves) { return find_cards(leaves).size(); }

}  // namespace manzana::foliage
