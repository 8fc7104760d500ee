#pragma once
/// Glances at the mirrors with the head, habitual and before a lane change.

#include <cstdint>
#include <optional>

#include "engine/core/random.hpp"
#include "engine/driver/driver_parameters.hpp"

namespace septet::driver {

enum class Mirror : std::uint8_t { left, inside, right };

/// Heading of the head for a mirror of a left-hand-drive car, positive to the left: four fifths of the mirror's
/// direction (44° left, 39° and 66° right of the eyes); the eyes turn the rest.
double head_heading_rad(Mirror mirror);

struct MirrorState {
  std::optional<Mirror> target;  ///< Present glance.
  double since_s = 0.0;          ///< Its age.
  double hold_s = 0.0;           ///< Time that the head stays there.
  double next_habit_s = 2.0;     ///< Time until the next habitual glance.
  double head_rad = 0.0;
  double from_rad = 0.0;  ///< Heading of the head when the glance began.
};

/// Begins a glance unless one is in progress; returns true if it did.
bool begin_glance(MirrorState& state, Mirror mirror, const MirrorParameters& mirrors, Random& random);

/// True while the eyes are on the road: before and after glances.
bool sees_road(const MirrorState& state);

/// Moves the head; returns the mirror that was just looked into, at the end of its glance. Habitual glances wait until
/// the driver is at ease with the car's path.
std::optional<Mirror> advance_mirrors(MirrorState& state, const MirrorParameters& mirrors, bool at_ease, double dt_s,
                                      Random& random);

}  // namespace septet::driver
