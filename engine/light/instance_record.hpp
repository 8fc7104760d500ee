#ifndef SEPTET_LIGHT_INSTANCE_RECORD_HPP
#define SEPTET_LIGHT_INSTANCE_RECORD_HPP
/// One drawn instance, as vertex attributes that change once an instance: a software device reads those far faster than a storage buffer.
///
/// LIGHT_INSTANCE lists MEMBER(location, type, name) in the order in which they lie in memory: C++ makes a struct of them, a shader its inputs. Shadows go
/// without `tint` and `light`.

#include "engine/light/language.hpp"

#define LIGHT_INSTANCE(MEMBER)                                                                                                     \
  MEMBER(3, vec4, row0) /* Rows of relative_from_object, scale included. */                                                        \
  MEMBER(4, vec4, row1)                                                                                                            \
  MEMBER(5, vec4, row2)                                                                                                            \
  MEMBER(6, vec4, tint) /* rgb: paint. a: how much of the material's emission shines. */                                           \
  MEMBER(                                                                                                                          \
      7, vec4,                                                                                                                     \
      light) /* Share of the sky that reaches it, whether snow lies on it, number of its participant, its height over the road. */ \
  MEMBER(8, vec2, shown) /* Thresholds of the pixels that show it: engine/instant/level_fade.hpp. */

#ifdef __cplusplus
namespace septet::light {

#define LIGHT_STRUCT_MEMBER(location, type, name) type name;
struct InstanceRecord {
  LIGHT_INSTANCE(LIGHT_STRUCT_MEMBER)
};
#undef LIGHT_STRUCT_MEMBER
static_assert(sizeof(InstanceRecord) == 88);

}  // namespace septet::light
#else
#define LIGHT_INPUT(at, type, name) layout(location = at) in type name;
LIGHT_INSTANCE(LIGHT_INPUT)
#endif

#endif
