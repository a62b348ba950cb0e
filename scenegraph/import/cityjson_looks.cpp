#include "scenegraph/import/cityjson_looks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "foliage/import/folder_files.h"
#include "foliage/leaf_image.h"

namespace manzana::cityjson {
namespace {

constexpr std::uint64_t kMostBytes = 64U << 20;  // of a picture's file
constexpr double kMostRepeats = 1000;
constexpr int kPlaces = 32;  // a side

/// 0xRRGGBB of the material; kNone where it names none.
std::uint32_t rgb_of(const Json& material) {
  const Json* colour = member(material, "diffuseColor");
  if (colour == nullptr) return kNone;
  const Vec3d c = glm::clamp(vec3_of(*colour, "diffuseColor"), 0.0, 1.0) * 255.0 + 0.5;
  return static_cast<std::uint32_t>(c.r) << 16 | static_cast<std::uint32_t>(c.g) << 8 | static_cast<std::uint32_t>(c.b);
}

Wrap wrap_of(const Json& texture) {
  const std::string mode = text_of(member(texture, "wrapMode"));
  if (mode == "none") return Wrap::none;
  if (mode == "mirror") return Wrap::mirror;
  if (mode == "clamp") return Wrap::clamp;
  return mode == "border" ? Wrap::border : Wrap::repeat;
}

/// Red, green, blue and alpha of 0 to 1; clear where there is none.
std::uint32_t border_of(const Json& texture) {
  const Json* colour = member(texture, "borderColor");
  if (colour == nullptr || !colour->is_array() || colour->size() < 3) return 0;
  std::uint32_t packed = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const bool told = i < colour->size() && (*colour)[i].is_number();
    const double share = told ? std::clamp((*colour)[i].get<double>(), 0.0, 1.0) : i == 3 ? 1 : 0;
    packed |= static_cast<std::uint32_t>(share * 255 + 0.5) << 8 * i;
  }
  return packed;
}

Vec2d place_of(const Json& json) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const bool two = json.is_array() && json.size() >= 2 && json[0].is_number() && json[1].is_number();
  return two ? Vec2d(json[0].get<double>(), json[1].get<double>()) : Vec2d(kNaN);
}

/// Members of an array, or of nothing.
template <class Visit>
void each_of(const Json& parent, const char* name, Visit&& visit) {
  const Json* array = member(parent, name);
  if (array == nullptr || !array->is_array()) return;
  for (const Json& item : *array) visit(item);
}

/// What each theme says: the one of that name first.
std::vector<const Json*> themes_of(const Json& geometry, const char* what, const std::string& first) {
  std::vector<const Json*> themes;
  const Json* all = member(geometry, what);
  if (all == nullptr || !all->is_object()) return themes;
  for (const auto& [name, theme] : all->items()) themes.insert(name == first ? themes.begin() : themes.end(), &theme);
  return themes;
}

/// Without "." and "a/..": so that a picture is one, however it is named.
std::string plain_name(const std::string& image) {
  return std::filesystem::path(image).lexically_normal().generic_string();
}

/// A surface's texture is a list of rings: a texture's number, and then places.
std::uint32_t texture_of(const Json* surface) {
  const bool some = surface != nullptr && surface->is_array() && !surface->empty() && surface->front().is_array() &&
                    !surface->front().empty();
  return some ? number_of(&surface->front().front()) : kNone;
}

std::vector<std::vector<Vec2d>> rings_of(const Json& surface, std::span<const Vec2d> places) {
  std::vector<std::vector<Vec2d>> rings;
  for (const Json& ring : surface) {
    rings.emplace_back();
    for (std::size_t i = 1; ring.is_array() && i < ring.size(); ++i) {
      const std::uint32_t place = number_of(&ring[i]);
      rings.back().push_back(place < places.size() ? places[place] : place_of({}));
    }
  }
  return rings;
}

/// 0 to 1.
double wrapped(double x, Wrap wrap) {
  if (wrap == Wrap::repeat) return x - std::floor(x);
  if (wrap != Wrap::mirror) return std::clamp(x, 0.0, 1.0);
  const double half = x / 2 - std::floor(x / 2);
  return 1 - std::abs(2 * half - 1);
}

/// Inside an odd number of rings.
bool inside(const std::vector<std::vector<Vec2d>>& rings, const Vec2d& p) {
  bool in = false;
  for (const auto& ring : rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Vec2d &a = ring[i], &b = ring[j];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
    }
  return in;
}

/// Linear light times alpha, and alpha.
Vec4 light_of(const std::uint8_t* rgba) {
  const float alpha = static_cast<float>(rgba[3]) / 255;
  const Vec3 light(foliage::linear_of_srgb(rgba[0]), foliage::linear_of_srgb(rgba[1]),
                   foliage::linear_of_srgb(rgba[2]));
  return Vec4(light * alpha, alpha);
}

