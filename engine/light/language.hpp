#ifndef SEPTET_LIGHT_LANGUAGE_HPP
#define SEPTET_LIGHT_LANGUAGE_HPP
/// The common language of this folder: every header here is C++20 with GLM and GLSL 4.60 at once.
///
/// The look of a surface is worked out by the rasteriser's shaders and by the ray tracer's C++. Both include the same header, so that a formula, a
/// number and a record that crosses to the device stand once. GLM has GLSL's names, so that the text of a function is plain GLSL, within these rules:
///
/// - LIGHT_BEGIN and LIGHT_END enclose the text (namespace septet::light of C++), LIGHT_FN begins a function, LIGHT_CONST a constant.
/// - LIGHT_RECORD(type, last member, number of vectors) follows a record that crosses to the device: it has no gaps.
/// - Literals have their `f`, numbers are converted by name (float(n)), vectors are built by constructors: vec3(x, y, z).
/// - Components are x, y, z and w; several at once (xyz) neither language has in common: vec3(v) is the first three of a vec4.
/// - Arguments are values. What has several results returns a struct, whose members are set one by one.
/// - An include guard stands where C++ alone would have `#pragma once`, which GLSL does not know.
/// - Only this folder and, here, GLM are included. Textures and buffers are the callers': values are passed in. So are the derivatives of
///   a pixel, which the rasteriser alone has.
///
/// Pure functions; any thread. tests/engine/light runs each of them on a device and on the host.

#ifdef __cplusplus

#include <cstddef>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

namespace septet::light {
using glm::ivec2, glm::ivec3, glm::uvec2, glm::vec2, glm::vec3, glm::vec4, glm::mat4;
using uint = std::uint32_t;
using glm::abs, glm::sign, glm::floor, glm::fract, glm::min, glm::max, glm::clamp, glm::mix, glm::step, glm::smoothstep;
using glm::any, glm::lessThan, glm::greaterThanEqual;
using glm::dot, glm::cross, glm::length, glm::normalize, glm::reflect;
using glm::exp, glm::exp2, glm::sqrt, glm::inversesqrt, glm::pow, glm::cos, glm::sin;
}  // namespace septet::light

#define LIGHT_BEGIN namespace septet::light {
#define LIGHT_END }
#define LIGHT_FN inline
#define LIGHT_CONST inline constexpr
#define LIGHT_RECORD(type, last, vectors) \
  static_assert(sizeof(type) == 16 * (vectors) && offsetof(type, last) + sizeof(type::last) == sizeof(type));

#else

#define LIGHT_BEGIN
#define LIGHT_END
#define LIGHT_FN
#define LIGHT_CONST const
#define LIGHT_RECORD(type, last, vectors)

#endif

LIGHT_BEGIN

LIGHT_CONST float pi = 3.14159265f;

LIGHT_END

#endif
