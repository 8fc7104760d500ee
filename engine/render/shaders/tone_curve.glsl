// Exposed light to the display's code: the filmic curve of Hejl and Burgess-Dawson (2010), which holds the display's gamma, so
// that neither a power nor an sRGB target is needed. The host's twin is display_code in instant/tone_curve.hpp.
vec3 display_code(vec3 exposed) {
  vec3 x = max(vec3(0.0), exposed - 0.004);
  return x * (6.2 * x + 0.5) / (x * (6.2 * x + 1.7) + 0.06);
}
