#pragma once
/// A driver's inputs over time from a CSV file: `septet vehicle test --inputs FILE.csv`.
///
/// The first line names the columns, in any order: time_s (ascending, needed), steering_wheel_deg (positive to the left),
/// accelerator, brake, clutch (0 released to 1), gear (−1 reverse, 0 neutral, 1…), parking_brake (0 or 1). A column that is not
/// there is 0; without gear the selector is in D. Lines that are empty or begin with # are passed over.

#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/physics/vehicle/manoeuvre.hpp"

namespace septet::server {

/// Error: with the line, what is wrong and what to write. `name`: of the file, for the message.
Expected<std::vector<vehicle::TimedInput>> read_input_table(std::string_view text, std::string_view name);

}  // namespace septet::server
