#include "sim-server/drive/driver_word.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/math/speed_units.hpp"
#include "engine/world/vehicle_model.hpp"
#include "logging/study/measures/crashes.hpp"
#include "sim-client/frame/cockpit_drawing.hpp"

namespace septet::server {
namespace {

/// Closing speed in the detail of a collision; empty if the detail has none.
std::optional<double> closing_speed_mps(std::string_view detail) {
  constexpr std::string_view key = "closing_speed_mps=";
  const auto at = detail.find(key);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = detail.substr(at + key.size());
  double value = 0.0;
  if (std::from_chars(rest.data(), rest.data() + rest.size(), value).ec != std::errc{}) return std::nullopt;
  return std::isfinite(value) ? std::optional(std::abs(value)) : std::nullopt;
}

std::string with_article(std::string what) {
  std::ranges::replace_if(
      what, [](char c) { return c == '_' || c == '-'; }, ' ');
  const bool begins_with_vowel = std::string_view("aeiou").find(what.front()) != std::string_view::npos;
  return (begins_with_vowel ? "an " : "a ") + what;
}

/// The struck object in words: a participant of the snapshot, or an object beside the road, which the detail begins
/// with.
std::string struck(const Snapshot& now, const simulation::Event& event) {
  if (event.participant) {
    const Participant* other = find_participant(now, *event.participant);
    return other ? with_article(std::string(vehicle_models()[other->model].name)) : "somebody";
  }
  const std::string what = event.detail.substr(0, event.detail.find(' '));
  return what.empty() || what.find('=') != std::string::npos ? "something" : with_article(what);
}

}  // namespace

void DriverWord::take(const Snapshot& now, std::span<const simulation::Event> events) {
  now_s_ = now.simulated_time_s;
  const bool is_first = !std::exchange(has_begun_, true);
  if (now.driver_car.lane != 0 || is_first) on_lane_s_ = now_s_;
  if (!frame::is_stalled(now.driver_car) || is_first) runs_s_ = now_s_;
  for (const simulation::Event& event : events) {
    if (event.kind == crash_event && event.participant == now.driver_car.participant) take_crash(event);
    if (event.kind != "collision") continue;
    const double mps = closing_speed_mps(event.detail).value_or(0.0);
    // Several blows of one crash: only the worst is shown.
    const bool is_told = !blow_.empty() && now_s_ - blow_at_s_ < blow_shown_s;
    if (mps < least_blow_mps || (is_told && mps < blow_mps_)) continue;
    blow_ = struck(now, event);
    blow_is_others_ = event.detail.ends_with("by=other");
    blow_mps_ = mps;
    blow_at_s_ = now_s_;
  }
}

void DriverWord::take_crash(const simulation::Event& event) {
  auto crash = read_crash(*event.participant, event.detail);
  const bool is_of_late = crash_ && now_s_ - crash_at_s_ < blow_shown_s;
  if (!crash || (is_of_late && crash->closing_speed_mps < crash_->closing_speed_mps)) return;
  crash_ = std::move(crash);
  crash_at_s_ = now_s_;
}

std::string DriverWord::outcome() const {
  // The collision tells its speed with two decimals.
  if (!crash_ || std::abs(crash_->closing_speed_mps - blow_mps_) > 0.01) return "";
  const CrashedBody& car = crash_->of_first;
  if (!car.delta_v_mps || !car.principal_direction_rad) return "";
  return fmt::format("\nThe blow came {} and changed your speed by {:.0f} km/h.",
                     logging::whence(*car.principal_direction_rad), kmh_per_mps * glm::length(*car.delta_v_mps));
}

std::string DriverWord::whose_blow() const {
  if (!blow_is_others_) return "You have hit " + blow_;
  std::string text = blow_ + " has run into you";
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

std::string DriverWord::text() const {
  std::string text;
  const auto add = [&](const std::string& line) { text += (text.empty() ? "" : "\n") + line; };
  if (!blow_.empty() && now_s_ - blow_at_s_ < blow_shown_s)
    add(fmt::format("{} at {:.0f} km/h.", whose_blow(), kmh_per_mps * blow_mps_) + outcome());
  if (now_s_ - on_lane_s_ >= off_road_after_s) add("You are off the road.");
  if (now_s_ - runs_s_ >= stalled_after_s)
    add(by_keyboard_ ? "The engine has stalled: V held starts it." : "The engine has stalled: the clutch starts it.");
  if (!text.empty()) add("Escape, then R: begin again. Escape, then Enter: end.");
  return text;
}

std::string words_at_end(logging::DriveEnd end, bool is_lesson) {
  using enum logging::DriveEnd;
  std::string text = end == game_over ? "The game is over" : is_lesson ? "The lesson is over" : "The drive is over";
  if (end == time_over) text += ": its time has passed";
  if (end == road_end) text += ": the road ends here";
  text += is_lesson ? ".\nThe debrief has its mark." : ".";
  return text + "\nR: begin again. Enter: end.";
}

}  // namespace septet::server
