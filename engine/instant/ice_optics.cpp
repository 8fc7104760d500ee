#include "engine/instant/ice_optics.hpp"

#include <cmath>

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace septet::ice {

Vec3 blended_normal(const Vec3& front_normal, const Vec3& back_normal, double back_share, BackSign sign) {
  const Vec3 sum = (1.0 - back_share) * front_normal + static_cast<double>(sign) * back_share * back_normal;
  const double length = glm::length(sum);
  return length > 1e-9 ? sum / length : front_normal;
}

std::optional<Vec3> refraction_vector(const Vec3& eye, const Vec3& normal, double eta) {
  const double cosine = glm::dot(normal, eye), square = 1.0 - eta * eta * (1.0 - cosine * cosine);
  if (square < 0.0) return std::nullopt;
  return eta * eye - (eta * cosine + std::sqrt(square)) * normal;
}

Vec3 reflection_vector(const Vec3& eye, const Vec3& normal) { return eye - 2.0 * glm::dot(normal, eye) * normal; }

double fresnel_share(const Vec3& eye, const Vec3& normal) {
  const double grazing = 1.0 - std::abs(glm::dot(eye, normal));
  return grazing * grazing * grazing;
}

double exact_fresnel_share(const Vec3& eye, const Vec3& normal, double eta) {
  const double cosine = std::abs(glm::dot(eye, normal)), square = 1.0 - eta * eta * (1.0 - cosine * cosine);
  if (square < 0.0) return 1.0;
  const double beyond = std::sqrt(square);
  const double across = (eta * cosine - beyond) / (eta * cosine + beyond);
  const double along = (eta * beyond - cosine) / (eta * beyond + cosine);
  return 0.5 * (across * across + along * along);
}

Vec3 transmittance(const Vec3& absorption_per_m, double way_m) { return glm::exp(-absorption_per_m * way_m); }

}  // namespace septet::ice
