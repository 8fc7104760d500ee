// The cascade that is drawn. The host's twin is CascadeConstants in passes/shadow_pass.cpp.

layout(push_constant) uniform Cascade {
  mat4 clip_from_relative;
  vec2 first_texel;  // Number of its corner's texel over the world: a pattern that came along with the eye would crawl.
} cascade;