Vec4 border_light(std::uint32_t border) {
  std::array<std::uint8_t, 4> rgba{};
  for (std::size_t i = 0; i < 4; ++i) rgba[i] = static_cast<std::uint8_t>(border >> 8 * i);
  return light_of(rgba.data());
}

/// Of the texel there, or of what is beyond the edge.
Vec4 texel(const foliage::Picture& picture, const OnPicture& part, const Vec2d& place) {
  const Wrap wrap = part.wrap;
  const bool beyond = std::min(place.x, place.y) < 0 || std::max(place.x, place.y) > 1;
  if (beyond && wrap == Wrap::none) return Vec4(0);
  if (beyond && wrap == Wrap::border) return border_light(part.border);
  const auto index = [](double x, int size) { return std::min(static_cast<int>(x * size), size - 1); };
  const int x = index(wrapped(place.x, wrap), picture.width), y = index(1 - wrapped(place.y, wrap), picture.height);
  return light_of(&picture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                     static_cast<std::size_t>(x))]);
}

std::uint32_t packed_rgb(const Vec3& linear) {
  const auto byte = [](float v) { return std::uint32_t{foliage::srgb_of_linear(v)}; };
  return byte(linear.r) << 16 | byte(linear.g) << 8 | byte(linear.b);
}

/// All of it on the picture: nothing is beyond its edges.
bool on_picture(const OnPicture& part) {
  return std::ranges::all_of(part.rings, [](const auto& ring) {
    return std::ranges::all_of(ring, [](const Vec2d& p) { return p == glm::clamp(p, 0.0, 1.0); });
  });
}

/// The pixels that the part is on, and those beside it.
PicturePart pixels_of(const OnPicture& part, const EncodedPicture& picture) {
  if (!on_picture(part)) return {0, 0, picture.width, picture.height};
  Vec2d low(1), high(0);
  for (const auto& ring : part.rings)
    for (const Vec2d& p : ring) low = glm::min(low, p), high = glm::max(high, p);
  const auto first = [](double at, std::uint32_t n) {
    return static_cast<std::uint32_t>(std::max(0.0, std::floor(at * n) - 1));
  };
  const auto last = [](double at, std::uint32_t n) {
    return static_cast<std::uint32_t>(std::min<double>(n, std::ceil(at * n) + 1));
  };
  const std::uint32_t left = first(low.x, picture.width), top = first(1 - high.y, picture.height);
  return {left, top, last(high.x, picture.width) - left, last(1 - low.y, picture.height) - top};
}

PicturePart merged(const PicturePart& a, const PicturePart& b) {
  if (a.width == 0) return b;
  const std::uint32_t left = std::min(a.left, b.left), top = std::min(a.top, b.top);
  return {left, top, std::max(a.left + a.width, b.left + b.width) - left,
          std::max(a.top + a.height, b.top + b.height) - top};
}

/// A picture among those of a city once something wears it, and how it is worn.
class Wearing {
 public:
  Wearing(Pictures& pictures, const std::filesystem::path& folder, const std::string& image,
          const foliage::Picture& picture)
      : pictures_(pictures), first_(pictures.textures.size()) {
    const auto width = static_cast<std::uint32_t>(picture.width), height = static_cast<std::uint32_t>(picture.height);
    encoded_ = {folder, image, {}, width, height, {}};
  }
  /// From 1. What is all on the picture has no need to know what is beyond.
  std::uint32_t texture(const OnPicture& part) {
    auto& textures = pictures_.textures;
    if (textures.size() == first_) pictures_.encoded.push_back(std::move(encoded_));
    const auto last = static_cast<std::uint32_t>(pictures_.encoded.size() - 1);
    EncodedPicture& picture = pictures_.encoded.back();
    picture.worn = merged(picture.worn, pixels_of(part, picture));
    const Texture own = on_picture(part) ? Texture{last, Wrap::clamp, 0} : Texture{last, part.wrap, part.border};
    const auto at = std::find(textures.begin() + static_cast<std::ptrdiff_t>(first_), textures.end(), own);
    const auto found = static_cast<std::uint32_t>(at - textures.begin());
    if (at == textures.end()) textures.push_back(own);
    return found + 1;
  }

 private:
  Pictures& pictures_;
  std::size_t first_;
  EncodedPicture encoded_;
};

}  // namespace

std::uint32_t mean_colour(const foliage::Picture& picture, const OnPicture& part) {
  Vec2d low(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto& ring : part.rings)
    for (const Vec2d& p : ring) {
      if (!(std::max(std::abs(p.x), std::abs(p.y)) <= kMostRepeats)) return kNone;
      low = glm::min(low, p), high = glm::max(high, p);
    }
  if (part.rings.empty() || !(low.x <= high.x)) return kNone;
  Vec4 sum(0);
  bool any = false;
  for (int i = 0; i < kPlaces * kPlaces; ++i) {
    const Vec2d at = low + (high - low) * Vec2d(i % kPlaces + 0.5, i / kPlaces + 0.5) / double{kPlaces};
    if (inside(part.rings, at)) any = true, sum += texel(picture, part, at);
  }
  if (!any)  // thinner than the places are apart
    for (const Vec2d& p : part.rings.front()) sum += texel(picture, part, p);
  return sum.w > 0 ? packed_rgb(Vec3(sum) / sum.w) : kNone;
}

