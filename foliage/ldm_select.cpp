#include "foliage/ldm_select.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "foliage/ldm_views.h"

namespace manzana::foliage {
namespace {

using Share = LdmSelection::Share;

/// As place_tree() of foliage/shaders/select.glsl.
Vec4 row_of(const Vec4& axis, const TreeSite& site) {
  const Vec3 a(axis);
  const float c = site.turn.x, s = site.turn.y;
  return {site.radius * (a.x * c + a.y * s), site.radius * (a.y * c - a.x * s), site.height * a.z,
          glm::dot(a, site.position) + axis.w};
}

LdmTree placed(const TreeSite& site, std::span<const Vec4> rows) {
  const Vec4* row = &rows[std::size_t{3} * site.block];
  return {row_of(row[0], site), row_of(row[1], site), row_of(row[2], site), Vec3(0), site.hash};
}

/// To the eye, in the plant's frame: rows of blocks are of unit length and across each other.
Vec3 eye_of(const TreeSite& site, std::span<const Vec4> rows, const LdmTree& tree) {
  const Vec4* row = &rows[std::size_t{3} * site.block];
  const Vec3 eye = -(Vec3(row[0]) * tree.row_x.w + Vec3(row[1]) * tree.row_y.w + Vec3(row[2]) * tree.row_z.w);
  const float c = site.turn.x, s = site.turn.y;
  return {(eye.x * c + eye.y * s) / site.radius, (eye.y * c - eye.x * s) / site.radius, eye.z / site.height};
}

class Chooser {
 public:
  Chooser(const LdmTable& table, const LdmSeen& seen, LdmSelection& selection)
      : table_(table), seen_(seen), out_(selection) {}

  void add(const LdmFar& far, std::uint32_t of_pack) {
    const TreeSite& site = seen_.sites[far.site];
    const LdmPack& pack = table_.packs[of_pack];
    const LdmTree tree = placed(site, seen_.block_rows);
    const Vec3 eye = eye_of(site, seen_.block_rows, tree) - pack.centre;
    const float distance = glm::length(eye);
    if (!(distance > 0) || !std::isfinite(distance)) return;
    out_.trees.push_back(tree);
    if (pack.options.sides != LdmSides::paper) out_.trees.back().to_eye = eye / distance;
    out_.distances.push_back(distance * std::max(site.radius, site.height));
    const double like_preset = static_cast<double>(distance) * pack.options.focal_px / seen_.focal_px;
    share_out(of_pack, far.share, ldm_weights(pack, eye), ldm_ring(pack, like_preset));
  }

  void write(bool sorted) {
    for (std::size_t rank = 0; rank < out_.shares.size(); ++rank) {
      const auto first = static_cast<std::uint32_t>(out_.groups.size());
      if (sorted)
        std::stable_sort(out_.shares[rank].begin(), out_.shares[rank].end(), [&](const Share& a, const Share& b) {
          return out_.distances[a.tree] > out_.distances[b.tree];
        });
      for (const Share& share : out_.shares[rank]) write(share);
      out_.ranks[rank] = {first, static_cast<std::uint32_t>(out_.groups.size())};
    }
  }

 private:
  void share_out(std::uint32_t plant, float all, const LdmWeights& weights, const LdmRing& ring) {
    const auto tree = static_cast<std::uint32_t>(out_.trees.size() - 1);
    float low = 0;
    std::size_t rank = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (int step = 0; step < 2; ++step) {
        const float weight = all * weights.weight[i] * (step == 0 ? 1 - ring.next : ring.next);
        if (!(weight > 0)) continue;
        const LdmSide& side = table_.packs[plant].sides[weights.side[i]];
        Run run = side.mosaics[static_cast<std::size_t>(ring.level + step)];
        run.first += table_.first_mosaic[plant], run.last += table_.first_mosaic[plant];
        out_.shares[rank++].push_back({tree, table_.first_side[plant] + weights.side[i], run, low, low + weight,
                                       table_.packs[plant].grown[static_cast<std::size_t>(ring.level + step)]});
        low += weight;
      }
    }
    if (rank > 0) out_.shares[rank - 1].back().high = all;  // whatever rounding left
  }

  void write(const Share& share) {
    const auto item = static_cast<std::uint32_t>(out_.items.size());
    out_.items.push_back({share.tree, share.side, share.mosaics.last, 0, share.low, share.high, share.grown, 0});
    for (std::uint32_t m = share.mosaics.first; m < share.mosaics.last; m += glsl::kLdmGroup)
      out_.groups.emplace_back(item, m);
    out_.mosaics += share.mosaics.size();
  }

  const LdmTable& table_;
  const LdmSeen& seen_;
  LdmSelection& out_;
};

LdmSideHead head_of(const LdmPack& pack, const LdmSide& side) {
  const float r = pack.radius, pixel = 2 * r / kLdmPixels;
  LdmSideHead head{};
  head.origin = Vec4(pack.centre + r * (side.towards - side.right - side.up), 0);
  head.right = Vec4(pixel * side.right, 0);
  head.up = Vec4(pixel * side.up, 0);
  head.inward = Vec4(-2 * r / 65535 * side.towards, 0);
  head.height = pack.height_m;
  return head;
}

}  // namespace

LdmTable make_ldm_table(std::span<const LdmPack> packs) {
  LdmTable table{packs, {}, {}, {}};
  std::uint32_t mosaics = 0, blocks = 0, pages = 0;
  for (const LdmPack& pack : packs) {
    table.first_side.push_back(static_cast<std::uint32_t>(table.sides.size()));
    table.first_mosaic.push_back(mosaics);
    for (const LdmSide& side : pack.sides) {
      LdmSideHead& head = table.sides.emplace_back(head_of(pack, side));
      head.first_block = blocks;
      head.number = static_cast<std::uint32_t>(table.sides.size() - 1) - table.first_side.back();
      head.first_page = pages;
    }
    mosaics += static_cast<std::uint32_t>(pack.mosaics.size());
    blocks += static_cast<std::uint32_t>(pack.blocks.size());
    pages += static_cast<std::uint32_t>(pack.pages());
  }
  return table;
}

namespace {

void clear(LdmSelection& selection) {
  selection.trees.clear();
  selection.items.clear();
  selection.groups.clear();
  selection.mosaics = 0;
  selection.distances.clear();
  for (auto& rank : selection.shares) rank.clear();
}

}  // namespace

void choose_ldm(const LdmTable& table, const LdmSeen& seen, bool sorted, LdmSelection& selection) {
  clear(selection);
  Chooser chooser(table, seen, selection);
  for (const Run& run : seen.runs)
    for (std::uint32_t i = run.first; i < run.last; ++i) chooser.add({i}, seen.sites[i].plant);
  chooser.write(sorted);
}

void choose_ldm(const LdmTable& table, const LdmSeen& seen, std::span<const LdmFar> trees,
                std::span<const std::uint32_t> packs, LdmSelection& selection) {
  clear(selection);
  Chooser chooser(table, seen, selection);
  for (const LdmFar& tree : trees) chooser.add(tree, packs[seen.sites[tree.site].plant]);
  chooser.write(false);
}

}  // namespace manzana::foliage
