#include "logging/session/session_digest.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "engine/document/json.hpp"
#include "logging/session/outcome_json.hpp"
#include "logging/session/session_reader.hpp"

namespace septet::logging {
namespace {

using document::Json;

void add_text(const std::string& text, StateHash& hash) { hash.add_bytes(std::as_bytes(std::span(text))); }

/// Value as stored by SQLite: one zero, and NULL for NaN.
double as_kept(double value) { return std::isnan(value) ? std::numeric_limits<double>::quiet_NaN() : value + 0.0; }

struct Part {
  const char* key;
  const char* words;
  StateHash SessionDigest::*hash;
};
constexpr std::array parts = {Part{"setup", "its files, seeds or parameters were", &SessionDigest::setup},
                              Part{"scene", "its scene was", &SessionDigest::scene},
                              Part{"ticks", "its ticks were", &SessionDigest::ticks},
                              Part{"states", "its saved states were", &SessionDigest::states},
                              Part{"commands", "what an operator changed was", &SessionDigest::commands},
                              Part{"samples", "its samples were", &SessionDigest::samples}};

Expected<Json> read_row(const std::string& row, const std::string& where) {
  Json json = Json::parse(row, nullptr, false);
  bool is_whole = json.is_object();
  for (const Part& part : parts) is_whole = is_whole && json.contains(part.key) && json[part.key].is_string();
  if (!is_whole)
    return failure("the meta row digests is not what Septet writes", where,
                   "the file was altered or damaged: use a copy");
  return json;
}

}  // namespace

void SessionDigest::add(const SessionInfo& info) {
  setup.add(info.ticks_per_second);
  for (const auto& [name, seed] : info.seeds) add_text(name, setup), setup.add(seed);
  for (const auto& [name, value] : info.parameters) add_text(name, setup), add_text(value, setup);
  for (const char* key : {"driver", "traffic", "log", "vehicle_models", "participant_names", begun_at_row})
    if (const auto row = info.other.find(key); row != info.other.end())
      add_text(row->first, setup), add_text(row->second, setup);
  for (const SourceFile& file : info.files)
    add_text(file.role, setup), add_text(file.name, setup), add_text(file.content, setup);
}

void SessionDigest::add(const SceneEdit& edit) {
  scene.add(edit.tick);
  scene.add_bytes(edit.command);
}

void SessionDigest::add_tick(Tick tick, double simulated_time_s, std::uint64_t state_hash) {
  ticks.add(tick);
  ticks.add(simulated_time_s);
  ticks.add(state_hash);
}

void SessionDigest::add(const StateRecord& state) {
  states.add(state.tick);
  states.add_bytes(state.data);
}

void SessionDigest::add(const Event& event) {
  if (event.kind != operator_command_kind) return;
  commands.add(event.tick);
  add_text(event.detail, commands);
}

void SessionDigest::add(const Sample& s) {
  samples.add(s.tick);
  for (const double value :
       {s.simulated_time_s, s.x_m, s.y_m, s.z_m, s.heading_rad, s.speed_mps, s.longitudinal_acceleration_mps2,
        s.lateral_acceleration_mps2, s.yaw_rate_radps, s.road_s_m, s.lateral_position_m, s.lane_width_m,
        s.steering_wheel_rad, s.accelerator, s.brake, s.clutch, s.gaze_heading_rad})
    samples.add(as_kept(value));
  for (const std::int64_t value : {std::int64_t{s.road}, std::int64_t{s.lane}, std::int64_t{s.gear},
                                   static_cast<std::int64_t>(s.lamps.bits), std::int64_t{s.leader.has_value()}})
    samples.add(value);
  if (!s.leader) return;
  samples.add(s.leader->participant);
  for (const double value : {s.leader->distance_gap_m, s.leader->distance_headway_m, s.leader->speed_mps})
    samples.add(as_kept(value));
}

std::string to_json(const SessionDigest& digest) {
  Json json = Json::object();
  for (const Part& part : parts) json[part.key] = hash_digits((digest.*part.hash).value());
  return document::text_of(json);
}

Expected<std::optional<std::string>> altered_part(const SessionDigest& found, const std::string& row,
                                                  const std::string& where) {
  const auto json = read_row(row, where);
  if (!json) return tl::unexpected(json.error());
  for (const Part& part : parts)
    if (json->at(part.key).get<std::string>() != hash_digits((found.*part.hash).value()))
      return std::optional<std::string>(part.words);
  return std::optional<std::string>();
}

namespace {

/// True if the part of the session's digest is that of `found`; empty: the session has no digest.
Expected<std::optional<bool>> is_as_driven(const SessionReader& session, const SessionDigest& found, const char* key,
                                           StateHash SessionDigest::*part, const char* what) {
  const auto row = session.info().other.find(digest_row);
  if (row == session.info().other.end()) return std::optional<bool>();
  const std::string where = session.path().string();
  const auto json = read_row(row->second, where);
  if (!json) return tl::unexpected(json.error());
  if (json->at(key).get<std::string>() == hash_digits((found.*part).value())) return std::optional(true);
  return failure(what, where, "it was altered or damaged: use an unaltered copy");
}

}  // namespace

Expected<std::optional<bool>> is_scene_as_driven(const SessionReader& session) {
  const auto edits = session.scene_edits();
  if (!edits) return tl::unexpected(edits.error());
  SessionDigest found;
  for (const SceneEdit& edit : *edits) found.add(edit);
  return is_as_driven(session, found, "scene", &SessionDigest::scene,
                      "the session's scene is not the one that was driven in");
}

Expected<std::optional<bool>> are_commands_as_driven(const SessionReader& session) {
  const auto events = session.events();
  if (!events) return tl::unexpected(events.error());
  SessionDigest found;
  for (const Event& event : *events) found.add(event);
  return is_as_driven(session, found, "commands", &SessionDigest::commands,
                      "the session's operator's commands and calls are not those that were made");
}

}  // namespace septet::logging
