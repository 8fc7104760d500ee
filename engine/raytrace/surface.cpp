#include "engine/raytrace/surface.hpp"

#include <algorithm>

#include "engine/light/fresnel.hpp"
#include "engine/light/microfacets.hpp"

namespace septet::raytrace {
namespace {

/// Chances with which a direction is drawn for each layer.
struct Shares {
  float coat = 0.0f, layer = 0.0f, base = 1.0f;
};

bool has_layer(const Surface& surface) { return surface.f0.x + surface.f0.y + surface.f0.z > 0.0f; }

Shares shares_of(const Surface& surface, float viewer_z) {
  const float coat = surface.coat * light::schlick(glm::vec3(surface.coat_f0), viewer_z).x;
  const float layer = (1.0f - coat) * (has_layer(surface) ? luminance(light::schlick(surface.f0, viewer_z)) : 0.0f);
  const float base = std::max(0.0f, 1.0f - coat - layer) * luminance(surface.diffuse);
  const float sum = std::max(coat + layer + base, 1e-6f);
  // Minimum chance of an unlikely layer: its highlight may be bright.
  Shares shares{coat / sum, layer / sum, base / sum};
  if (surface.coat > 0.0f) shares.coat = std::max(shares.coat, 0.1f);
  if (has_layer(surface)) shares.layer = std::max(shares.layer, 0.1f);
  if (base > 0.0f) shares.base = std::max(shares.base, 0.1f);
  const float total = shares.coat + shares.layer + shares.base;
  return {shares.coat / total, shares.layer / total, shares.base / total};
}

struct Facets {
  float value = 0.0f;  ///< D · G / (4 v.z): reflectance times cosine, without Fresnel.
  float pdf = 0.0f;
};

Facets facets(const glm::vec3& v, const glm::vec3& l, const glm::vec3& h, float alpha) {
  const float d = light::ggx_density(h.z, alpha), lambda = smith_lambda(v, alpha);
  return {d / (4.0f * v.z * (1.0f + lambda + smith_lambda(l, alpha))), d / (4.0f * v.z * (1.0f + lambda))};
}

Scattering in_frame(const Surface& surface, const Shares& shares, const glm::vec3& v, const glm::vec3& l) {
  Scattering result;
  if (v.z <= 0.0f || l.z <= 0.0f) return result;
  result.value = surface.diffuse * (l.z / pi);
  result.pdf = shares.base * l.z / pi;
  if (shares.base == 1.0f) return result;
  const glm::vec3 h = glm::normalize(v + l);
  const float vh = glm::dot(v, h);
  if (has_layer(surface)) {
    const Facets layer = facets(v, l, h, surface.alpha);
    result.value *= (1.0f - light::schlick(surface.f0, v.z)) * (1.0f - light::schlick(surface.f0, l.z));
    result.value += light::schlick(surface.f0, vh) * (layer.value * surface.mirrors);
    result.pdf += shares.layer * layer.pdf;
  }
  if (surface.coat > 0.0f) {
    const Facets coat = facets(v, l, h, surface.coat_alpha);
    const auto passes = [&](float z) { return 1.0f - surface.coat * light::schlick(glm::vec3(surface.coat_f0), z).x; };
    result.value = result.value * (passes(v.z) * passes(l.z)) +
                   surface.coat * light::schlick(glm::vec3(surface.coat_f0), vh).x * (coat.value * surface.mirrors);
    result.pdf += shares.coat * coat.pdf;
  }
  return result;
}

}  // namespace

Scattering layered_scattering(const Surface& surface, const glm::vec3& to_viewer, const glm::vec3& to_light) {
  const Frame frame(surface.normal);
  const glm::vec3 v = frame.to_local(to_viewer);
  return in_frame(surface, shares_of(surface, std::clamp(v.z, 0.0f, 1.0f)), v, frame.to_local(to_light));
}

Scattered layered_scatter(const Surface& surface, const glm::vec3& to_viewer, PathRandom& random) {
  const Frame frame(surface.normal);
  const float facing = glm::dot(surface.normal, to_viewer);
  if (facing <= 0.0f) return {};
  const Shares shares = shares_of(surface, std::min(facing, 1.0f));
  if (shares.base == 1.0f) {
    const glm::vec3 l = cosine_direction(random.pair());
    return {frame.to_world(l), surface.diffuse, l.z / pi};
  }
  const glm::vec3 v = frame.to_local(to_viewer);
  const float choice = random.uniform();
  glm::vec3 l;
  if (choice < shares.base) {
    l = cosine_direction(random.pair());
  } else {
    const float alpha = choice < shares.base + shares.layer ? surface.alpha : surface.coat_alpha;
    const glm::vec3 h = visible_normal(v, alpha, random.pair());
    l = 2.0f * glm::dot(v, h) * h - v;
  }
  const Scattering drawn = in_frame(surface, shares, v, l);
  if (drawn.pdf <= 0.0f) return {};
  return {frame.to_world(l), drawn.value / drawn.pdf, drawn.pdf};
}

}  // namespace septet::raytrace
