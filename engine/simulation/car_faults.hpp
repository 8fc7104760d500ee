#pragma once
/// Faults of the driver's car that an operator sets and clears, and the warning lamps that show them.

#include <optional>
#include <span>
#include <string_view>

#include "engine/physics/vehicle/faults.hpp"
#include "engine/world/car_warnings.hpp"
#include "engine/world/lamps.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

struct Model;
struct State;

/// Faults beside tyres, which are damage of the wheels.
struct CarFaults {
  vehicle::Faults vehicle;
  Lamps lamps_out;  ///< Lamps with failed bulbs: they stay dark.

  bool any() const { return vehicle.any() || lamps_out.bits != 0; }
  bool operator==(const CarFaults&) const = default;
};

/// Names of all possible faults, as commands and the page write them: "tyre_front_left", "anti_lock", "misfire",
/// "lamp_brake".
std::span<const std::string_view> fault_names();
/// Empty where there is no such fault.
std::optional<std::size_t> fault_of_name(std::string_view name);

/// True while the fault holds. `fault` is one of fault_names().
bool has_failed(std::size_t fault, const State& state);
/// Sets the fault or clears it.
void set_fault(std::size_t fault, bool failed, State& state);

/// The lit warning lamps, as one keyframe; empty where all are dark.
CarWarnings warnings_of(const State& state);
std::optional<EffectKeyframe> warning_keyframe(const State& state);

}  // namespace septet::simulation
