#pragma once
/// Fingerprint of a drive: five hashes in the session's meta row `digests`, written when the log is closed, by which a
/// reader detects alteration or damage without driving again. They protect against damage and slips, not against
/// forgery. Later additions and removals are in none of them: driver, answers, notes.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/expected.hpp"
#include "engine/core/hash.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

class SessionReader;

/// The meta row of a drive that begins at a state kept by an earlier one: its first tick. The session holds that state.
inline constexpr const char* begun_at_row = "begun_at_tick";

struct SessionDigest {
  StateHash setup;     ///< Files, seeds, parameters, tick rate, traffic, names and models of participants.
  StateHash scene;     ///< Scene edits.
  StateHash ticks;     ///< Each snapshot's tick, time and state hash.
  StateHash states;    ///< Saved states.
  StateHash commands;  ///< An operator's changes.
  StateHash samples;   ///< All of their columns.

  void add(const SessionInfo& info);
  void add(const SceneEdit& edit);
  void add_tick(Tick tick, double simulated_time_s, std::uint64_t state_hash);
  void add(const StateRecord& state);
  void add(const Event& event);
  void add(const Sample& sample);
};

/// The name of the row, and its text.
inline constexpr const char* digest_row = "digests";
std::string to_json(const SessionDigest& digest);

/// Differences between a session and its digest, in words: "its scene", "its files, seeds or parameters". Empty if all
/// agrees. Error: the row is not in Septet's form.
Expected<std::optional<std::string>> altered_part(const SessionDigest& found, const std::string& row,
                                                  const std::string& where);

/// True if the scene is the driven one; empty if the session has no digest: it is of an earlier build, or its drive was
/// killed. Error: it is another scene, or cannot be read.
Expected<std::optional<bool>> is_scene_as_driven(const SessionReader& session);
/// The same of the operator's commands and the calls: a call leaves no trace in a state's hash.
Expected<std::optional<bool>> are_commands_as_driven(const SessionReader& session);

}  // namespace septet::logging
