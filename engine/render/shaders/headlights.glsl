// The twin of engine/instant/headlight_beam.hpp.

// Share of a dipped beam's peak in a direction, for a lamp that points along `level`.
float beam_share(vec3 level, vec3 direction) {
  float ahead = dot(direction, level);
  float down = level.z * ahead - direction.z;
  float aside = max(0.0, 1.0 - down * down - ahead * ahead) / (ahead * ahead);
  float below = smoothstep(0.004, 0.014, down) / (1.0 + down * down * (400.0 + down * down * 20000.0));
  float above = 0.03 / (1.0 + max(-down, 0.0) * 33.0);
  return ahead <= 0.0 ? 0.0 : max(below, above) / (1.0 + aside * 59.0);
}
