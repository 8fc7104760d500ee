#include "engine/math/spherical_interpolation.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/check.hpp"

namespace septet {

Quat slerp_quadratic(const Quat& from, const Quat& to, double sigma, double t) {
  SEPTET_CHECK(std::abs(sigma) <= 1.0, "sigma {}", sigma);
  // q and −q are one orientation: take the one nearer to `from`.
  const double dot = glm::dot(from, to);
  const Quat target = dot < 0.0 ? -to : to;
  // q₀ is `target` made orthogonal to `from` (one Gram–Schmidt step); its length is sin θ.
  const Quat across = target - from * std::abs(dot);
  const double sin_theta = glm::length(across);
  if (sin_theta < 1e-12) return from;
  const double theta = std::atan2(sin_theta, std::abs(dot));
  const double angle = theta * varied_share(sigma, t);
  return glm::normalize(from * std::cos(angle) + across * (std::sin(angle) / sin_theta));
}

double sigma_from_rates(double rate_start, double rate_end) {
  const double sum = rate_start + rate_end;
  if (std::abs(sum) < 1e-9) return 0.0;
  return std::clamp((rate_end - rate_start) / sum, -1.0, 1.0);
}

}  // namespace septet
