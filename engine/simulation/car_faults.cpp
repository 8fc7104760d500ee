#include "engine/simulation/car_faults.hpp"

#include <algorithm>
#include <array>

#include "engine/core/check.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {
namespace {

/// UN R141 requires the warning at a fifth of the pressure lost.
constexpr double warned_from_lost_air = 0.2;

constexpr std::size_t wheels = vehicle::wheel_count;
constexpr std::array<std::string_view, 11> names{
    "tyre_front_left", "tyre_front_right", "tyre_rear_left", "tyre_rear_right",     "anti_lock",           "misfire",
    "lamp_low_beam",   "lamp_high_beam",   "lamp_brake",     "lamp_indicator_left", "lamp_indicator_right"};
constexpr std::size_t anti_lock = wheels, misfire = wheels + 1, first_lamp = wheels + 2;
constexpr std::array lamps{Lamp::low_beam, Lamp::high_beam, Lamp::brake, Lamp::indicator_left, Lamp::indicator_right};
static_assert(names.size() == first_lamp + lamps.size());

}  // namespace

std::span<const std::string_view> fault_names() { return names; }

std::optional<std::size_t> fault_of_name(std::string_view name) {
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
}

bool has_failed(std::size_t fault, const State& state) {
  SEPTET_CHECK(fault < names.size(), "fault {}", fault);
  if (fault < wheels) return state.car.wheels[fault].damage.lost_air > 0.0;
  if (fault == anti_lock) return state.faults.vehicle.anti_lock;
  if (fault == misfire) return state.faults.vehicle.misfire;
  return state.faults.lamps_out.has(lamps[fault - first_lamp]);
}

void set_fault(std::size_t fault, bool failed, State& state) {
  SEPTET_CHECK(fault < names.size(), "fault {}", fault);
  if (fault < wheels) {
    failed ? vehicle::puncture(state.car.wheels[fault]) : vehicle::change_tyre(state.car.wheels[fault]);
  } else if (fault == anti_lock) {
    state.faults.vehicle.anti_lock = failed;
    if (failed) vehicle::release_controls(state.car);
  } else if (fault == misfire) {
    state.faults.vehicle.misfire = failed;
  } else {
    state.faults.lamps_out.set(lamps[fault - first_lamp], failed);
  }
}

CarWarnings warnings_of(const State& state) {
  CarWarnings warnings;
  for (const vehicle::WheelState& wheel : state.car.wheels)
    warnings.tyre_pressure = warnings.tyre_pressure || wheel.damage.lost_air >= warned_from_lost_air;
  warnings.anti_lock = state.faults.vehicle.anti_lock;
  warnings.engine = state.faults.vehicle.misfire;
  warnings.lamp = state.faults.lamps_out.bits != 0;
  return warnings;
}

std::optional<EffectKeyframe> warning_keyframe(const State& state) {
  const CarWarnings warnings = warnings_of(state);
  if (!warnings.any()) return std::nullopt;
  EffectKeyframe keyframe;
  keyframe.id = car_warning_effect_id;
  keyframe.kind = car_warning_keyframe_kind;
  keyframe.data = encode_car_warnings(warnings);
  return keyframe;
}

}  // namespace septet::simulation
