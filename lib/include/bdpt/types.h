#pragma once

/// @file
/// Names the vectors, matrices and colours of the library.
///
/// @code{.cpp}
/// const bdpt::Rgb warm_white(1.0f, 0.8f, 0.6f);
/// const bdpt::Vec3 position(0.0f, 2.0f, 0.0f);
/// bdpt::Mat4 world_from_object(1.0f);
/// world_from_object[3] = bdpt::Vec4(position, 1.0f);  // moves an object there
/// @endcode

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace bdpt {

using Vec2 = glm::vec2;    ///< two floats
using Vec3 = glm::vec3;    ///< three floats: a point [m], a direction, a normal
using Vec4 = glm::vec4;    ///< four floats
using DVec3 = glm::dvec3;  ///< three doubles: a place on a map [m]
using UVec3 = glm::uvec3;  ///< three vertex indices of a triangle
using Mat3 = glm::mat3;    ///< in columns
using Mat4 = glm::mat4;    ///< in columns

/// Linear Rec. 709 triple: radiance [nit = cd/m^2], importance, or a unitless weight.
using Rgb = glm::vec3;

}  // namespace bdpt
