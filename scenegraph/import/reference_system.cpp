#include "scenegraph/import/reference_system.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#ifdef MANZANA_PROJ
#include <proj.h>
#endif

namespace manzana {
namespace {

[[noreturn]] void refuse(const std::string& name, const char* what) {
  throw std::runtime_error("reference system " + name.substr(0, 80) + ": " + what);
}

bool is_wgs84(const std::string& name) { return name == "EPSG:4326" || name == "EPSG:4979" || name == "OGC:CRS84"; }

/// "EPSG:1234": nothing else is handed to PROJ, whose own names could open files.
bool is_code(const std::string& name) {
  const std::size_t colon = name.find(':');
  const auto all = [](std::string_view part, const char* of) {
    return !part.empty() && part.find_first_not_of(of) == std::string_view::npos;
  };
  return colon != std::string::npos && name.size() < 40 &&
         all(std::string_view(name).substr(0, colon), "ABCDEFGHIJKLMNOPQRSTUVWXYZ") &&
         all(std::string_view(name).substr(colon + 1), "0123456789");
}

#ifdef MANZANA_PROJ
struct PjDeleter {
  void operator()(PJ* pj) const { proj_destroy(pj); }
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
using Pj = std::unique_ptr<PJ, PjDeleter>;
using Context = std::unique_ptr<PJ_CONTEXT, PjDeleter>;

/// Metres of a unit of an axis; 1 where there is none.
double axis_unit(PJ_CONTEXT* context, const PJ* crs, int axis) {
  const Pj system(proj_crs_get_coordinate_system(context, crs));
  double unit = 1;
  if (system == nullptr || proj_cs_get_axis_count(context, system.get()) <= axis) return 1;
  proj_cs_get_axis_info(context, system.get(), axis, nullptr, nullptr, nullptr, &unit, nullptr, nullptr, nullptr);
  return unit > 0 ? unit : 1;
}

struct Projection {
  Context context{proj_context_create()};
  Pj to_wgs84;
  double height_unit = 1;

  explicit Projection(const std::string& name) {
    proj_context_set_enable_network(context.get(), 0);
    proj_log_level(context.get(), PJ_LOG_NONE);
    Pj crs(proj_create(context.get(), name.c_str()));
    if (crs == nullptr || proj_is_crs(crs.get()) == 0) refuse(name, "PROJ does not know it");
    height_unit = axis_unit(context.get(), crs.get(), 2);
    if (proj_get_type(crs.get()) == PJ_TYPE_COMPOUND_CRS) {
      if (const Pj up{proj_crs_get_sub_crs(context.get(), crs.get(), 1)})
        height_unit = axis_unit(context.get(), up.get(), 0);
      crs.reset(proj_crs_get_sub_crs(context.get(), crs.get(), 0));
    }
    const Pj wgs84(proj_create(context.get(), "EPSG:4326"));
    const Pj steps(crs && wgs84
                       ? proj_create_crs_to_crs_from_pj(context.get(), crs.get(), wgs84.get(), nullptr, nullptr)
                       : nullptr);
    if (steps) to_wgs84.reset(proj_normalize_for_visualization(context.get(), steps.get()));
    if (to_wgs84 == nullptr) refuse(name, "PROJ has no way from it to WGS 84");
  }

  GeoPoint to_geo(const Vec3d& p) {
    const PJ_COORD at = proj_trans(to_wgs84.get(), PJ_FWD, proj_coord(p.x, p.y, 0, 0));
    return {at.xy.y, at.xy.x, p.z * height_unit};
  }
};
#else
struct Projection {
  explicit Projection(const std::string& name) { refuse(name, "needs PROJ, which this build is without"); }
  GeoPoint to_geo(const Vec3d&) { return {}; }
};
#endif

}  // namespace

struct ReferenceSystem::State {
  bool anywhere = false;  // none
  std::optional<Vec3d> first;
  LocalFrame frame;
  std::optional<Projection> projection;

  GeoPoint to_geo(const Vec3d& p) {
    if (projection) return projection->to_geo(p);
    if (!anywhere) return {p.y, p.x, p.z};
    if (!first) first = p;
    const Vec2d plan(p - *first);
    const GeoPoint place = frame.to_geo({plan, frame.ground_z(plan)});
    return {place.lat_deg, place.lon_deg, p.z};
  }
};

ReferenceSystem::ReferenceSystem(const std::string& name) : state_(std::make_unique<State>()) {
  const std::string code = short_name(name);
  state_->anywhere = code.empty();
  if (code.empty() || is_wgs84(code)) return;
  if (!is_code(code)) refuse(code, "is not a name like EPSG:28992");
  state_->projection.emplace(code);
}
ReferenceSystem::~ReferenceSystem() = default;
ReferenceSystem::ReferenceSystem(ReferenceSystem&&) noexcept = default;
ReferenceSystem& ReferenceSystem::operator=(ReferenceSystem&&) noexcept = default;

std::optional<GeoPoint> ReferenceSystem::to_geo(const Vec3d& xyz) {
  constexpr double kMost = 1e9;  // metres, or whatever: more than any map has
  if (!glm::all(glm::lessThan(glm::abs(xyz), Vec3d(kMost)))) return {};
  const GeoPoint place = state_->to_geo(xyz);
  const bool sound = std::isfinite(place.lat_deg) && std::abs(place.lon_deg) <= 540 && valid(place);
  return sound ? std::optional(place) : std::nullopt;
}

std::string short_name(const std::string& reference_system) {
  std::string name = reference_system.substr(0, reference_system.find('&'));  // a compound: horizontal comes first
  std::ranges::transform(name, name.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  if (name.find("CRS84") != std::string::npos) return "OGC:CRS84";
  for (const char* authority : {"EPSG", "ESRI"}) {
    const std::size_t at = name.rfind(authority);
    if (at == std::string::npos) continue;
    const std::size_t code = name.find_last_of(":/");
    if (code == std::string::npos || code < at) continue;
    return std::string(authority) + ":" + name.substr(code + 1);
  }
  return name;
}

}  // namespace manzana
