#pragma once
/// Moving and lit parts of a car's inside: needles, digits and lamps of its instruments, the driver's hands on the
/// wheel.
///
/// Pure: a function of the snapshot, for a live screen, a replay and a film.

#include <vector>

#include "engine/instant/frame_input.hpp"
#include "engine/scene/resolved_scene.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::frame {

/// Values shown by a car's instruments.
struct Readings {
  double speed_mps = 0.0;  ///< Along the car, negative backwards.
  double engine_radps = 0.0;
  int gear = 0;           ///< −1 reverse, 0 neutral, 1…
  bool has_gear = false;  ///< Unknown for cars other than the driver's.
  bool stalled = false;
  Lamps lamps;
};

/// True for a stalled engine: an idling one turns at 70 rad/s, one on its starter motor at 20.
bool is_stalled(const DriverCar& car);

Readings readings_of(const Snapshot& shown, const Participant& car);

/// Triangles of needles and lit signs, from the panel's middle along the vehicle's axes
/// (engine/world/instrument_panel.hpp).
std::vector<scene::SurfaceVertex> lit_on_panel(const Readings& readings);

/// Adds the instruments to a frame in which the inside of `car` is drawn. Prototypes that the scene does not have (yet)
/// are left out.
void add_instruments(instant::FrameInput& frame, const Readings& readings, const Participant& car,
                     const scene::ResolvedScene& scene);

/// Adds the instruments of a vehicle without a cockpit of its own to a frame that is seen from its driver's eyes; none for
/// one that has none.
void add_dials(instant::FrameInput& frame, const Readings& readings, const Participant& vehicle,
               const scene::ResolvedScene& scene);

/// Angle of the hands for an angle of the steering wheel. They follow it as far as they reach and, as it goes on,
/// return to their starting place, so that no sleeve covers dials and road. A continuous function of the angle; 0 for
/// NaN.
inline constexpr double hands_reach_rad = 1.0, hands_back_in_rad = 0.45;
double hands_rad(double steering_wheel_rad);
/// Adds the hands, at an angle of hands_rad.
void add_hands(instant::FrameInput& frame, double steering_wheel_rad, const Participant& car,
               const scene::ResolvedScene& scene);

}  // namespace septet::frame
