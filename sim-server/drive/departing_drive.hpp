#pragma once
/// A drive by a table within the table's ±: one of the runs of `septet what-if --runs`.

#include "engine/simulation/given_motion.hpp"
#include "sim-server/drive/drive_loader.hpp"

namespace septet::server {

/// Meta row of a run's session: its departure (engine/simulation/deviation_text.hpp). Its file holds the table as given.
inline constexpr const char* motion_deviation_row = "motion_deviation";

/// The drive with the departing table in the stead of its own, which it has.
LoadedDrive departing_drive(LoadedDrive drive, const simulation::MotionDeviation& deviation);

}  // namespace septet::server
