#include "sim-server/drive/what_if/input_change.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <system_error>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/simulation/model.hpp"

namespace septet::server {
namespace {

/// Least share of a pedal's travel that presses it.
constexpr double pressed = 0.02;
/// Presses that lie less than this apart are one.
constexpr Tick pause_ticks = 60;
/// An earlier press is no answer to what led to the collision.
constexpr double longest_before_s = 10.0;
constexpr double longest_shift_s = 60.0;
/// Decimal seconds times the tick rate may be a rounding error below the tick.
constexpr double rounding_ticks = 1e-6;

constexpr std::array<ChangeableInput, 4> inputs{{
    {"brake", &DriverInput::brake},
    {"accelerator", &DriverInput::accelerator},
    {"clutch", &DriverInput::clutch},
    {"steering_wheel_rad", &DriverInput::steering_wheel_rad, -20.0, 20.0, false},
}};

tl::unexpected<Error> refused(std::string_view text, std::string what) {
  return failure(std::move(what), fmt::format("--change {}", printable(text)),
                 "write brake:-0.5s, brake:x1.2, brake:=0.8@12.3s, or a range as brake:-1s..0s/1000");
}

/// Takes a number with its unit from the beginning of the text.
std::optional<double> take_number(std::string_view& text, std::string_view unit) {
  std::string_view rest = text;
  if (rest.starts_with('+')) rest.remove_prefix(1);
  double value = 0.0;
  // The point of "1..2" is a range's.
  const auto length = std::min(rest.find(".."), rest.size());
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + length, value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  if (!rest.starts_with(unit)) return std::nullopt;
  text = rest.substr(unit.size());
  return value;
}

bool take_word(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

std::string_view unit_of(ChangeKind kind) { return kind == ChangeKind::shift ? "s" : ""; }

Expected<void> check_value(std::string_view text, const InputChange& change, double value) {
  const ChangeableInput& input = *change.input;
  if (change.kind == ChangeKind::shift && std::abs(value) > longest_shift_s)
    return refused(text, fmt::format("a shift by {:g} s is more than {:g} s", value, longest_shift_s));
  if (change.kind == ChangeKind::scale && !(value >= 0.0 && value <= 100.0))
    return refused(text, fmt::format("the factor {:g} does not lie between 0 and 100", value));
  if (change.kind == ChangeKind::set && !(value >= input.least && value <= input.most))
    return refused(
        text, fmt::format("{} lies between {:g} and {:g}; {:g} does not", input.name, input.least, input.most, value));
  return {};
}

Tick last_tick(const KnownInputs& known) { return known.records.back().tick; }

/// The logged input of a tick, held before the first and after the last known one.
const DriverInput& logged(const KnownInputs& known, std::int64_t tick, Tick until) {
  const auto first = static_cast<std::int64_t>(known.records.front().tick);
  const auto at = std::clamp(tick, first, static_cast<std::int64_t>(until)) - first;
  return known.records[static_cast<std::size_t>(at)].input;
}

/// The first tick of the last press before the collision; empty: none.
std::optional<Tick> press_before(const KnownInputs& known, double DriverInput::*pedal) {
  const Tick first = known.records.front().tick;
  const auto reach = static_cast<Tick>(longest_before_s * simulation::tick_rate_hz);
  std::optional<Tick> began;
  for (Tick tick = known.until + 1; tick-- > first;) {
    if (logged(known, static_cast<std::int64_t>(tick), known.until).*pedal > pressed)
      began = tick;
    else if (began ? *began - tick > pause_ticks : known.until - tick > reach)
      break;
  }
  return began;
}

}  // namespace

std::span<const ChangeableInput> changeable_inputs() { return inputs; }

InputChange change_at(const ChangeRange& range, std::size_t i) {
  InputChange change = range.first;
  if (range.count > 1) {
    const double share = static_cast<double>(i) / static_cast<double>(range.count - 1);
    // Rounded, so that a table has -0.1 and not -0.09999999999999998.
    change.value = std::round(std::lerp(change.value, range.last_value, share) * 1e9) / 1e9;
  }
  return change;
}

Expected<ChangeRange> parse_change(std::string_view text) {
  const auto colon = text.find(':');
  const auto input = std::ranges::find(inputs, text.substr(0, colon), &ChangeableInput::name);
  if (input == inputs.end()) {
    std::string names;
    for (const auto& each : inputs) names += fmt::format("{}{}", names.empty() ? "" : ", ", each.name);
    return failure(fmt::format("there is no input \"{}\"", printable(text.substr(0, colon))), "--change",
                   fmt::format("use one of: {}", names));
  }
  if (colon == std::string_view::npos) return refused(text, "the change is missing");
  std::string_view rest = text.substr(colon + 1);
  ChangeRange range;
  InputChange& change = range.first;
  change.input = &*input;
  if (take_word(rest, "="))
    change.kind = ChangeKind::set;
  else if (take_word(rest, "x"))
    change.kind = ChangeKind::scale;
  const std::string_view unit = unit_of(change.kind);
  const auto value = take_number(rest, unit);
  if (!value) return refused(text, unit.empty() ? "there is no number" : "there is no number of seconds, as -0.5s");
  change.value = range.last_value = *value;
  if (take_word(rest, "..")) {
    const auto last = take_number(rest, unit);
    const auto count = last && take_word(rest, "/") ? take_number(rest, "") : std::nullopt;
    if (!count) return refused(text, "a range is FIRST..LAST/COUNT");
    if (!(*count >= 2.0 && *count <= static_cast<double>(most_variants)) || *count != std::floor(*count))
      return refused(text, fmt::format("a range has 2 to {} variants", most_variants));
    range.last_value = *last;
    range.count = static_cast<std::size_t>(*count);
  }
  if (take_word(rest, "@")) {
    const auto from_s = take_number(rest, "s");
    if (!from_s || *from_s < 0.0 || *from_s > 1e6) return refused(text, "the instant after @ is no time, as 12.3s");
    change.from_s = from_s;
  }
  if (!rest.empty()) return refused(text, fmt::format("\"{}\" is left over", printable(rest)));
  for (const double each : {change.value, range.last_value})
    if (auto checked = check_value(text, change, each); !checked) return tl::unexpected(checked.error());
  if (!change.from_s && (!input->is_pedal || change.kind == ChangeKind::set))
    return refused(text, "the instant is missing from which on it is changed: end with @12.3s");
  return range;
}

std::string text_of(const InputChange& change) {
  const std::string from = change.from_s ? fmt::format("@{}s", *change.from_s) : "";
  switch (change.kind) {
    case ChangeKind::shift:
      return fmt::format("{}:{:+}s{}", change.input->name, change.value, from);
    case ChangeKind::scale:
      return fmt::format("{}:x{}{}", change.input->name, change.value, from);
    case ChangeKind::set:
      break;
  }
  return fmt::format("{}:={}{}", change.input->name, change.value, from);
}

Expected<PlacedChange> place_change(const InputChange& change, const KnownInputs& known, const std::string& where) {
  const Tick begin = known.records.front().tick;
  const auto seconds = [](Tick tick) { return static_cast<double>(tick) / simulation::tick_rate_hz; };
  PlacedChange placed{.change = change};
  if (change.from_s) {
    placed.from = static_cast<Tick>(*change.from_s * simulation::tick_rate_hz + rounding_ticks);
    if (placed.from < begin || placed.from > known.until)
      return failure(fmt::format("the instant of {} lies outside of what was driven before the collision or the end, "
                                 "{:.2f} to {:.2f} s",
                                 text_of(change), seconds(begin), seconds(known.until)),
                     where, "give an instant within");
  } else {
    const auto press = press_before(known, change.input->value);
    if (!press)
      return failure(fmt::format("the {} was not pressed in the {:g} s before {:.2f} s", change.input->name,
                                 longest_before_s, seconds(known.until)),
                     where,
                     fmt::format("set it: {}:=0.8@{:.1f}s", change.input->name,
                                 std::max(seconds(begin), seconds(known.until) - 1.0)));
    placed.from = *press;
  }
  placed.first = placed.from;
  if (change.kind == ChangeKind::shift) {
    placed.by = std::llround(change.value * simulation::tick_rate_hz);
    if (placed.by < 0) {
      if (placed.from < begin + static_cast<Tick>(-placed.by))
        return failure(
            fmt::format("{} would begin before the session does, at {:.2f} s", text_of(change), seconds(begin)), where,
            "shift it by less");
      placed.first -= static_cast<Tick>(-placed.by);
    }
  }
  return placed;
}

DriverInput changed_input(const KnownInputs& known, std::span<const PlacedChange> changes, Tick tick) {
  const auto at = static_cast<std::int64_t>(tick);
  if (changes.empty()) return logged(known, at, last_tick(known));
  const DriverInput before = logged(known, at, known.until);
  DriverInput input = before;
  bool is_brake_changed = false;
  for (const PlacedChange& placed : changes) {
    if (tick < placed.first) continue;
    const ChangeableInput& changed = *placed.change.input;
    double& value = input.*changed.value;
    switch (placed.change.kind) {
      case ChangeKind::shift:
        // Until what was shifted to a later time comes, the input stays as it was before.
        value =
            logged(known,
                   at - placed.by < static_cast<std::int64_t>(placed.from) ? static_cast<std::int64_t>(placed.from) - 1
                                                                           : at - placed.by,
                   known.until).*
            changed.value;
        break;
      case ChangeKind::scale:
        value = std::clamp(value * placed.change.value, changed.least, changed.most);
        break;
      case ChangeKind::set:
        value = placed.change.value;
        break;
    }
    is_brake_changed = is_brake_changed || changed.value == &DriverInput::brake;
  }
  if (is_brake_changed && input.brake > pressed && !(before.brake > pressed)) input.accelerator = 0.0;
  return input;
}

}  // namespace septet::server
