#include "logging/study/report/told_event.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/core.h>

#include "engine/document/table_line.hpp"
#include "engine/world/hazard.hpp"
#include "engine/world/people_errors.hpp"
#include "engine/world/solid.hpp"
#include "logging/study/measures/crashes.hpp"

namespace septet::logging {
namespace {

enum Row : std::size_t {
  marks,
  operators,
  ratings,
  storyboard,
  games,
  collisions,
  lane_changes,
  glances,
  rules,
  others
};

Row row_of(std::string_view kind) {
  using enum Row;
  static const std::map<std::string_view, Row> rows{{"mark", marks},
                                                    {"word", marks},
                                                    {"operator", operators},
                                                    {operator_command_kind, operators},
                                                    {"rating", ratings},
                                                    {"scenario", storyboard},
                                                    {"game", games},
                                                    {"collision", collisions},
                                                    {"crash_of_others", collisions},
                                                    {crash_event, collisions},
                                                    {"kerb", collisions},
                                                    {"wheel_damage", collisions},
                                                    {"mirror_glance", glances},
                                                    {"lane_change", lane_changes},
                                                    {"right_of_way", rules},
                                                    {"turn", rules},
                                                    {"speed_limit", rules}};
  const auto found = rows.find(kind);
  return found == rows.end() ? others : found->second;
}

/// The value of `key=` up to the next blank, or within quotes.
std::optional<std::string> value_of(std::string_view detail, std::string_view key) {
  for (std::size_t at = detail.find(key); at != detail.npos; at = detail.find(key, at + 1)) {
    if (at != 0 && detail[at - 1] != ' ') continue;
    std::string_view rest = detail.substr(at + key.size());
    if (!rest.starts_with('=')) continue;
    rest.remove_prefix(1);
    const bool is_quoted = rest.starts_with('"');
    if (is_quoted) rest.remove_prefix(1);
    return std::string(rest.substr(0, rest.find(is_quoted ? '"' : ' ')));
  }
  return std::nullopt;
}

/// Text behind the first of these words, to the end.
std::optional<std::string> rest_behind(std::string_view detail, std::string_view key) {
  const auto at = detail.find(key);
  return at == detail.npos ? std::nullopt : std::optional(std::string(detail.substr(at + key.size())));
}

/// The author stands before " note=", " wish=" or " text=".
std::string said_by(std::string_view detail) {
  if (!detail.starts_with("by=")) return "";
  const auto end = std::min({detail.find(" note="), detail.find(" wish="), detail.find(" text=")});
  return fmt::format(" (by {})", detail.substr(3, end == detail.npos ? end : end - 3));
}

std::string kmh_of(const std::string& metres_per_second) {
  const auto value = document::number_in<double>(metres_per_second);
  return value ? fmt::format("{:.0f} km/h", *value * 3.6) : metres_per_second + " m/s";
}

/// "a::b::c" is c, which is of b: these two are enough.
std::string element_name(const std::string& path) {
  const auto last = path.rfind("::");
  if (path.empty() || last == path.npos) return path.empty() ? "the storyboard" : path;
  const auto before = last == 0 ? path.npos : path.rfind("::", last - 1);
  const auto parent = before == path.npos ? path.substr(0, last) : path.substr(before + 2, last - before - 2);
  return fmt::format("{} ({})", path.substr(last + 2), parent);
}

std::string storyboard_text(std::string_view detail) {
  const auto state = rest_behind(detail, " state=");
  if (!state) return std::string(detail);
  const std::string name(detail.substr(detail.find('=') + 1, detail.rfind(" state=") - detail.find('=') - 1));
  if (detail.starts_with("entity="))
    return name + (*state == "left_at_road_end" ? " left at the road's end" : ": " + *state);
  if (!detail.starts_with("element=")) return std::string(detail);
  return (*state == "running" ? "begins" : *state == "complete" ? "is over" : *state) + ": " + element_name(name);
}

std::string lane_change_text(const Event& event) {
  const auto lanes = value_of(event.detail, "lanes_to_left"), from = value_of(event.detail, "from_lane"),
             to = value_of(event.detail, "to_lane");
  if (!lanes || !from || !to) return event.detail;
  return fmt::format("to the {}, from lane {} to lane {}", lanes->starts_with('-') ? "right" : "left", *from, *to);
}

std::string glance_text(const Event& event) {
  const auto area = value_of(event.detail, "area"), duration_s = value_of(event.detail, "duration_s");
  return area && duration_s ? fmt::format("{}, for {} s", *area, *duration_s) : event.detail;
}

/// "participant 7", or "3 crosser".
std::string called_in_text(const ParticipantNames& names, ParticipantId number) {
  return (names.contains(number) ? "" : "participant ") + called(names, number);
}

std::string collision_text(const Event& event, const ParticipantNames& names) {
  const auto name = struck_by_name(event.detail);
  const std::string whom = name                ? " with " + *name
                           : event.participant ? " with " + called_in_text(names, *event.participant)
                                               : "";
  const auto closing = value_of(event.detail, "closing_speed_mps");
  const std::string_view before = std::string_view(event.detail).substr(0, event.detail.find(' '));
  const std::string with = before.empty() || before.find('=') != before.npos ? whom : fmt::format(" with {}", before);
  const auto by = value_of(event.detail, "by");
  return fmt::format("collision{}{}{}", with, closing ? " at a closing speed of " + kmh_of(*closing) : "",
                     by && *by == "other" ? ", who ran into the driver's car" : "");
}

std::string crash_of_others_text(const Event& event, const ParticipantNames& names) {
  const auto with = value_of(event.detail, "with"), by = value_of(event.detail, "by"),
             closing = value_of(event.detail, "closing_speed_mps");
  if (event.participant && closing && !with)
    return fmt::format("{} ran into {} at a closing speed of {}", called_in_text(names, *event.participant),
                       std::string_view(event.detail).substr(0, event.detail.find(" closing_speed_mps=")),
                       kmh_of(*closing));
  if (!event.participant || !with || !by || !closing) return event.detail;
  const auto name = struck_by_name(event.detail);
  const auto number = document::number_in<ParticipantId>(*with);
  const std::string first = called_in_text(names, *event.participant);
  const std::string second = name ? *name : number ? called_in_text(names, *number) : *with;
  const bool by_first = *by == fmt::format("{}", *event.participant);
  return fmt::format("{} ran into {} at a closing speed of {}", by_first ? first : second, by_first ? second : first,
                     kmh_of(*closing));
}

/// The kind, and its `key=value` pairs verbatim.
std::string plain_text(const Event& event) {
  std::string kind = event.kind;
  std::ranges::replace(kind, '_', ' ');
  return event.detail.empty() ? kind : kind + ": " + event.detail;
}

std::string people_error_text(const Event& event, const ParticipantNames& names) {
  const auto state = value_of(event.detail, "state"), kind = value_of(event.detail, "kind"),
             ended = value_of(event.detail, "ended"), nearest = value_of(event.detail, "nearest_m");
  if (!state || !kind || !event.participant) return plain_text(event);
  const auto other = value_of(event.detail, "whom");
  const auto number = other ? document::number_in<ParticipantId>(*other) : std::nullopt;
  const std::string who = called_in_text(names, *event.participant);
  const std::string what = *kind + (number ? fmt::format(" (of {})", called_in_text(names, *number)) : "");
  if (!ended) return fmt::format("{} errs: {}", who, what);
  return fmt::format("{} errs no more: {}, {}{}", who, what, *ended,
                     nearest ? fmt::format(", {} m apart at the nearest", *nearest) : "");
}

std::string text_of(const Event& event, const ParticipantNames& names) {
  if (event.kind == "mark") return rest_behind(event.detail, "note=").value_or(event.detail) + said_by(event.detail);
  if (event.kind == "word")
    return fmt::format("to the driver: {}{}", rest_behind(event.detail, "text=").value_or(event.detail),
                       said_by(event.detail));
  if (event.kind == "operator")
    return rest_behind(event.detail, "wish=").value_or(event.detail) + said_by(event.detail);
  if (event.kind == "rating") return rest_behind(event.detail, "wish=").value_or(event.detail) + said_by(event.detail);
  if (event.kind == "scenario") return storyboard_text(event.detail);
  if (event.kind == "lane_change") return lane_change_text(event);
  if (event.kind == "mirror_glance") return glance_text(event);
  if (event.kind == "collision") return collision_text(event, names);
  if (event.kind == "crash_of_others") return crash_of_others_text(event, names);
  if (event.kind == crash_event && event.participant)
    if (const auto crash = read_crash(*event.participant, event.detail)) return "crash: " + crash_text(*crash, names);
  if (event.kind == hazard_event)
    if (const auto hazard = read_hazard_note(event.detail)) return "a hazard begins: " + hazard->name;
  if (event.kind == people_error_event) return people_error_text(event, names);
  if (event.kind == "screen") return event.detail;
  if (event.kind == "speed_limit")
    if (const auto kmh = value_of(event.detail, "kmh"))
      return *kmh == "0" ? std::string("no speed limit is posted") : fmt::format("speed limit {} km/h", *kmh);
  return plain_text(event);
}

}  // namespace

const std::vector<EventRow>& event_rows() {
  // Order as in Row.
  static const std::vector<EventRow> rows{
      {"marks", "⚑"},      {"operator", "●"},    {"ratings", "★"},       {"storyboard", ""},    {"game", "◆"},
      {"collisions", "✕"}, {"lane changes", ""}, {"mirror glances", ""}, {"traffic rules", ""}, {"other", ""}};
  return rows;
}

std::vector<ToldEvent> tell_events(const std::vector<Event>& events, const ParticipantNames& names) {
  std::vector<ToldEvent> told;
  told.reserve(events.size());
  for (const Event& event : events)
    told.push_back(
        {event.simulated_time_s, &event_rows()[static_cast<std::size_t>(row_of(event.kind))], text_of(event, names)});
  return told;
}

}  // namespace septet::logging
