// The twin of engine/instant/headlight_beam.hpp.

// Share of a dipped beam's peak in a direction, for a lamp that points along `level`; `main_beam`: how far that is lit beside it.
float beam_share(vec3 level, vec3 direction, float main_beam) {
  float ahead = dot(direction, level);
  float down = level.z * ahead - direction.z;
  float aside = max(0.0, 1.0 - down * down - ahead * ahead) / (ahead * ahead);
  float below = smoothstep(0.004, 0.0125, down) / (1.0 + down * down * (400.0 + down * down * 20000.0));
  float above = 0.03 / (1.0 + max(-down, 0.0) * 33.0);
  float dipped = max(below, above) / (1.0 + aside * 59.0);
  float ahead_alone = 1.0 / (1.0 + aside * 500.0 + down * down * (900.0 + down * down * 1e6));
  return ahead <= 0.0 ? 0.0 : dipped + main_beam * 4.0 * ahead_alone;
}
