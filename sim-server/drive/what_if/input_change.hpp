#pragma once
/// A change of one of the driver's inputs, and the inputs of a drive with such changes.
///
///     brake:-0.5s                    the braking before the collision begins half a second earlier
///     brake:x1.2                     and is 1.2 times as strong
///     brake:=0.8@12.3s               from 12.3 s on the pedal is at 0.8
///     steering_wheel_rad:+0.2s@9s    what was steered from 9 s on comes 0.2 s later
///     brake:-1s..0s/1000             a range: 1000 changes, evenly spaced, both ends among them
///
/// What the driver did once he knew of the collision is no answer to another course of things: a changed drive takes
/// from the log what comes before the collision alone; from there on each input stays as it was at the collision. One
/// foot does not press two pedals: where a changed brake presses and the logged one did not, the accelerator is
/// released.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/world/driver_input.hpp"
#include "logging/session/records.hpp"

namespace septet::server {

/// An input that can be changed, under its name in the log.
struct ChangeableInput {
  std::string_view name;
  double DriverInput::*value = nullptr;
  double least = 0.0, most = 1.0;
  bool is_pedal = true;
};
std::span<const ChangeableInput> changeable_inputs();

enum class ChangeKind {
  shift,  ///< By seconds; negative: earlier.
  scale,  ///< By a factor.
  set,    ///< To a value, in the input's unit.
};

struct InputChange {
  const ChangeableInput* input = nullptr;
  ChangeKind kind = ChangeKind::shift;
  double value = 0.0;
  /// Logged instant (simulated) from which the input is changed; empty: where the last press of the pedal before the
  /// collision begins.
  std::optional<double> from_s;
  bool operator==(const InputChange&) const = default;
};

/// Changes that differ in their value alone.
struct ChangeRange {
  InputChange first;
  double last_value = 0.0;
  std::size_t count = 1;
};
/// Change number i, 0 to count − 1.
InputChange change_at(const ChangeRange& range, std::size_t i);

/// Most changes of a range.
inline constexpr std::size_t most_variants = 1'000'000;

/// Error: no such input, no number, a value beyond the input's range, or a shift by more than a minute.
Expected<ChangeRange> parse_change(std::string_view text);
/// The text that parses to the change.
std::string text_of(const InputChange& change);

/// The logged inputs of a drive, as far as a changed one may have them.
struct KnownInputs {
  std::span<const logging::InputRecord> records;  ///< One each tick, without a gap; at least one.
  Tick until = 0;                                 ///< Tick of the collision, else the last one; among the records.
};

/// A change with its place in the log.
struct PlacedChange {
  InputChange change;
  Tick from = 0;        ///< The first logged tick that the change is about.
  Tick first = 0;       ///< The first tick whose input may differ.
  std::int64_t by = 0;  ///< Ticks of a shift; negative: earlier.
};

/// Error: the pedal was not pressed in the ten seconds before the collision, the instant lies outside of the log or
/// after the collision, or a shift begins before the log. `where` is the session.
Expected<PlacedChange> place_change(const InputChange& change, const KnownInputs& known, const std::string& where);

/// The driver's input at a tick, also after the log's end. Without changes the logged one, to its last tick.
DriverInput changed_input(const KnownInputs& known, std::span<const PlacedChange> changes, Tick tick);

}  // namespace septet::server
