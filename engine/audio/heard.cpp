#include "engine/audio/heard.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "engine/audio/levels.hpp"

namespace septet::audio {
namespace {

constexpr double turn_rad = 2.0 * std::numbers::pi;
constexpr double snow_below_k = 274.65;         // As in snapshot.hpp.
constexpr double tyres_do_at_most_mps2 = 15.0;  // A greater acceleration is an impact.
constexpr double least_blow_mps = 0.25;
constexpr double furthest_m = 1000.0;  // Range of hearing.
constexpr double quietest_db = 30.0;
constexpr double portal_m = 20.0;
constexpr std::uint16_t debris_kind = 2;  // engine/effects/debris/debris_keyframe.hpp
constexpr double fastest_mps = 150.0, fastest_engine_hz = 300.0;

/// Reads numbers within bounds; NaN and infinities are counted.
class Reader {
 public:
  double number(double value, double least, double most) {
    if (!std::isfinite(value)) {
      ++bad_;
      return std::clamp(0.0, least, most);
    }
    return std::clamp(value, least, most);
  }
  Vec3 vector(const Vec3& value, double most) {
    return {number(value.x, -most, most), number(value.y, -most, most), number(value.z, -most, most)};
  }
  /// False for a non-finite place: it has no sound.
  bool is_somewhere(const Participant& participant) {
    const Vec3& p = participant.world_from_vehicle.position_m;
    const Quat& q = participant.world_from_vehicle.orientation;
    const bool somewhere = std::isfinite(p.x + p.y + p.z) && std::isfinite(q.w + q.x + q.y + q.z);
    if (!somewhere) ++bad_;
    return somewhere;
  }
  std::uint32_t bad() const { return bad_; }

