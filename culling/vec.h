#pragma once
/// The vector types of the project. Double positions are metres in the scene frame L (scenegraph/local_frame.h: x east,
/// y north, z up at the anchor); float positions are always relative to some origin that is named beside them.
#include <glm/glm.hpp>

namespace manzana {
using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Vec2d = glm::dvec2;
using Vec3d = glm::dvec3;
using Vec4d = glm::dvec4;
using Mat3 = glm::mat3;
using Mat3d = glm::dmat3;
using Mat4 = glm::mat4;
using Mat4d = glm::dmat4;
}  // namespace manzana
