#include "engine/driver/known_world.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/world/seen_participants.hpp"

namespace septet::driver {
namespace {

bool is_heard(const Participant& other, const Vec3& at_m) {
  return other.lamps.has(Lamp::siren) && glm::distance(other.world_from_vehicle.position_m, at_m) <= siren_heard_m;
}

/// Where somebody is taken to be a little later.
Participant gone_on(Participant body, double dt_s) {
  const Quat turn = glm::angleAxis(body.angular_velocity_radps.z * dt_s, Vec3(0.0, 0.0, 1.0));
  body.world_from_vehicle.position_m += dt_s * body.velocity_mps;
  body.world_from_vehicle.orientation = turn * body.world_from_vehicle.orientation;
  body.velocity_mps = turn * body.velocity_mps;
  return body;
}

}  // namespace

void look_around(KnownWorld& known, const Snapshot& snapshot, double dt_s) {
  const auto seen = seen_by_driver(snapshot);
  const ParticipantId self = snapshot.driver_car.participant;
  const Participant* own = find_participant(snapshot, self);
  KnownWorld now;
  now.bodies.reserve(snapshot.participants.size());
  now.unseen_s.reserve(snapshot.participants.size());
  for (const Participant& other : snapshot.participants) {
    if (!seen || other.id == self || std::ranges::binary_search(*seen, other.id) ||
        (own && is_heard(other, own->world_from_vehicle.position_m))) {
      now.bodies.push_back(other);
      now.unseen_s.push_back(0.0);
      continue;
    }
    const auto before = std::ranges::lower_bound(known.bodies, other.id, {}, &Participant::id);
    if (before == known.bodies.end() || before->id != other.id) continue;
    const double unseen_s = known.unseen_s[static_cast<std::size_t>(before - known.bodies.begin())] + dt_s;
    if (unseen_s > remembered_s) continue;
    now.bodies.push_back(gone_on(*before, dt_s));
    now.unseen_s.push_back(unseen_s);
  }
  known = std::move(now);
}

}  // namespace septet::driver
