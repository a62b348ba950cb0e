#include "scenegraph/draw/photo_layer.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "manzana_draw_shaders.h"

namespace manzana::draw {
namespace {

using glm::ivec2;
using Level = GroundPhoto::Level;

constexpr int kRest = 512, kLeastSide = 256, kMostSide = 4096;
constexpr int kRestLevels = 10;
constexpr std::size_t kMostWindows = 8;
constexpr GLuint kWindowsUnit = 0, kRestUnit = 1;

std::size_t bytes_of_square(int side) {
  return static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * sizeof(GroundPhoto::Texel);
}
std::size_t bytes_of(const Squares& s) {
  return static_cast<std::size_t>(s.size().x) * static_cast<std::size_t>(s.size().y) * sizeof(GroundPhoto::Texel);
}
ivec2 size_of(const Level& level) { return {static_cast<int>(level.columns), static_cast<int>(level.rows)}; }

/// The first that is not larger than what is held as a whole.
std::size_t first_whole(const GroundPhoto& photo) {
  const auto small = [](const Level& l) { return l.columns <= kRest && l.rows <= kRest; };
  return static_cast<std::size_t>(std::ranges::find_if(photo.levels, small) - photo.levels.begin());
}

/// Where one looks at the ground: from above what is below, else, of an orthographic camera, the picture's middle.
Vec2d focus_of(const Camera& camera, double ground_z) {
  const Vec3d& ahead = camera.ray_forward;
  if (!camera.orthographic || ahead.z >= 0) return Vec2d(camera.eye);
  return Vec2d(camera.eye) + Vec2d(ahead) * ((ground_z - camera.eye.z) / ahead.z);
}

/// A part of a level, cut where the window begins again.
void upload(const gl::Texture& texture, GLint layer, const Level& level, const Squares& part, int side) {
  const auto end = [&](int at, int last) { return std::min(last, (at / side + 1) * side); };
  for (int y = part.low.y; y < part.high.y; y = end(y, part.high.y))
    for (int x = part.low.x; x < part.high.x; x = end(x, part.high.x))
      glTextureSubImage3D(texture.name(), 0, x % side, y % side, layer, end(x, part.high.x) - x,
                          end(y, part.high.y) - y, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                          &level.texels[static_cast<std::size_t>(y) * level.columns + static_cast<std::size_t>(x)]);
}

gl::Texture make_texture(GLenum target) {
  GLuint name = 0;
  glCreateTextures(target, 1, &name);
  return gl::Texture(name);
}

}  // namespace

PhotoPieces photo_pieces(bool photo) {
  return photo ? PhotoPieces{shaders::photo_layout_glsl, shaders::photo_glsl} : PhotoPieces{shaders::bare_glsl, ""};
}

PhotoPlan plan_photo(const GroundPhoto& photo, double focal_px, std::size_t most_bytes) {
  const std::size_t whole = first_whole(photo);
  PhotoPlan plan{whole > kMostWindows ? whole - kMostWindows : 0, 0, 0};
  const auto wide = static_cast<unsigned>(std::clamp(2 * focal_px, double{kLeastSide}, double{kMostSide}));
  plan.side = static_cast<int>(std::bit_ceil(wide));
  while (most_bytes > 0 && plan.first < whole && (whole - plan.first) * bytes_of_square(plan.side) > most_bytes)
    plan.side > kLeastSide ? void(plan.side /= 2) : void(++plan.first);
  plan.windows = whole - plan.first;
  return plan;
}

PhotoLayerGpu::PhotoLayerGpu(const GroundPhoto& photo, const PhotoPlan& plan) : plan_(plan), held_(plan.windows) {
  array_ = make_texture(GL_TEXTURE_2D_ARRAY);
  const GLsizei side = plan.windows == 0 ? 1 : plan.side;
  glTextureStorage3D(array_.name(), 1, GL_SRGB8_ALPHA8, side, side, std::max(1, static_cast<int>(plan.windows)));
  glTextureParameteri(array_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  upload_rest(photo);
}

/// Its levels keep their own sizes, in the lower left corners: beyond there is nothing.
void PhotoLayerGpu::upload_rest(const GroundPhoto& photo) {
  rest_ = make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(rest_.name(), kRestLevels, GL_SRGB8_ALPHA8, kRest, kRest);
  glTextureParameteri(rest_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(rest_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(rest_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  for (GLint i = 0; i < kRestLevels; ++i) {
    glClearTexImage(rest_.name(), i, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    const std::size_t level = plan_.first + plan_.windows + static_cast<std::size_t>(i);
    if (level >= photo.levels.size()) continue;
    const ivec2 size = size_of(photo.levels[level]);
    glTextureSubImage2D(rest_.name(), i, 0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE,
                        photo.levels[level].texels.data());
  }
}

std::size_t PhotoLayerGpu::bring(const GroundPhoto& photo, const Camera& camera, double ground_z,
                                 std::size_t most_bytes) {
  const Vec2d focus = (focus_of(camera, ground_z) - photo.origin) / photo.step;
  std::size_t left = 0;
  for (std::size_t w = held_.size(); w-- > 0;)
    left += bring_window(photo, w, focus / std::exp2(static_cast<double>(plan_.first + w)), most_bytes);
  return left;
}

std::size_t PhotoLayerGpu::bring_window(const GroundPhoto& photo, std::size_t window, const Vec2d& focus,
                                        std::size_t& allowed) {
  const Level& level = photo.levels[plan_.first + window];
  const Squares wanted = window_about(focus, plan_.side, size_of(level));
  Squares& held = held_[window];
  held = kept(held, wanted);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(level.columns));
  while (held != wanted && allowed > 0) {
    const Squares strip = next_strip(held, wanted);
    upload(array_, static_cast<GLint>(window), level, strip, plan_.side);
    held = joined(held, strip);
    allowed -= std::min(allowed, bytes_of(strip));
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  return bytes_of(wanted) - bytes_of(held);
}

glsl::PhotoData PhotoLayerGpu::data(const GroundPhoto& photo, const Vec3d& eye) const {
  const double share = std::exp2(-static_cast<double>(plan_.first));
  glsl::PhotoData data{};
  data.place = Vec4(Vec2((Vec2d(eye) - photo.origin) * (share / photo.step)), static_cast<float>(share / photo.step),
                    static_cast<float>(held_.size()));
  data.size = Vec4(Vec2(Vec2d(size_of(photo.levels[0])) * share), static_cast<float>(plan_.side), 0);
  for (std::size_t i = 0; i < held_.size(); ++i) data.held[i] = Vec4(Vec2(held_[i].low), Vec2(held_[i].high));
  return data;
}

void PhotoLayerGpu::bind() const {
  glBindTextureUnit(kWindowsUnit, array_.name());
  glBindTextureUnit(kRestUnit, rest_.name());
}

std::size_t PhotoLayerGpu::device_bytes() const {
  return held_.size() * bytes_of_square(plan_.side) + bytes_of_square(kRest) / 3 * 4;
}

}  // namespace manzana::draw
