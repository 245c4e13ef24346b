// What a file under shaders/shared/ opens with, so that one text compiles as GLSL 4.50 and as C++20. A shared file looks like this:
//
//   #ifndef RG_SHARED_THING_GLSL
//   #define RG_SHARED_THING_GLSL
//   #include "shared/compat.glsl"
//   RG_SHARED_BEGIN
//   RG_CONST float kGravity_mps2 = 9.81f;
//   struct Thing { vec4 a; uint b; uint c; uint d; uint e; };
//   RG_SIZE(Thing, 32)
//   RG_FN float fall(float t_s) { return 0.5f * kGravity_mps2 * t_s * t_s; }
//   RG_FN void split(RG_IN(vec4) v, RG_OUT(float) a, RG_INOUT(float) sum) { a = v.x; sum += a; }
//   RG_SHARED_END
//   #endif
//
// RG_EXACT float x = ...; is worked out as it stands: what compilers for GPUs put in another order rounds otherwise than C++ does.
// Rules that make both meanings the same: literals end in f or u; no swizzles but xy(v), xyz(v); conversions are written out (float(n)); no vec3
// in structs that lie in buffers (std430 pads it to 16 bytes, C++ does not); names must not be GLSL keywords (sample, input, output, half ...).
#ifndef RG_SHARED_COMPAT_GLSL
#define RG_SHARED_COMPAT_GLSL

#ifdef __cplusplus

#include <cstdint>
#include <glm/glm.hpp>

#define RG_SHARED_BEGIN namespace rg::shared {
#define RG_SHARED_END }
#define RG_FN inline
#define RG_CONST inline constexpr
#define RG_EXACT
#define RG_IN(T) const T&
#define RG_OUT(T) T&
#define RG_INOUT(T) T&
#define RG_SIZE(T, bytes) static_assert(sizeof(T) == (bytes), #T " must lie in a buffer as GLSL's std430 lays it out");

namespace rg::shared {
using uint = std::uint32_t;
using glm::ivec2, glm::ivec3, glm::ivec4, glm::uvec2, glm::uvec3, glm::uvec4, glm::bvec2, glm::bvec3, glm::bvec4;
using glm::vec2, glm::vec3, glm::vec4, glm::mat2, glm::mat3, glm::mat4;

using glm::abs, glm::ceil, glm::clamp, glm::floor, glm::fract, glm::isinf, glm::isnan, glm::max, glm::min, glm::mix, glm::mod, glm::round,
    glm::sign, glm::smoothstep, glm::step, glm::trunc;
using glm::acos, glm::asin, glm::atan, glm::cos, glm::cosh, glm::degrees, glm::radians, glm::sin, glm::sinh, glm::tan, glm::tanh;
using glm::cross, glm::distance, glm::dot, glm::faceforward, glm::length, glm::normalize, glm::reflect, glm::refract;
using glm::determinant, glm::inverse, glm::transpose;
using glm::exp, glm::exp2, glm::inversesqrt, glm::log, glm::log2, glm::pow, glm::sqrt;
using glm::floatBitsToInt, glm::floatBitsToUint, glm::intBitsToFloat, glm::uintBitsToFloat;
using glm::bitCount, glm::findLSB, glm::findMSB;
using glm::packHalf2x16, glm::packSnorm2x16, glm::packUnorm2x16, glm::unpackHalf2x16, glm::unpackSnorm2x16, glm::unpackUnorm2x16;
using glm::all, glm::any, glm::equal, glm::greaterThan, glm::greaterThanEqual, glm::lessThan, glm::lessThanEqual, glm::notEqual;
}  // namespace rg::shared

#else

#define RG_SHARED_BEGIN
#define RG_SHARED_END
#define RG_FN
#define RG_CONST const
#define RG_EXACT precise
#define RG_IN(T) in T
#define RG_OUT(T) out T
#define RG_INOUT(T) inout T
#define RG_SIZE(T, bytes)

#endif

RG_SHARED_BEGIN
RG_FN vec2 xy(vec3 v) { return vec2(v.x, v.y); }
RG_FN vec2 xy(vec4 v) { return vec2(v.x, v.y); }
RG_FN vec3 xyz(vec4 v) { return vec3(v.x, v.y, v.z); }
RG_SHARED_END

#endif
