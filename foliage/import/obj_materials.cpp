#include "foliage/import/obj_materials.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "foliage/import/obj_lines.h"
#include "foliage/import/plant_image.h"

namespace manzana::foliage {
namespace {

constexpr std::size_t kMostMaterials = 4096, kMostPictures = 64;

/// map_Kd's options come before the name, which may hold blanks.
std::string picture_name(ObjLine& line) {
  std::string name(line.rest());
  if (name.starts_with('-')) name = name.substr(name.find_last_of(" \t") + 1);
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

/// The first channel of `from`, as alpha of `to`.
void take_alpha(const Picture& from, Picture& to) {
  const auto at = [](int i, int size, int other) { return static_cast<std::size_t>(std::int64_t{i} * other / size); };
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x)
      to.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(to.width) + static_cast<std::size_t>(x)) +
              3] = from.rgba[4 * (at(y, to.height, from.height) * static_cast<std::size_t>(from.width) +
                                  at(x, to.width, from.width))];
}

bool has_holes(const Picture& picture) {
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4)
    if (picture.rgba[i] < 128) return true;
  return false;
}

std::function<Image()> kept(Image image) {
  return [shared = std::make_shared<Image>(std::move(image))] { return *shared; };
}

}  // namespace

void ObjMaterials::add_library(const std::string& name) {
  if (!files_.has_folder()) return;
  const auto bytes = files_.read(name);
  if (!bytes) return notes_.push_back("its library " + name + " is absent");
  try {
    read_library({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  } catch (const std::runtime_error& error) {
    notes_.push_back("its library " + name + ": " + error.what());
  }
}

void ObjMaterials::read_library(std::string_view text) {
  ObjLines lines(text);
  Look* look = nullptr;
  while (auto line = lines.next()) {
    const std::string_view word = line->word();
    if (word == "newmtl") {
      if (looks_.size() >= kMostMaterials) line->fail("more than 4096 materials");
      look = &looks_[std::string(line->rest())];
    } else if (look != nullptr && word == "Kd") {
      for (int c = 0; c < 3; ++c) look->colour[c] = static_cast<float>(std::clamp(line->number_or(1), 0.0, 1.0));
    } else if (look != nullptr && word == "map_Kd") {
      look->picture = picture_name(*line);
    } else if (look != nullptr && word == "map_d") {
      look->alpha = picture_name(*line);
    }
  }
}

int ObjMaterials::number(std::string_view name) {
  const auto found = numbers_.find(name);
  if (found != numbers_.end()) return found->second;
  if (names_.size() >= kMostMaterials) throw std::runtime_error("more than 4096 materials");
  names_.emplace_back(name);
  return numbers_.emplace(names_.back(), static_cast<int>(names_.size()) - 1).first->second;
}

std::vector<SourceMaterial> ObjMaterials::taken() {
  std::vector<SourceMaterial> out;
  for (const std::string& name : names_) out.push_back(material(name));
  return out;
}

SourceMaterial ObjMaterials::material(const std::string& name) {
  SourceMaterial out;
  const auto found = looks_.find(name);
  const Look look = found == looks_.end() ? Look{} : found->second;
  if (!look.picture.empty() || !look.alpha.empty()) wear_picture(look, out);
  out.name = name;
  if (!out.image) out.image = [colour = look.colour] { return plant_image(plain_picture(), {Vec4(colour, 1), {}}); };
  return out;
}

/// A picture is worn as it is: many programs write a black Kd beside it.
void ObjMaterials::wear_picture(const Look& look, SourceMaterial& out) {
  const std::string key = look.picture + '\n' + look.alpha;
  if (const auto found = worn_.find(key); found != worn_.end()) {
    out = found->second;
    return;
  }
  if (worn_.size() >= kMostPictures) throw std::runtime_error("more than 64 textures");
  const auto decoded = [&](const std::string& name) -> std::optional<Picture> {
    if (name.empty()) return std::nullopt;
    const auto bytes = files_.read(name);
    if (!bytes) {
      notes_.push_back("its texture " + name + " is absent");
      return std::nullopt;
    }
    try {
      return decode_picture(*bytes);
    } catch (const std::runtime_error& error) {
      notes_.push_back(name + ": " + error.what());
      return std::nullopt;
    }
  };
  std::optional<Picture> picture = decoded(look.picture), alpha;
  if (look.alpha != look.picture) alpha = decoded(look.alpha);
  if (picture && alpha) take_alpha(*alpha, *picture);
  if (picture) {
    out.cut_out = has_holes(*picture);
    Tint tint;
    if (out.cut_out) tint.alpha_cutoff = 0.5F;
    out.image = kept(plant_image(*picture, tint));
  }
  worn_[key] = out;
}

}  // namespace manzana::foliage