Appearance appearance_of(const Json& document, std::vector<Issue>& issues) {
  Appearance looks;
  const Json* said = member(document, "appearance");
  if (said == nullptr) return looks;
  each_of(*said, "materials", [&](const Json& material) {
    looks.materials.push_back(kNone);
    try {
      looks.materials.back() = rgb_of(material);
    } catch (const std::runtime_error& error) {
      issues.push_back({"material " + std::to_string(looks.materials.size() - 1), error.what()});
    }
  });
  each_of(*said, "textures", [&](const Json& texture) {
    looks.textures.push_back({text_of(member(texture, "image")), wrap_of(texture), border_of(texture)});
  });
  each_of(*said, "vertices-texture", [&](const Json& place) { looks.places.push_back(place_of(place)); });
  looks.material_theme = text_of(member(*said, "default-theme-material"));
  looks.texture_theme = text_of(member(*said, "default-theme-texture"));
  return looks;
}

std::vector<std::uint32_t> materials_of(const Json& geometry, const Appearance& looks) {
  std::vector<std::uint32_t> colours(value_of_each(geometry, nullptr).size(), kNone);
  for (const Json* theme : themes_of(geometry, "material", looks.material_theme)) {
    const std::uint32_t all = number_of(member(*theme, "value"));
    const std::vector<const Json*> each = value_of_each(geometry, member(*theme, "values"));
    for (std::size_t i = 0; i < colours.size(); ++i) {
      const std::uint32_t own = number_of(each[i]), material = own == kNone ? all : own;
      if (colours[i] == kNone && material < looks.materials.size()) colours[i] = looks.materials[material];
    }
  }
  return colours;
}

bool Worn::add(const Json& geometry, const Appearance& looks, std::uint32_t first_surface) {
  std::vector<bool> known;
  for (const Json* theme : themes_of(geometry, "texture", looks.texture_theme)) {
    const std::vector<const Json*> each = value_of_each(geometry, member(*theme, "values"));
    known.resize(each.size());
    for (std::uint32_t i = 0; i < each.size(); ++i) {
      const std::uint32_t texture = texture_of(each[i]);
      if (known[i] || texture >= looks.textures.size()) continue;
      known[i] = true;
      const auto& [image, wrap, border] = looks.textures[texture];
      by_picture_[plain_name(image)].push_back({first_surface + i, wrap, rings_of(*each[i], looks.places), border});
    }
  }
  return std::ranges::find(known, true) != known.end();
}

void Worn::paint(const std::optional<std::filesystem::path>& folder, std::vector<Issue>& issues, Pictures& pictures,
                 const Take& take) const {
  std::size_t absent = 0;
  for (const auto& [image, parts] : by_picture_) try {
      const auto bytes = foliage::FolderFiles(folder, kMostBytes).read(image);
      if (!bytes && ++absent > 0) continue;
      const foliage::Picture picture = foliage::decode_picture(*bytes);
      Wearing wearing(pictures, *folder, image, picture);
      for (const OnPicture& part : parts)
        if (const std::uint32_t rgb = mean_colour(picture, part); rgb != kNone) take(part, rgb, wearing.texture(part));
    } catch (const std::runtime_error& error) {
      issues.push_back({"texture", error.what()});
    }
  if (absent > 0)
    issues.push_back({"appearance", std::to_string(absent) + " of " + std::to_string(by_picture_.size()) +
                                        " pictures of textures are not beside the file"});
}

void wear(ConstructionFeature& shape, std::uint32_t face, std::span<const std::uint32_t> number, const OnPicture& part,
          std::uint32_t texture) {
  const std::uint32_t first = face == 0 ? 0 : shape.faces[face - 1].last_ring, last = shape.faces[face].last_ring;
  if (part.rings.size() != last - first) return;
  const auto corners = [&](auto&& visit) {
    for (std::uint32_t r = first; r < last; ++r)
      for (std::uint32_t c = r == 0 ? 0 : shape.ring_last[r - 1]; c < shape.ring_last[r]; ++c)
        if (!visit(c, part.rings[r - first])) return false;
    return true;
  };
  if (!corners([&](std::uint32_t c, const auto& ring) { return number[c] < ring.size(); })) return;
  shape.uv.resize(shape.corners.size(), Vec2(0));
  corners([&](std::uint32_t c, const auto& ring) { return shape.uv[c] = Vec2(ring[number[c]]), true; });
  shape.faces[face].texture = texture;
}

}  // namespace manzana::cityjson
