#pragma once
/// Vehicle parameters from TOML text (vehicles/*.toml; vehicles/README.md describes the format).
///
/// Every number stands as { value = …, source = "…" } or { x = […], y = […], source = "…" }, the
/// source beginning with "sourced:", "derived:" or "assumed:". A missing entry, a missing source,
/// an unknown name and a value out of its bounds are errors that name the entry.

#include <string_view>

#include "engine/core/expected.hpp"
#include "engine/physics/vehicle/vehicle_parameters.hpp"

namespace septet::vehicle {

/// `name` stands for the text in messages, such as the file's name.
Expected<VehicleParameters> read_vehicle(std::string_view toml, std::string_view name);

}  // namespace septet::vehicle
