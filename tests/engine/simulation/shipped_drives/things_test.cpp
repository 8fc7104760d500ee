// Things that stand in the lane: what a drive into them gives, saved in the middle, and seen by who comes late.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/simulation/bodies/bodies.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/wire_snapshot.hpp"
#include "tests/engine/simulation/shipped_drives/staged_crash.hpp"

namespace septet::simulation {
namespace {

/// Straight on, whatever stands there.
DriverInput blind() {
  DriverInput input;
  input.accelerator = 0.5;
  input.selector = GearSelector::drive;
  return input;
}

const Participant& shown(const Snapshot& now, ParticipantId id) {
  const Participant* found = find_participant(now, id);
  REQUIRE(found != nullptr);
  return *found;
}

std::ptrdiff_t hits(const std::vector<Event>& events, ParticipantId id) {
  return std::ranges::count_if(
      events, [&](const Event& event) { return event.kind == "collision" && event.participant == id; });
}

}  // namespace

TEST_CASE(
    "a car goes through a bin, a standing car and on to a container: each is moved as it may be, hashes agree from "
    "each state that was saved in the middle, and who comes late sees all as they lie") {
  StagedCrash drive("things");
  const Model& model = *drive.loaded.model;
  const ParticipantId bin = drive.named("bin"), standing = drive.named("crosser"), container = drive.named("container");
  const Snapshot before = drive.now;
  CHECK(box_size_m(shown(before, bin)).z > 1.09);
  CHECK(box_size_m(shown(before, container)).y > 5.9);
  std::vector<State> saved;
  std::vector<std::size_t> saved_at;
  std::vector<std::uint64_t> hashes;
  std::size_t told = 0;
  while (drive.state.tick < 1200) {
    drive.now = server_step(model, blind(), drive.state, drive.events);
    hashes.push_back(drive.now.state_hash);
    if (saved.size() < 3 && drive.pressed() && drive.events.size() > told) {
      saved.push_back(drive.restored());
      saved_at.push_back(hashes.size());
      told = drive.events.size();
      CHECK(hash_state(saved.back()) == hashes.back());
    }
  }
  REQUIRE(saved.size() >= 2);
  for (std::size_t n = 0; n < saved.size(); ++n) {
    std::vector<Event> others;
    for (std::size_t i = saved_at[n]; i < hashes.size(); ++i)
      REQUIRE(server_step(model, blind(), saved[n], others).state_hash == hashes[i]);
  }
  CHECK(hits(drive.events, bin) >= 1);
  CHECK(find_loose(drive.state, standing) != nullptr);
  // Whoever came first to the container: it stands as it stood.
  const auto moved_m = [&](const Snapshot& now, ParticipantId id) {
    return glm::distance(shown(now, id).world_from_vehicle.position_m, shown(before, id).world_from_vehicle.position_m);
  };
  CHECK(moved_m(drive.now, bin) > 5.0);
  CHECK(moved_m(drive.now, standing) > 1.0);
  CHECK(moved_m(drive.now, container) < 1e-9);
  // A screen that begins now has this snapshot alone.
  const Snapshot late = from_wire(to_wire(drive.now));
  for (const ParticipantId id : {bin, standing, container}) {
    CHECK(glm::distance(shown(late, id).world_from_vehicle.position_m,
                        shown(drive.now, id).world_from_vehicle.position_m) < 1e-3);
    CHECK(std::abs(shape_of(shown(late, id)).length_m - shape_of(shown(drive.now, id)).length_m) < 1e-3);
  }
  CHECK(shown(late, bin).model == box_model());
}

}  // namespace septet::simulation
