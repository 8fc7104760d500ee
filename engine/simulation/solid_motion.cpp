#include "engine/simulation/solid_motion.hpp"

#include <algorithm>
#include <cmath>

#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/solids.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {
namespace {

bool is_as_led(const SolidMotion& moving, const State& state, const LooseBody& body) {
  LooseBody led = body;
  place_solid(moving, state.time_s(), led);
  return led.body.velocity_mps == body.body.velocity_mps && led.body.yaw_rate_radps == body.body.yaw_rate_radps;
}

void show_free(LooseBody& body) { body.lamps.set(Lamp::brake, std::isfinite(body.body.mass_kg)); }

}  // namespace

void place_solid(const SolidMotion& moving, double simulated_time_s, LooseBody& body) {
  const scene::MovingPose pose = scene::pose_at(moving.motion, simulated_time_s);
  const Quat& turn = pose.world_from_object.orientation;
  const Vec3 arm_m = turn * moving.foot_m;
  body.body.mass_centre_m = Vec2(pose.world_from_object.position_m + arm_m);
  body.body.yaw_rate_radps = pose.turn_radps.z;
  body.body.velocity_mps = Vec2(pose.velocity_mps) + pose.turn_radps.z * left_of(Vec2(arm_m));
  body.body.heading_rad = moving.heading_rad + 2.0 * std::atan2(turn.z, turn.w);
  body.height_m = pose.world_from_object.position_m.z + arm_m.z;
  body.climb_mps = pose.velocity_mps.z;
}

void lead_solids(State& state) {
  std::erase_if(state.solid_motions, [&](const SolidMotion& moving) {
    LooseBody& body = *find_loose(state, moving.participant);
    LooseBody led = body;
    place_solid(moving, state.time_s(), led);
    led.acceleration_mps2 = (led.body.velocity_mps - body.body.velocity_mps) / tick_s;
    const bool goes_on = is_in_range(led);
    if (goes_on) {
      body = led;
    } else {
      body.body.velocity_mps = body.acceleration_mps2 = Vec2(0.0);
      body.body.yaw_rate_radps = body.climb_mps = 0.0;
      show_free(body);
    }
    return !goes_on;
  });
}

void free_pushed_solids(State& state, std::vector<Participant>& participants) {
  std::erase_if(state.solid_motions, [&](const SolidMotion& moving) {
    LooseBody& body = *find_loose(state, moving.participant);
    if (is_as_led(moving, state, body)) return false;
    show_free(body);
    if (Participant* shown = find_participant(participants, body.id)) *shown = participant_of(body);
    return true;
  });
}

bool is_led(const State& state, ParticipantId participant) {
  return std::ranges::find(state.solid_motions, participant, &SolidMotion::participant) != state.solid_motions.end();
}

}  // namespace septet::simulation
