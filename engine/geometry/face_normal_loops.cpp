#include "engine/geometry/face_normal_loops.hpp"

#include <cmath>

namespace septet {
namespace {

template <int Degree, bool Unit>
void polynomial(const float* const* planes, std::size_t count, float t, float* const* out) {
  const float* __restrict p[3 * (Degree + 1)];
  for (int n = 0; n < 3 * (Degree + 1); ++n) p[n] = planes[n];
  float* __restrict x = out[0];
  float* __restrict y = out[1];
  float* __restrict z = out[2];
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    float a = p[3 * Degree][i], b = p[3 * Degree + 1][i], c = p[3 * Degree + 2][i];
#pragma GCC unroll 3
    for (int n = Degree - 1; n >= 0; --n) {
      a = a * t + p[3 * n][i];
      b = b * t + p[3 * n + 1][i];
      c = c * t + p[3 * n + 2][i];
    }
    // The smallest addend keeps a vector of length zero from dividing by it.
    const float scale = Unit ? 1.0f / std::sqrt(a * a + b * b + c * c + 1e-35f) : 1.0f;
    x[i] = a * scale;
    y[i] = b * scale;
    z[i] = c * scale;
  }
}

}  // namespace

void polynomial_2(const float* const* planes, std::size_t count, float t, float* const* out) {
  polynomial<2, false>(planes, count, t, out);
}
void unit_polynomial_1(const float* const* planes, std::size_t count, float t, float* const* out) {
  polynomial<1, true>(planes, count, t, out);
}
void unit_polynomial_2(const float* const* planes, std::size_t count, float t, float* const* out) {
  polynomial<2, true>(planes, count, t, out);
}
void unit_polynomial_3(const float* const* planes, std::size_t count, float t, float* const* out) {
  polynomial<3, true>(planes, count, t, out);
}

}  // namespace septet
