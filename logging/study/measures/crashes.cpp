#include "logging/study/measures/crashes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/math/speed_units.hpp"
#include "logging/study/measures/collisions.hpp"

namespace septet::logging {
namespace {

/// A touch of what stands is told when its impact is over, at most so long after it began.
constexpr double told_after_ticks = 40.0;

/// The detail begins with what stands; two participants have each other's numbers.
bool is_with_standing(const Event& touch) {
  return touch.kind == "crash_of_others" ? !number_in_detail(touch.detail, "with") : !touch.participant;
}

bool are_those_of(const Event& touch, const CrashRecord& crash) {
  const bool of_others = touch.kind == "crash_of_others";
  if (is_with_standing(touch))
    return !crash.second && !crash.stands.empty() && touch.detail.starts_with(crash.stands) &&
           (!of_others || touch.participant == crash.first);
  if (of_others)
    return crash.second && touch.participant == crash.first &&
           number_in_detail(touch.detail, "with") == static_cast<double>(*crash.second);
  return crash.second == touch.participant;
}

std::string body_text(std::string_view who, const CrashedBody& body) {
  std::string text;
  if (body.delta_v_mps) text += fmt::format("ΔV {:.0f} km/h", kmh_per_mps * glm::length(*body.delta_v_mps));
  if (body.principal_direction_rad)
    text += fmt::format("{}{}", text.empty() ? "" : ", ", whence(*body.principal_direction_rad));
  if (body.crush_m) text += fmt::format("{}crushed by {:.2f} m", text.empty() ? "" : ", ", *body.crush_m);
  return text.empty() ? "" : fmt::format("; {}: {}", who, text);
}

}  // namespace

std::vector<CrashRecord> find_crashes(std::span<const Event> events) {
  std::vector<CrashRecord> crashes;
  for (const Event& event : events) {
    if (event.kind != crash_event || !event.participant) continue;
    if (auto crash = read_crash(*event.participant, event.detail)) crashes.push_back(std::move(*crash));
  }
  std::ranges::stable_sort(crashes, {}, &CrashRecord::tick);
  return crashes;
}

std::optional<CrashRecord> crash_of(const Event& touch, std::span<const CrashRecord> crashes) {
  const CrashRecord* found = nullptr;
  for (const CrashRecord& crash : crashes) {
    const double after = static_cast<double>(touch.tick) - static_cast<double>(crash.tick);
    const double latest = is_with_standing(touch) ? told_after_ticks : 0.0;
    if (!(after >= 0.0 && after <= latest) || !are_those_of(touch, crash)) continue;
    // The driver's car has the least number of all.
    if (!found || crash.first < found->first) found = &crash;
  }
  return found ? std::optional(*found) : std::nullopt;
}

std::string_view whence(double principal_direction_rad) {
  static constexpr std::array<std::string_view, 8> words{"from ahead",        "from ahead, left", "from the left",
                                                         "from behind, left", "from behind",      "from behind, right",
                                                         "from the right",    "from ahead, right"};
  const double turns = principal_direction_rad / (2.0 * std::numbers::pi);
  if (!std::isfinite(turns)) return words[0];
  const double eighths = std::round(8.0 * (turns - std::floor(turns)));
  return words[static_cast<std::size_t>(eighths) % words.size()];
}

std::string crash_text(const CrashRecord& crash, const ParticipantNames& names) {
  const bool by_number = crash.second && crash.stands.empty();
  const std::string first = called(names, crash.first);
  const std::string other = by_number ? called(names, *crash.second) : crash.stands;
  const bool lasts = crash.contact_s && *crash.contact_s >= lasting_contact_s;
  return fmt::format("{} {} and {} met at {:.0f} km/h{}{}{}{}", by_number ? "participants" : "participant", first,
                     other, kmh_per_mps * crash.closing_speed_mps, body_text(first, crash.of_first),
                     body_text(other, crash.of_second),
                     lasts ? fmt::format("; in contact for {}", contact_text(*crash.contact_s)) : "",
                     crash.is_unfinished ? "; the drive ended before its impact was over" : "");
}

}  // namespace septet::logging
