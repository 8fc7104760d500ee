#pragma once
/// What a drive was, as five hashes in the session's meta row `digests`, written when the log is closed: who reads it can tell
/// whether it has been altered or damaged since, without driving again. They protect against damage and slips, not against
/// forgery. What may be added or taken out after the drive is in none of them: who drove, answers, notes.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/expected.hpp"
#include "engine/core/hash.hpp"
#include "logging/records.hpp"

namespace septet::logging {

class SessionReader;

/// The meta row of a drive that begins at a state which an earlier one had kept: its first tick. The session holds that state.
inline constexpr const char* begun_at_row = "begun_at_tick";

struct SessionDigest {
  StateHash setup;     ///< Files, seeds, parameters, tick rate, traffic, names and models of participants.
  StateHash scene;     ///< Scene edits.
  StateHash ticks;     ///< Each snapshot's tick, time and state hash.
  StateHash states;    ///< Saved states.
  StateHash commands;  ///< What an operator changed.
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

/// What differs between what a session holds and what its digest says, in words: "its scene was", "its samples were".
/// Nothing where all agrees. Error: the row is not what Septet writes.
Expected<std::optional<std::string>> altered_part(const SessionDigest& found, const std::string& row,
                                                  const std::string& where);

/// Whether the scene is the one that was driven in; nothing where the session has no digest: it is of an earlier build, or its
/// drive was killed. Error: it is another one, or cannot be read.
Expected<std::optional<bool>> is_scene_as_driven(const SessionReader& session);

}  // namespace septet::logging
