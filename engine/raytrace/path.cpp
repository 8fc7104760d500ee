#include "engine/raytrace/path.hpp"

#include <algorithm>
#include <limits>

#include "engine/light/beam.hpp"
#include "engine/raytrace/crossing.hpp"
#include "engine/raytrace/drawn_lights.hpp"
#include "engine/raytrace/photon_map.hpp"

namespace septet::raytrace {
void Path::meet_sky(const glm::vec3& direction) {
  const Sky& sky = world_.sky();
  if (scattered_ && !sky.shines() && !sky.has_sun()) return;
  const glm::vec3 sky_light = sky.radiance(direction), sun_light = sky.sun_radiance(direction);
  if (pdf_ <= 0.0f) {
    // The sun through a clear body onto a rough surface is met so seldom that it would be a spark, not a caustic.
    if (scattered_) {
      light_ += throughput_ * around_ * sky_light;
      return;
    }
    const instant::CloudSeen cloud = world_.cloud(direction);
    light_ +=
        throughput_ * (glm::mix(sky_light, cloud.radiance, cloud.cover) + sun_light * (1.0f - 0.97f * cloud.cover));
    return;
  }
  light_ += throughput_ * around_ * sky_light * mis_weight(pdf_, chance(Kind::sky) * sky.pdf(direction));
  if (sun_light != glm::vec3(0.0f))
    light_ += throughput_ * sun_light * mis_weight(pdf_, chance(Kind::sun) * sky.sun_pdf(direction));
}

void Path::meet_lamp(const Ray& ray, const SurfacePoint& point) {
  if (point.emission == glm::vec3(0.0f)) return;
  if (has_caustics_ && pdf_ <= 0.0f && point.lamp != no_lamp) return;
  float weight = 1.0f;
  if (pdf_ > 0.0f && point.lamp != no_lamp && lamp_weights_.sum() > 0.0f) {
    const Lamp& lamp = world_.lamps()[point.lamp];
    const glm::vec3 way = point.position_m - from_m_;
    const float cosine = std::max(1e-6f, -glm::dot(point.flat_normal, ray.direction));
    const float per_sr = glm::dot(way, way) / (cosine * lamp.area_m2);
    weight = mis_weight(pdf_, chance(Kind::lamp) * lamp_weights_.chance(point.lamp) * per_sr);
  }
  light_ += throughput_ * point.emission * (weight * (scattered_ ? point.lights_up : 1.0f));
}

void Path::add_light(const SurfacePoint& point, const glm::vec3& to_viewer, Kind kind, const LightSample& light,
                     float distance_m) {
  if (!(light.pdf > 0.0f) || light.radiance == glm::vec3(0.0f)) return;
  const glm::vec3 side = side_towards(point, light.direction);
  if (!point.in_smoke && side == glm::vec3(0.0f)) return;
  Scattering scattered = point.in_smoke ? Scattering{point.surface.diffuse * evenly_per_sr, evenly_per_sr}
                                        : scattering(point.surface, to_viewer, light.direction);
  if (kind == Kind::headlight && !point.in_smoke) {
    const float cosine = std::max(glm::dot(light.direction, point.surface.normal), 1e-3f);
    scattered.value *= light::beam_facing(cosine) / cosine;
    // Beads and prisms send light back to the lamp, beside which the eye is; their effect elsewhere does not count.
    if (!scattered_)
      scattered.value += point.retroreflection * light::beam_returned(1.0f - glm::dot(light.direction, to_viewer));
  }
  if (scattered.value == glm::vec3(0.0f)) return;
  if (kind == Kind::sky) scattered.value *= point.from_around;
  const float pdf = light.pdf * chance(kind);
  const bool also_by_chance = kind != Kind::headlight && !looks_alone_;
  const float share = also_by_chance ? pdf / std::max(pdf * pdf + scattered.pdf * scattered.pdf, 1e-37f) : 1.0f / pdf;
  const glm::vec3 estimate = throughput_ * scattered.value * light.radiance * share;
  Ray shadow;
  shadow.origin_m = beside(point.position_m, side);
  shadow.direction = light.direction;
  shadow.time = time_;
  if (distance_m < std::numeric_limits<float>::infinity()) {
    // Ends at the drawn point, from the shifted origin: beside it, a lamp seen at a grazing angle would shade itself.
    const glm::vec3 at = point.position_m + light.direction * distance_m, way = at - shadow.origin_m;
    const float square = glm::dot(way, way), per_m = 1.0f / std::sqrt(std::max(square, 1e-30f));
    shadow.direction = way * per_m;
    shadow.to_m = std::max(0.0f, square * per_m - 3.0f * margin_m(at));
  }
  looks_ = edge_ == 1;
  if (!looks_) return take_light(shadow, estimate, world_.geometry().unshadowed(shadow));
  shadow_ = shadow;
  estimate_ = estimate;
}

void Path::take_light(const Ray& shadow, const glm::vec3& estimate, float let_through) {
  if (let_through <= 0.0f) return;
  const float clear = world_.smoke().empty() ? 1.0f : std::exp(-world_.smoke().optical_depth(shadow));
  light_ += estimate * (let_through * clear);
}

/// Chances: half by the unshadowed light of each kind, half evenly, for something may shade it.
void Path::choose_chances(const SurfacePoint& point) {
  if (world_.lamps_alone_shine()) {
    world_.lamp_row().weigh_for_choice(point.position_m, point.flat_normal, time_, lamp_weights_);
    chances_ = {0.0f, 0.0f, 1.0f, 0.0f};
    return;
  }
  const Sky& sky = world_.sky();
  const instant::SkyLight& light = *world_.instant().light;
  const float seen_sky = std::max(point.share_of_sky, 0.02f);
  world_.lamp_row().weigh(point.position_m, point.flat_normal, time_, lamp_weights_);
  headlight_sum_ = world_.headlights().sum(point.position_m, time_);
  chances_ = {sky.has_sun() ? luminance(light.light_irradiance) * seen_sky *
                                  (point.in_smoke || point.face_in_sheet
                                       ? 1.0f
                                       : std::max(0.0f, glm::dot(point.flat_normal, light.light_direction) + 0.005f))
                            : 0.0f,
              sky.shines() ? std::max(luminance(light.sky_irradiance), 1e-6f) * seen_sky : 0.0f, lamp_weights_.sum(),
              headlight_sum_};
  float sum = 0.0f;
  for (const float weight : chances_) sum += weight;
  if (!(sum > 0.0f)) return;
  int count = 0;
  for (const float weight : chances_) count += weight > 0.01f * sum;
  const float share = 0.5f / sum, evenly = 0.5f / static_cast<float>(count);
  for (float& weight : chances_) weight = share * weight + (weight > 0.01f * sum ? evenly : 0.0f);
}

void Path::look_at_a_light(const SurfacePoint& point, const glm::vec3& to_viewer) {
  std::size_t n = static_cast<std::size_t>(Kind::lamp);
  if (!world_.lamps_alone_shine()) {
    float rest = random_.uniform();
    n = 0;
    while (n < chances_.size() && (rest -= chances_[n]) >= 0.0f) ++n;
  }
  if (n == chances_.size()) return;  // No light shines; or, once in millions, the chances' sum is rounded below 1.
  const auto kind = static_cast<Kind>(n);
  float distance_m = std::numeric_limits<float>::infinity();
  LightSample light;
  switch (kind) {
    case Kind::sun:
      light = world_.sky().sample_sun(random_.pair());
      break;
    case Kind::sky: {
      const float cell = random_.uniform();
      light = world_.sky().sample(random_.pair(), cell);
      break;
    }
    case Kind::lamp:
      light = draw_lamp(world_, lamp_weights_, point.position_m, time_, random_, distance_m);
      break;
    case Kind::headlight:
      light = draw_headlight(world_, headlight_sum_, point.position_m, time_, random_, distance_m);
      // Shortened by the distance to the lamp's glass, which would shade it.
      distance_m = std::max(0.0f, distance_m - 0.3f);
      break;
  }
  add_light(point, to_viewer, kind, light, distance_m);
}

/// Adds the light that photons have brought there. True where that is all: the path ends.
bool Path::take_photons(const SurfacePoint& point, const glm::vec3& to_viewer, float edge_m) {
  const bool is_matt = !point.in_smoke && is_rough(point.surface);
  // Near a corner the photons around lie on two walls, each of which counts its own only: there the path goes on.
  if (gathers_ && is_matt && edge_m > 2.0f * photons_->global.reach_m()) {
    light_ += throughput_ * photons_->global.radiance(point, to_viewer);
    return true;
  }
  gathers_ = is_matt && !photons_->global.empty();
  has_caustics_ = !point.in_smoke && photons_->has_caustics;
  if (has_caustics_) light_ += throughput_ * photons_->caustic.radiance(point, to_viewer);
  return false;
}

/// Adds the light of flames on the edge. True where the path turns before the edge's end: `point` is there then.
bool Path::meet_smoke(const glm::vec3& from_m, const Ray& ray, float edge_m, SurfacePoint& point) {
  Ray edge = ray;
  edge.origin_m = from_m;
  edge.to_m = edge_m;
  const SmokeWalk walk = world_.smoke().walk(edge, -std::log(1.0f - random_.uniform()));
  light_ += throughput_ * walk.emitted;
  if (!walk.scatters) return false;
  point = {};
  point.in_smoke = true;
  point.surface.diffuse = walk.albedo;
  point.position_m = from_m + ray.direction * walk.distance_m;
  return true;
}

void Path::note_first(const Ray& ray, const Hit& hit, const SurfacePoint& point, float edge_m, FirstSeen& first) const {
  first.distance_m = edge_m;
  first.normal = point.surface.normal;
  first.albedo = point.surface.diffuse + point.surface.f0;
  first.object = world_.object(point.place);
  first.participant = world_.participant(point.place);
  if (!first.asks_way) return;
  Ray then = ray;
  SurfacePoint there;
  then.time = 0.0f;
  world_.point(then, hit, there);
  first.from_m = there.position_m;
  then.time = 1.0f;
  world_.point(then, hit, there);
  first.to_m = there.position_m;
}

bool Path::arrive(bool met, Hit& hit, FirstSeen* first) {
  const glm::vec3 edge_from_m = ray_.origin_m;
  for (int passed = 0; met;) {
    world_.point(ray_, hit, point_);
    if (point_.opacity >= 1.0f || random_.uniform() < point_.opacity) break;
    ray_.origin_m = beside(point_.position_m, -point_.flat_normal);
    if (++passed == most_sheets_passed) break;
    met = world_.geometry().intersect(ray_, hit, edge_ == 1 ? From::eye : From::surface);
  }
  float edge_m = met ? glm::length(point_.position_m - edge_from_m) : std::numeric_limits<float>::infinity();
  if (first && met) note_first(ray_, hit, point_, edge_m, *first);
  if (!world_.smoke().empty() && meet_smoke(edge_from_m, ray_, edge_m, point_)) {
    met = true;
    edge_m = glm::length(point_.position_m - edge_from_m);
  }
  if (const float fog = world_.fog_per_m(); fog > 0.0f && met) {
    const float clear = std::exp(-fog * edge_m);
    light_ +=
        throughput_ * (1.0f - clear) * world_.fog_radiance(ray_.direction, from_share_of_sky_, point_.share_of_sky);
    throughput_ *= clear;
  }
  if (!met) {
    meet_sky(ray_.direction);
    return false;
  }
  from_share_of_sky_ = point_.share_of_sky;
  if (point_.dielectric && !point_.from_front) throughput_ *= glm::exp(-point_.absorption_per_m * edge_m);
  meet_lamp(ray_, point_);
  throughput_ *= around_;
  around_ = point_.from_around;
  if (edge_ == settings_.longest) return false;
  is_clear_ = point_.dielectric;
  if (is_clear_) {
    ray_ = enter_or_leave(point_, ray_, random_);
    pdf_ = 0.0f;
    return true;
  }
  if (point_.translucent) take_a_side(point_, ray_.direction, random_);
  const glm::vec3 to_viewer = -ray_.direction;
  if (photons_ && take_photons(point_, to_viewer, edge_m)) return false;
  choose_chances(point_);
  // Skips the last edge, which would only add a second estimate of the same light; late in a path, at a rough surface,
  // it is worth less than it costs.
  looks_alone_ =
      edge_ > 2 && edge_ + 1 == settings_.longest && is_rough(point_.surface) && world_.all_light_can_be_drawn();
  look_at_a_light(point_, to_viewer);
  return true;
}

/// Prepares the next edge. False: the path ends.
bool Path::leave(Ray& next) {
  if (is_clear_) {
    next = ray_;
    return true;
  }
  if (looks_alone_) return false;
  const glm::vec3 to_viewer = -ray_.direction;
  const Scattered scattered =
      point_.in_smoke ? scatter_evenly(point_.surface.diffuse, random_) : scatter(point_.surface, to_viewer, random_);
  throughput_ *= scattered.weight;
  if (throughput_ == glm::vec3(0.0f)) return false;
  const glm::vec3 side = side_towards(point_, scattered.direction);
  if (!point_.in_smoke && side == glm::vec3(0.0f)) return false;
  if (edge_ >= settings_.roulette_from) {
    const float goes_on = std::min(0.95f, std::max({throughput_.x, throughput_.y, throughput_.z}));
    if (random_.uniform() >= goes_on) return false;
    throughput_ /= goes_on;
  }
  pdf_ = scattered.pdf;
  scattered_ = true;
  from_m_ = point_.position_m;
  next = {};
  next.time = time_;
  next.origin_m = beside(point_.position_m, side);
  next.direction = scattered.direction;
  return true;
}

Path::Path(const World& world, const PathSettings& settings, PathStart& start, const PathMiddle& middle,
           const LampWeights& lamp_weights)
    : Path(world, settings, start) {
  edge_ = middle.edge;
  if (edge_ == 1) return;
  light_ = middle.light;
  throughput_ = middle.throughput;
  from_m_ = middle.from_m;
  pdf_ = middle.pdf;
  lamp_weights_ = lamp_weights;
  chances_[static_cast<std::size_t>(Kind::lamp)] = 1.0f;
  scattered_ = true;
}

void Path::finish(bool met, Hit hit, FirstSeen* first) {
  if (!arrive(met, hit, first)) return;
  if (looks_) take_light(world_.geometry().unshadowed(shadow_));
  go_on();
}

void Path::go_on() {
  const Geometry& geometry = world_.geometry();
  Ray next;  // Traced before it is stored: see Geometry::Four.
  while (leave(next)) {
    ++edge_;
    Hit hit;
    const bool met = geometry.intersect(next, hit, From::surface);
    ray_ = next;
    if (!arrive(met, hit, nullptr)) return;
  }
}

}  // namespace septet::raytrace