 private:
  std::uint32_t bad_ = 0;
};

double blow_mps(const Participant& now, const Participant& before, double seconds) {
  const double jump_mps = glm::length(now.velocity_mps - before.velocity_mps);
  if (!std::isfinite(jump_mps) || jump_mps > 100.0) return 0.0;  // Moved by hand.
  return jump_mps > std::max(least_blow_mps, tyres_do_at_most_mps2 * seconds) ? jump_mps : 0.0;
}

/// 0 outside to 1 where the nearest end of the box is 20 m away or more.
double depth_in(const EchoBox& box, const Vec3& position_m) {
  const Vec3 p = box.box_from_world * position_m;
  if (glm::any(glm::lessThan(p, box.min_m)) || glm::any(glm::greaterThan(p, box.max_m))) return 0.0;
  return 1.0;
}

/// The share of places from here to 10 m ahead and behind that lie in a box: boxes of one tunnel meet, so only its
/// mouths count.
double tunnel_around(const std::vector<EchoBox>& boxes, const Vec3& position_m, const Vec3& forward) {
  if (boxes.empty()) return 0.0;
  constexpr int places = 8;
  double share = 0.0;
  for (int i = 0; i <= places; ++i) {
    const Vec3 place = position_m + forward * (portal_m * (double(i) / places - 0.5));
    double inside = 0.0;
    for (const EchoBox& box : boxes) inside = std::max(inside, depth_in(box, place));
    share += inside / (places + 1);
  }
  return share;
}

OwnCar hear_own(const Snapshot& now, const Snapshot* before, const Participant& body, const CarSound& car,
                const std::vector<EchoBox>& boxes, Reader& reader) {
  OwnCar own;
  const DriverCar& driver = now.driver_car;
  const Environment& air = now.environment;
  own.engine_hz = reader.number(driver.engine_radps, 0.0, turn_rad * fastest_engine_hz) / turn_rad;
  own.running = own.engine_hz > 3.0;
  const double accelerator = reader.number(driver.accelerator, 0.0, 1.0);
  own.fuel_cut = accelerator < 0.02 && own.engine_hz * turn_rad > 1.6 * car.idle_radps;
  own.load = own.fuel_cut ? 0.0 : accelerator;
  own.speed_mps = reader.number(driver.speed_mps, -fastest_mps, fastest_mps);
  own.reversing = driver.gear < 0;

  const Vec3 velocity_mps = reader.vector(body.velocity_mps, fastest_mps);
  const Quat vehicle_from_world = glm::conjugate(body.world_from_vehicle.orientation);
  const double wind_mps = reader.number(air.wind_speed_mps, 0.0, 60.0);
  const double direction = reader.number(air.wind_direction_rad, -100.0, 100.0);
  own.air_mps = glm::length(velocity_mps - wind_mps * Vec3(std::cos(direction), std::sin(direction), 0.0));

  const double wheel_radps = reader.number(body.wheel_spin_radps, -600.0, 600.0);
  own.wheel_hz = std::abs(wheel_radps) / turn_rad;
  const Vec3 over_ground = vehicle_from_world * velocity_mps;
  const double yaw_radps = reader.number(body.angular_velocity_radps.z, -50.0, 50.0);
  const double steer = reader.number(body.front_steer_rad, -1.5, 1.5);
  const double rolling_mps = std::max(std::abs(over_ground.x), std::abs(wheel_radps) * car.wheel_radius_m);
  if (rolling_mps > 1.0) {
    const double along = (wheel_radps * car.wheel_radius_m - over_ground.x) / rolling_mps;
    const double rear_across = over_ground.y / rolling_mps;
    const double front_y = over_ground.y + yaw_radps * car.wheelbase_m;
    const double front_across = (front_y * std::cos(steer) - over_ground.x * std::sin(steer)) / rolling_mps;
    own.rear_slip = std::min(std::hypot(along, rear_across), 1.0);
    own.front_slip = std::min(std::hypot(along, front_across), 1.0);
  }

  const Vec3 forward = body.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
  own.tunnel = tunnel_around(boxes, body.world_from_vehicle * car.ear_m, forward);
  own.looseness = driver.lane == 0 ? 1.0 : 0.0;
  const double open = 1.0 - own.tunnel;
  own.wetness = reader.number(air.road_wetness, 0.0, 1.0) * open;
  own.snow = reader.number(air.snow_cover, 0.0, 1.0) * open;
  if (reader.number(air.temperature_k, 0.0, 400.0) >= snow_below_k)
    own.rain_mm_per_h = reader.number(air.rain_mm_per_h, 0.0, 200.0) * open;
  own.indicator_lit = body.lamps.has(Lamp::indicator_left) || body.lamps.has(Lamp::indicator_right);
  own.horn = body.lamps.has(Lamp::horn);
  if (!before) return own;
  if (const Participant* earlier = find_participant(*before, body.id)) {
    const double seconds = now.simulated_time_s - before->simulated_time_s;
    own.blow_mps = blow_mps(body, *earlier, seconds);
    own.bump_mps = bump_mps(body, *earlier, seconds);
  }
  for (const EffectKeyframe& effect : now.effects) {
    if (effect.kind != debris_kind) continue;
    const auto same = std::ranges::lower_bound(before->effects, effect.id, {}, &EffectKeyframe::id);
    if (same == before->effects.end() || same->id != effect.id) ++own.pieces;
  }
  return own;
}

OtherSound hear_other(const Snapshot& now, const Snapshot* before, const Participant& other,
                      const RigidTransform& ear_from_world, const Vec3& listener_mps, Reader& reader) {
  OtherSound sound;
  sound.id = other.id;
  const auto models = vehicle_models();
  const VehicleModel& model = models[std::min<std::size_t>(other.model, models.size() - 1)];
  sound.kind = model.kind;
  const Vec3 centre_m{model.centre_x_m(), 0.0, 0.5};
  sound.position_m = ear_from_world * (other.world_from_vehicle * centre_m);
  const Vec3 velocity_mps = reader.vector(other.velocity_mps, fastest_mps);
  const Vec3 to_listener = ear_from_world.orientation * velocity_mps;
  sound.doppler = doppler_factor(-sound.position_m, to_listener, ear_from_world.orientation * listener_mps);
  sound.speed_mps = glm::length(velocity_mps);
  const Vec3 forward = other.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
  const double along_mps2 = glm::dot(reader.vector(other.acceleration_mps2, 100.0), forward);
  sound.engine_hz = supposed_engine_hz(sound.kind, sound.speed_mps);
  sound.load = std::clamp(0.15 + 0.3 * along_mps2, 0.0, 1.0);
  sound.siren = other.lamps.has(Lamp::siren);
  sound.horn = other.lamps.has(Lamp::horn);
  // By simulated time alone, so that a film's cut continues at the same place; two of them are out of step.
  constexpr double apart_s = 0.37;
  sound.siren_s = reader.number(now.simulated_time_s, 0.0, 1e9) + apart_s * static_cast<double>(other.id % 64);
  if (before)
    if (const Participant* earlier = find_participant(*before, other.id))
      sound.blow_mps = blow_mps(other, *earlier, now.simulated_time_s - before->simulated_time_s);
  const double distance_m = std::max(glm::length(sound.position_m), 1.0);
  sound.level_db = level_at_1_m_db(sound) - 20.0 * std::log10(distance_m);
  return sound;
}

}  // namespace

double bump_mps(const Participant& now, const Participant& before, double seconds) {
  constexpr double roads_do_at_most_mps2 = 6.0, least_mps = 0.05;
  const double jump_mps = std::abs(now.velocity_mps.z - before.velocity_mps.z);
  if (!std::isfinite(jump_mps) || jump_mps > 100.0) return 0.0;
  return jump_mps > std::max(least_mps, roads_do_at_most_mps2 * seconds) ? jump_mps : 0.0;
}

double doppler_factor(const Vec3& to_listener, const Vec3& source_mps, const Vec3& listener_mps) {
  const double distance = glm::length(to_listener);
  if (!(distance > 1e-3)) return 1.0;
  const Vec3 d = to_listener / distance;
  constexpr double most = 0.8 * speed_of_sound_mps;
  const double away = std::clamp(glm::dot(listener_mps, d), -most, most);
  const double towards = std::clamp(glm::dot(source_mps, d), -most, most);
  return (speed_of_sound_mps - away) / (speed_of_sound_mps - towards);
}

Felt felt(const Snapshot& now, const Snapshot& before) {
  const Participant* body = find_participant(now, now.driver_car.participant);
  const Participant* earlier = body ? find_participant(before, body->id) : nullptr;
  if (!earlier) return {};
  const double seconds = now.simulated_time_s - before.simulated_time_s;
  return {blow_mps(*body, *earlier, seconds), bump_mps(*body, *earlier, seconds)};
}

Heard hear(const Snapshot& now, const Snapshot* before, const CarSound& car, const std::vector<EchoBox>& boxes,
           const GroundFeel& ground) {
  Heard heard;
  Reader reader;
  const Participant* body = find_participant(now, now.driver_car.participant);
  if (body && !reader.is_somewhere(*body)) body = nullptr;
  if (!body) {
    heard.bad_numbers = reader.bad();
    return heard;  // Without a driver's car there is no ear.
  }
  heard.car = hear_own(now, before, *body, car, boxes, reader);
  heard.car.ground = ground;
  if (!std::isfinite(ground.unevenness_m3)) heard.car.ground = {};
  const RigidTransform ear_from_world =
      inverse(body->world_from_vehicle * RigidTransform{car.ear_m, Quat(1.0, 0.0, 0.0, 0.0)});
  const Vec3 listener_mps = Reader().vector(body->velocity_mps, fastest_mps);  // Counted once, above.
  for (const Participant& other : now.participants) {
    if (other.id == body->id || !reader.is_somewhere(other)) continue;
    if (glm::distance(other.world_from_vehicle.position_m, body->world_from_vehicle.position_m) > furthest_m) continue;
    const OtherSound sound = hear_other(now, before, other, ear_from_world, listener_mps, reader);
    if (sound.level_db > quietest_db) heard.others.push_back(sound);
  }
  if (heard.others.size() > most_others) {
    const auto last = heard.others.begin() + most_others;
    std::ranges::nth_element(heard.others, last, std::ranges::greater(), &OtherSound::level_db);
    heard.others.erase(last, heard.others.end());
  }
  std::ranges::sort(heard.others, {}, &OtherSound::id);
  heard.bad_numbers = reader.bad();
  return heard;
}

}  // namespace septet::audio
