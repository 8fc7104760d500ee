#include "logging/session/outcome.hpp"

#include <charconv>
#include <cmath>

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "logging/session/outcome_json.hpp"

namespace septet::logging {
namespace {

using document::Json, document::number;

std::uint64_t from_hex(const std::string& text) {
  std::uint64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return value;
}

Json optional_number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json json_of(const ScreenOutcome& screen) {
  return {{"name", screen.name},
          {"frames", screen.frames},
          {"frames_off_tick", screen.frames_off_tick},
          {"datagrams_lost", screen.datagrams_lost},
          {"datagrams_repaired", screen.datagrams_repaired},
          {"refused_ticks", screen.refused_ticks},
          {"frame_ms_p50", number(screen.frame_ms_p50)},
          {"frame_ms_p99", number(screen.frame_ms_p99)},
          {"submit_ms_p50", number(screen.submit_ms_p50)},
          {"submit_ms_p99", number(screen.submit_ms_p99)},
          {"report_to_picture_ms_p50", optional_number(screen.report_to_picture_ms_p50)},
          {"report_to_picture_ms_p99", optional_number(screen.report_to_picture_ms_p99)},
          {"connected_s", screen.connected_s},
          {"left_s", screen.left_s},
          {"left_behind_s", screen.left_behind_s},
          {"has_reported", screen.has_reported}};
}

/// A number that `number` wrote.
double real(const Json& json) { return json.is_null() ? std::nan("") : json.get<double>(); }

/// Absent from earlier builds.
std::optional<double> optional_real(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found == json.end() || found->is_null() ? std::nullopt : std::optional(found->get<double>());
}

ScreenOutcome screen_of(const Json& json) {
  ScreenOutcome screen;
  json.at("name").get_to(screen.name);
  json.at("frames").get_to(screen.frames);
  json.at("frames_off_tick").get_to(screen.frames_off_tick);
  json.at("datagrams_lost").get_to(screen.datagrams_lost);
  json.at("datagrams_repaired").get_to(screen.datagrams_repaired);
  json.at("refused_ticks").get_to(screen.refused_ticks);
  screen.frame_ms_p50 = real(json.at("frame_ms_p50"));
  screen.frame_ms_p99 = real(json.at("frame_ms_p99"));
  screen.submit_ms_p50 = real(json.at("submit_ms_p50"));
  screen.submit_ms_p99 = real(json.at("submit_ms_p99"));
  screen.report_to_picture_ms_p50 = optional_real(json, "report_to_picture_ms_p50");
  screen.report_to_picture_ms_p99 = optional_real(json, "report_to_picture_ms_p99");
  json.at("connected_s").get_to(screen.connected_s);
  json.at("left_s").get_to(screen.left_s);
  json.at("left_behind_s").get_to(screen.left_behind_s);
  json.at("has_reported").get_to(screen.has_reported);
  return screen;
}

}  // namespace

std::string hash_digits(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

Json json_of(const DriveOutcome& outcome) {
  Json screens = Json::array();
  for (const ScreenOutcome& screen : outcome.screens) screens.push_back(json_of(screen));
  return {{"ended", name_of(outcome.end)},
          {"ended_text", text_of(outcome.end)},
          {"exit_status", exit_status(outcome.end)},
          {"error", outcome.error.empty() ? Json(nullptr) : Json(outcome.error)},
          {"ticks", outcome.ticks},
          {"simulated_s", number(outcome.simulated_s)},
          {"wall_s", number(outcome.wall_s)},
          {"state_hash", hash_digits(outcome.state_hash)},
          {"inputs_hash", hash_digits(outcome.inputs_hash)},
          {"late_ticks", outcome.late_ticks},
          {"bad_numbers", outcome.bad_numbers},
          {"log", {{"lost_records", outcome.lost_records}, {"waited_s", number(outcome.log_waited_s)}}},
          {"screens", std::move(screens)}};
}

std::string to_json(const DriveOutcome& outcome) { return document::text_of(json_of(outcome)); }

Expected<DriveOutcome> read_outcome(const std::string& text, const std::string& where) {
  const auto refused = [&] {
    return failure("the meta row outcome is not what Septet writes", where,
                   "the file was altered or damaged: use an unaltered copy");
  };
  try {
    const Json json = Json::parse(text);
    const auto end = drive_end_called(json.at("ended").get<std::string>());
    if (!end) return refused();
    DriveOutcome outcome;
    outcome.end = *end;
    if (!json.at("error").is_null()) json.at("error").get_to(outcome.error);
    json.at("ticks").get_to(outcome.ticks);
    outcome.simulated_s = real(json.at("simulated_s"));
    outcome.wall_s = real(json.at("wall_s"));
    outcome.state_hash = from_hex(json.at("state_hash").get<std::string>());
    outcome.inputs_hash = from_hex(json.at("inputs_hash").get<std::string>());
    json.at("late_ticks").get_to(outcome.late_ticks);
    outcome.bad_numbers = json.value("bad_numbers", std::uint64_t{0});  // Absent from earlier builds.
    json.at("log").at("lost_records").get_to(outcome.lost_records);
    outcome.log_waited_s = real(json.at("log").at("waited_s"));
    for (const Json& screen : json.at("screens")) outcome.screens.push_back(screen_of(screen));
    return outcome;
  } catch (const Json::exception&) {
    return refused();
  }
}

}  // namespace septet::logging
