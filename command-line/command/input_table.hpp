#pragma once
/// A driver's inputs over time from a CSV file: `septet vehicle test --inputs FILE.csv`.
///
/// The first line names the columns, in any order: time_s (ascending, required), steering_wheel_deg (positive to the
/// left), accelerator, brake, clutch (0 released to 1), gear (−1 reverse, 0 neutral, 1…), parking_brake (0 or 1). A
/// missing column is 0; without gear the selector is in D. Empty lines and comments (#) are skipped.

#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/physics/vehicle/manoeuvre.hpp"

namespace septet::server {

/// Error: the line, the fault and the remedy. `name`: of the file, for the message.
Expected<std::vector<vehicle::TimedInput>> read_input_table(std::string_view text, std::string_view name);

}  // namespace septet::server
