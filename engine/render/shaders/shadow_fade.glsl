// Texels of the shadow map that a level of detail casts into.

#include "shadow_cascade.glsl"
#include "fade.glsl"

layout(location = 0) in vec4 uv_shown;

bool casts_here() { return is_shown(uv_shown.zw, mod(gl_FragCoord.xy + cascade.first_texel.xy, 1024.0)); }
