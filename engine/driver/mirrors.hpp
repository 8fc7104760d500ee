#pragma once
/// Glances at the mirrors with the head, from habit and before a lane change.

#include <cstdint>
#include <optional>

#include "engine/core/random.hpp"
#include "engine/driver/driver_parameters.hpp"

namespace septet::driver {

enum class Mirror : std::uint8_t { left, inside, right };

/// Heading of the head for a mirror of a left-hand-drive car, positive to the left: four fifths of
/// the way to where the mirror is (44° left, 39° and 66° right of the eyes), the eyes do the rest.
double head_heading_rad(Mirror mirror);

struct MirrorState {
  std::optional<Mirror> target;  ///< The glance that is going on.
  double since_s = 0.0;          ///< Its age.
  double hold_s = 0.0;           ///< How long the head stays there.
  double next_habit_s = 2.0;     ///< Time until the next glance from habit.
  double head_rad = 0.0;
  double from_rad = 0.0;  ///< Where the head was when the glance began.
};

/// Begins a glance unless one is going on; returns whether it did.
bool begin_glance(MirrorState& state, Mirror mirror, const MirrorParameters& mirrors, Random& random);

/// Whether the eyes are on the road: before and after glances.
bool sees_road(const MirrorState& state);

/// Moves the head; returns the mirror that was just looked into, at the end of its glance. Glances
/// from habit wait until the driver is at ease with where the car goes.
std::optional<Mirror> advance_mirrors(MirrorState& state, const MirrorParameters& mirrors, bool at_ease, double dt_s,
                                      Random& random);

}  // namespace septet::driver
