#include "engine/raytrace/photons.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "engine/light/beam.hpp"
#include "engine/raytrace/crossing.hpp"

namespace septet::raytrace {
namespace {

constexpr std::uint32_t longest_caustic = 24;  ///< Edges of a photon's way through clear bodies.
constexpr float sun_starts_m = 2000.0f;        ///< Distance before the body: no higher object shades it.
constexpr float headlight_glass_m = 0.3f;      ///< Distance from a headlight to its lamp's glass, which would shade it.
constexpr std::uint64_t photons_word = 0x70686f746f6e7321u;  ///< Makes random numbers different from those of pixels.

/// Solid angle of a sphere as a share of 2π, seen from outside: 1 − cos θ with half-angle θ; 2, all directions, from
/// within or close to it.
float cone_lack(float square_m2, float radius_m) {
  const float sine2 = radius_m * radius_m / std::max(square_m2, 1e-20f);
  return sine2 < 0.98f ? sine2 / (1.0f + std::sqrt(1.0f - sine2)) : 2.0f;
}

/// Uniform direction in a cone about an axis.
glm::vec3 in_cone(const glm::vec3& axis, float lack, const glm::vec2& random) {
  const float below_one = random.x * lack, sine = std::sqrt(std::max(0.0f, below_one * (2.0f - below_one)));
  return Frame(axis).to_world(glm::vec3(sine * on_circle(random.y), 1.0f - below_one));
}

}  // namespace

std::vector<PhotonBucket> photon_buckets(std::uint32_t caustic, std::uint32_t global, std::uint32_t of_each) {
  std::vector<PhotonBucket> buckets;
  const auto add = [&](PhotonKind kind, std::uint32_t count) {
    for (std::uint32_t first = 0; first < count;) {
      const std::uint32_t end = first + std::min(of_each, count - first);
      buckets.push_back({kind, first, end});
      first = end;
    }
  };
  add(PhotonKind::caustic, caustic);
  add(PhotonKind::global, global);
  return buckets;
}

PhotonLights::PhotonLights(const World& world, const PhotonSettings& settings, std::uint64_t seed,
                           std::uint32_t longest, bool moves)
    : world_(world), settings_(settings), seed_(seed ^ photons_word), longest_(longest), moves_(moves) {
  if (settings.caustic > 0) bodies_ = world.clear_body_spheres();
  for (std::size_t n = 0; n < bodies_.size(); ++n) {
    const World::ClearBodySphere& body = bodies_[n];
    const float disc_m2 = pi * body.radius_m * body.radius_m;
    if (world.sky().has_sun()) add(Light::sun, 0, n, disc_m2 * luminance(world.instant().light->light_irradiance));
    for (std::uint32_t lamp = 0; lamp < world.lamps().size(); ++lamp) {
      const glm::vec3 way = world.lamps()[lamp].middle_m - body.middle_m;
      add(Light::lamp, lamp, n,
          world.lamps()[lamp].power * std::min(pi, disc_m2 / std::max(glm::dot(way, way), 1e-6f)));
    }
    for (std::uint32_t light = 0; light < world.instant().headlights.size(); ++light) {
      const instant::Headlight& headlight = world.instant().headlights[light];
      const glm::vec3 way = body.middle_m - world.headlights().position_m(light, 0.0f);
      const float square = std::max(glm::dot(way, way), 1e-6f);
      // Lower bound above 0: the beam's edge may reach the body.
      const float share =
          std::max(0.01f, light::beam_share(headlight.direction, way / std::sqrt(square), headlight.main_beam, 1.0f));
      add(Light::headlight, light, n, headlight.intensity * share * std::min(4.0f * pi, disc_m2 / square));
    }
  }
  if (settings.global > 0 && world.lamps_alone_shine() && world.all_light_can_be_drawn())
    for (const Lamp& lamp : world.lamps()) lamps_.push_back((lamps_.empty() ? 0.0f : lamps_.back()) + lamp.power);
}

void PhotonLights::add(Light light, std::uint32_t number, std::size_t body, float weight) {
  const float before = pairs_.empty() ? 0.0f : pairs_.back().cumulative;
  if (weight > 0.0f && std::isfinite(before + weight)) pairs_.push_back({light, number, body, before + weight});
}

std::uint32_t PhotonLights::count(PhotonKind kind) const {
  return kind == PhotonKind::caustic ? (pairs_.empty() ? 0 : settings_.caustic)
                                     : (lamps_.empty() ? 0 : settings_.global);
}

glm::vec3 PhotonLights::place_on_lamp(std::size_t number, float time, PathRandom& random, glm::vec3& normal,
                                      glm::vec3& radiance) const {
  const Lamp& lamp = world_.lamps()[number];
  const std::size_t which = lamp.drawn_triangle(random.uniform());
  const LampTriangle& triangle = lamp.triangles[which];
  const glm::vec2 at = random.pair();
  const float root = std::sqrt(at.x), u = root * (1.0f - at.y), v = root * at.y;
  const glm::vec3 place = triangle.corner_m + u * triangle.second + v * triangle.third + lamp.way_m * time;
  normal = triangle.normal;
  radiance = lamp.emission;
  if (lamp.textured) {
    Ray ray;
    ray.origin_m = place + normal;
    ray.direction = -normal;
    ray.time = time;
    SurfacePoint there;
    world_.point(ray, {1.0f, lamp.place, lamp.first_triangle + static_cast<std::uint32_t>(which), u, v}, there);
    radiance = there.emission * there.lights_up;
  }
  return place;
}

PhotonLights::Flight PhotonLights::towards_body(PathRandom& random, float time) const {
  const float at = random.uniform() * pairs_.back().cumulative;
  const auto found = std::min(std::ranges::upper_bound(pairs_, at, {}, &Pair::cumulative), std::prev(pairs_.end()));
  const float before = found == pairs_.begin() ? 0.0f : std::prev(found)->cumulative;
  // Power relative to one photon of all that are sent at this pair.
  const float share = pairs_.back().cumulative / ((found->cumulative - before) * static_cast<float>(settings_.caustic));
  const World::ClearBodySphere& body = bodies_[found->body];
  Flight flight;
  flight.place = body.place;
  flight.ray.time = time;
  if (found->light == Light::sun) {
    const LightSample sun = world_.sky().sample_sun(random.pair());
    const glm::vec2 u = random.pair();
    const float radius_m = body.radius_m * std::sqrt(u.x);
    flight.ray.direction = -sun.direction;
    flight.ray.origin_m = body.middle_m + sun_starts_m * sun.direction +
                          Frame(sun.direction).to_world(glm::vec3(radius_m * on_circle(u.y), 0.0f));
    flight.power = sun.radiance * (share / sun.pdf * pi * body.radius_m * body.radius_m);
    return flight;
  }
  const auto aim = [&](const glm::vec3& from_m) {
    const glm::vec3 way = body.middle_m - from_m;
    const float square = glm::dot(way, way), lack = cone_lack(square, body.radius_m);
    flight.ray.origin_m = from_m;
    flight.ray.direction = in_cone(way / std::sqrt(std::max(square, 1e-20f)), lack, random.pair());
    return 2.0f * pi * lack;
  };
  if (found->light == Light::headlight) {
    const instant::Headlight& light = world_.instant().headlights[found->number];
    const float solid_angle_sr = aim(world_.headlights().position_m(found->number, time));
    flight.power = light::headlight_color *
                   (light.intensity * light::beam_share(light.direction, flight.ray.direction, light.main_beam, 1.0f) *
                    solid_angle_sr * share);
    flight.ray.origin_m += headlight_glass_m * flight.ray.direction;
    return flight;
  }
  glm::vec3 normal, radiance;
  const glm::vec3 place = place_on_lamp(found->number, time, random, normal, radiance);
  const float solid_angle_sr = aim(beside(place, normal));
  const float cosine = glm::dot(normal, flight.ray.direction);
  const Lamp& lamp = world_.lamps()[found->number];
  if (cosine > 0.0f) flight.power = radiance * (lamp.area_m2 * lamp.share_at(cosine) * cosine * solid_angle_sr * share);
  return flight;
}

PhotonLights::Flight PhotonLights::from_lamp(PathRandom& random, float time) const {
  const float at = random.uniform() * lamps_.back();
  const auto found = std::min(std::ranges::upper_bound(lamps_, at), std::prev(lamps_.end()));
  const auto number = static_cast<std::size_t>(found - lamps_.begin());
  const float of_all = (*found - (number == 0 ? 0.0f : lamps_[number - 1])) / lamps_.back();
  Flight flight;
  glm::vec3 normal, radiance;
  const glm::vec3 place = place_on_lamp(number, time, random, normal, radiance);
  flight.ray.time = time;
  flight.ray.origin_m = beside(place, normal);
  flight.ray.direction = Frame(normal).to_world(cosine_direction(random.pair()));
  const Lamp& lamp = world_.lamps()[number];
  const float cosine = std::max(1e-6f, glm::dot(normal, flight.ray.direction));
  flight.power =
      radiance * (pi * lamp.area_m2 * lamp.share_at(cosine) / (of_all * static_cast<float>(settings_.global)));
  return flight;
}

void PhotonLights::follow(Flight flight, PhotonKind kind, PathRandom& random, std::vector<Photon>& photons) const {
  const bool of_caustic = kind == PhotonKind::caustic;
  // Photons follow at most the edges that a path from the eye has left after the two before it takes them.
  const std::uint32_t longest = of_caustic ? longest_caustic : std::max(1u, longest_ - std::min(longest_, 2u));
  Ray& ray = flight.ray;
  const float begun_with = std::max({flight.power.x, flight.power.y, flight.power.z});
  SurfacePoint point;
  for (std::uint32_t edge = 1; edge <= longest; ++edge) {
    Hit hit;
    bool met = false;
    const glm::vec3 from_m = ray.origin_m;
    for (int passed = 0; passed < most_sheets_passed; ++passed) {
      met = world_.geometry().intersect(ray, hit, From::surface);
      if (!met) return;
      world_.point(ray, hit, point);
      if (point.opacity >= 1.0f || random.uniform() < point.opacity) break;
      ray.origin_m = beside(point.position_m, -point.flat_normal);
    }
    const float edge_m = glm::length(point.position_m - from_m);
    if (of_caustic && edge == 1 && (hit.place != flight.place || !point.dielectric)) return;
    if (!world_.smoke().empty()) {
      Ray through = ray;
      through.origin_m = from_m;
      through.to_m = edge_m;
      flight.power *= std::exp(-world_.smoke().optical_depth(through));
    }
    if (point.dielectric) {
      if (!point.from_front) flight.power *= glm::exp(-point.absorption_per_m * edge_m);
      ray = enter_or_leave(point, ray, random);
    } else {
      if (point.translucent) take_a_side(point, ray.direction, random);
      photons.push_back({point.position_m, flight.power, point.flat_normal, -ray.direction});
      if (of_caustic) return;
      const Scattered scattered = scatter(point.surface, -ray.direction, random);
      flight.power *= scattered.weight;
      const glm::vec3 side = side_towards(point, scattered.direction);
      if (side == glm::vec3(0.0f)) return;
      const float time = ray.time;
      ray = Ray{};
      ray.time = time;
      ray.origin_m = beside(point.position_m, side);
      ray.direction = scattered.direction;
    }
    const float goes_on = std::max({flight.power.x, flight.power.y, flight.power.z}) / begun_with;
    if (!(goes_on > 0.0f)) return;
    if (goes_on < 1.0f) {
      if (random.uniform() >= goes_on) return;
      flight.power /= goes_on;
    }
  }
}

std::vector<Photon> PhotonLights::trace(const PhotonBucket& bucket) const {
  std::vector<Photon> photons;
  const bool of_caustic = bucket.kind == PhotonKind::caustic;
  const std::uint64_t of_kind = PathRandom::of_pixel(seed_, of_caustic ? 0 : 1, 0);
  for (std::uint32_t n = bucket.first; n < std::min(bucket.end, count(bucket.kind)); ++n) {
    PathRandom random(of_kind, n);
    const float time = moves_ ? random.uniform() : 0.0f;
    const Flight flight = of_caustic ? towards_body(random, time) : from_lamp(random, time);
    if (flight.power == glm::vec3(0.0f)) continue;
    const std::size_t before = photons.size();
    follow(flight, bucket.kind, random, photons);
    for (std::size_t k = before; k < photons.size(); ++k) {
      const glm::vec3 all = photons[k].position_m + photons[k].power + photons[k].normal + photons[k].to_light;
      if (std::isfinite(all.x + all.y + all.z)) continue;
      photons.resize(before);
      break;
    }
  }
  return photons;
}

}  // namespace septet::raytrace
