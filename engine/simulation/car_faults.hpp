#pragma once
/// Faults of the driver's car that somebody beside the drive sets and takes back, and the warning lamps that tell of them.

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

/// Beside tyres, which are damage of the wheels.
struct CarFaults {
  vehicle::Faults vehicle;
  Lamps lamps_out;  ///< Whose bulbs have gone: they stay dark.

  bool any() const { return vehicle.any() || lamps_out.bits != 0; }
  bool operator==(const CarFaults&) const = default;
};

/// What may fail, by the word that commands and the page have for it: "tyre_front_left", "anti_lock", "misfire", "lamp_brake".
std::span<const std::string_view> fault_names();
/// Nothing where there is no such fault.
std::optional<std::size_t> fault_of_name(std::string_view name);

/// Whether it is so now. `fault` is one of fault_names().
bool has_failed(std::size_t fault, const State& state);
/// It fails now, or is whole again.
void set_fault(std::size_t fault, bool failed, State& state);

/// The warning lamps that are lit, as one keyframe; nothing where none is.
CarWarnings warnings_of(const State& state);
std::optional<EffectKeyframe> warning_keyframe(const State& state);

}  // namespace septet::simulation
