// Division of the pixels between two levels of detail that fade into each other: engine/instant/level_fade.hpp.

// Threshold of a pixel: neighbours' lie far apart, and those of any few adjacent pixels are spread evenly over [0, 1):
// an additive recurrence in two dimensions, by the powers of the plastic number's inverse (Roberts 2018).
float threshold_at(vec2 pixel) { return fract(dot(floor(pixel), vec2(0.7548777, 0.5698403))); }

bool is_shown(vec2 shown, vec2 pixel) {
  float threshold = threshold_at(pixel);
  return threshold >= shown.x && threshold < shown.y;
}
