#include "scenegraph/import/osm_parts.h"

#include <algorithm>

#include "scenegraph/import/geos.h"

namespace manzana {
namespace {

struct TreeDeleter {
  GEOSContextHandle_t handle;
  void operator()(GEOSSTRtree* tree) const { GEOSSTRtree_destroy_r(handle, tree); }
};

double area(const Geos& geos, const GEOSGeometry* g) {
  double value = 0;
  return g != nullptr && GEOSArea_r(geos.handle(), g, &value) == 1 ? value : 0;
}

/// Lives for one call.
class Coverer {
 public:
  explicit Coverer(std::span<const Polygon> parts)
      : tree_(GEOSSTRtree_create_r(geos_.handle(), 8), TreeDeleter{geos_.handle()}), rows_(parts.size()) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      rows_[i] = static_cast<std::uint32_t>(i);
      parts_.push_back(mended(parts[i]));
      if (parts_[i]) GEOSSTRtree_insert_r(geos_.handle(), tree_.get(), parts_[i].get(), &rows_[i]);
    }
    best_.assign(parts.size(), 0.0);
    out_.outline_of.assign(parts.size(), kNoOutline);
  }

  PartCover run(std::span<const Polygon> outlines) {
    for (std::size_t i = 0; i < outlines.size(); ++i) {
      out_.covered.push_back(parts_.empty() ? 0 : cover(outlines[i], static_cast<std::uint32_t>(i)));
    }
    return std::move(out_);
  }

 private:
  Geometry mended(const Polygon& shape) const {
    const Geometry raw = geos_.polygon(shape);
    return geos_.owned(raw ? GEOSMakeValid_r(geos_.handle(), raw.get()) : nullptr);
  }

  double cover(const Polygon& shape, std::uint32_t outline) {
    const Geometry whole = mended(shape);
    const double size = area(geos_, whole.get());
    if (!(size > 0)) return 0;
    std::vector<Geometry> pieces;
    for (const std::uint32_t part : near(whole.get())) {
      Geometry piece = geos_.owned(GEOSIntersection_r(geos_.handle(), whole.get(), parts_[part].get()));
      const double share = area(geos_, piece.get()) / area(geos_, parts_[part].get());
      if (!(share > 0.5)) continue;
      if (share > best_[part]) {
        best_[part] = share;
        out_.outline_of[part] = outline;
      }
      pieces.push_back(std::move(piece));
    }
    return pieces.empty() ? 0 : area_of_union(std::move(pieces)) / size;
  }

  std::vector<std::uint32_t> near(const GEOSGeometry* whole) const {
    std::vector<std::uint32_t> found;
    const auto note = [](void* item, void* rows) {
      static_cast<std::vector<std::uint32_t>*>(rows)->push_back(*static_cast<std::uint32_t*>(item));
    };
    GEOSSTRtree_query_r(geos_.handle(), tree_.get(), whole, note, &found);
    std::ranges::sort(found);
    return found;
  }

  double area_of_union(std::vector<Geometry> pieces) const {
    const Geometry all = geos_.collection(GEOS_GEOMETRYCOLLECTION, std::move(pieces));
    const Geometry one = geos_.owned(all ? GEOSUnaryUnion_r(geos_.handle(), all.get()) : nullptr);
    return area(geos_, one.get());
  }

  Geos geos_;
  std::unique_ptr<GEOSSTRtree, TreeDeleter> tree_;
  std::vector<std::uint32_t> rows_;
  std::vector<Geometry> parts_;
  std::vector<double> best_;
  PartCover out_;
};

}  // namespace

PartCover cover_by_parts(std::span<const Polygon> outlines, std::span<const Polygon> parts) {
  return Coverer(parts).run(outlines);
}

}  // namespace manzana
