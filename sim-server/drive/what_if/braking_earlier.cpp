#include "sim-server/drive/what_if/braking_earlier.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "engine/math/speed_units.hpp"
#include "sim-server/drive/what_if/variant.hpp"

namespace septet::server {
namespace {

/// A collision earlier than this leaves no time in which anything could have been done earlier.
constexpr double least_before_s = 2.0;
constexpr double whole_second_s = 1.0, usual_brake = 0.8;

struct EarlierBraking {
  std::string begins;  ///< Of the sentence.
  InputChange change;
};

std::string told(const EarlierBraking& braking, const VariantOutcome& outcome, const LoggedCollision& logged) {
  std::string text = braking.begins + ", and you would ";
  const std::string& with = logged.met.with;
  if (outcome.collision && outcome.collision->other == logged.met.other)
    return text + fmt::format("have hit {} with {:.0f} instead of {:.0f} km/h.", with,
                              kmh_per_mps * outcome.collision->closing_speed_mps,
                              kmh_per_mps * logged.met.closing_speed_mps);
  if (outcome.collision)
    return text + fmt::format("have hit {} with {:.0f} km/h.", outcome.collision->with,
                              kmh_per_mps * outcome.collision->closing_speed_mps);
  const auto before_m = outcome.least_gap_m ? outcome.least_gap_m : outcome.before_place_m;
  if (outcome.stopped_s && before_m) return text + fmt::format("have stopped {:.1f} m before {}.", *before_m, with);
  return text + fmt::format("not have hit {}.", with);
}

}  // namespace

Expected<std::optional<std::string>> braking_earlier(const logging::SessionReader& session) {
  const auto& other = session.info().other;
  const auto traffic = other.find("traffic");
  if (other.contains("log") || (traffic != other.end() && traffic->second != "own"))
    return std::optional<std::string>();
  // Nobody braked in a car that goes by a table.
  if (std::ranges::count(session.info().files, motion_role, &logging::SourceFile::role) > 0)
    return std::optional<std::string>();
  const auto events = session.events();
  if (!events) return tl::unexpected(events.error());
  const auto hit = std::ranges::find(*events, "collision", &logging::Event::kind);
  if (hit == events->end()) return std::optional<std::string>();
  const auto span = session.time_span_s();
  if (!span) return tl::unexpected(span.error());
  if (!*span || hit->simulated_time_s - (*span)->first < least_before_s) return std::optional<std::string>();

  const ChangeableInput& brake = changeable_inputs().front();
  const auto shifted = [&](double by_s) { return InputChange{&brake, ChangeKind::shift, by_s, {}}; };
  std::vector<EarlierBraking> tries{{"Half a second earlier on the brake", shifted(-0.5 * whole_second_s)},
                                    {"A whole second earlier on the brake", shifted(-whole_second_s)}};
  const auto prepare = [&] {
    std::vector<std::vector<InputChange>> extremes;
    extremes.reserve(tries.size());
    for (const EarlierBraking& braking : tries) extremes.push_back({braking.change});
    return prepare_what_if(session, extremes, {});
  };
  auto what_if = prepare();
  if (!what_if) {
    // The brake was not pressed before.
    tries = {{"The brake pressed by 80 % one second before",
              InputChange{&brake, ChangeKind::set, usual_brake, hit->simulated_time_s - whole_second_s}}};
    what_if = prepare();
  }
  if (!what_if) return tl::unexpected(what_if.error());
  std::string text;
  for (const EarlierBraking& braking : tries) {
    const auto outcome = run_variant(*what_if, {&braking.change, 1});
    if (!outcome) return tl::unexpected(outcome.error());
    text += (text.empty() ? "" : " ") + told(braking, *outcome, *what_if->logged);
    if (!outcome->collision) break;
  }
  return std::optional(std::move(text));
}

}  // namespace septet::server
