// The twin of engine/instant/headlight_beam.hpp.

// Share of a dipped beam's peak in a direction, for a lamp that points along `level`, over `times`; `main_beam`: how far that is lit beside it.
// All its fractions are one, as divisions cost most.
float beam_share(vec3 level, vec3 direction, float main_beam, float times) {
  float ahead = dot(direction, level), ahead2 = ahead * ahead;
  float down = level.z * ahead - direction.z, down2 = down * down;
  float aside = max(0.0, 1.0 - down2 - ahead2), falls = 1.0 + down2 * (400.0 + down2 * 20000.0);
  float dipped = max(smoothstep(0.004, 0.0125, down), 0.03 * falls);
  float over = falls * (1.0 + max(-down, 0.0) * 33.0) * (ahead2 + aside * 59.0);
  float over_main = ahead2 + aside * 500.0 + ahead2 * down2 * (900.0 + down2 * 1e6);
  if (main_beam != 0.0) dipped = dipped * over_main + main_beam * 4.0 * over, over *= over_main;
  return ahead <= 0.0 ? 0.0 : ahead2 * dipped / (over * times);
}
