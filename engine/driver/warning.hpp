#pragma once
/// Own hazard lights, behind a standing vehicle with hazard lights.
///
/// A driver who stops last in a queue passes the warning on, after a time drawn for each halt from a log-normal
/// distribution. No published time was found: its medians are assumptions.

#include <optional>
#include <span>

#include "engine/core/random.hpp"
#include "engine/driver/driver_parameters.hpp"
#include "engine/driver/driver_view.hpp"

namespace septet::driver {

struct WarningState {
  double stands_s = 0.0;          ///< Behind a vehicle with hazard lights.
  std::optional<double> after_s;  ///< Drawn for this halt.
  bool on = false;
};

/// True while the hazard lights are on, `dt_s` later. They go off when the car drives again.
bool advance_warning(WarningState& state, const SpeedParameters& speed, const OwnPlace& own,
                     std::span<const SeenVehicle> vehicles, double dt_s, Random& random);

}  // namespace septet::driver
