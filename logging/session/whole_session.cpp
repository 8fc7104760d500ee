#include "logging/session/whole_session.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "engine/document/json.hpp"
#include "engine/scene/store.hpp"
#include "logging/session/input_hash.hpp"
#include "logging/session/outcome.hpp"
#include "logging/session/participants.hpp"
#include "logging/session/recorded_scene.hpp"
#include "logging/session/session_digest.hpp"
#include "logging/session/shallow_json.hpp"

namespace septet::logging {
namespace {

using document::Json;

tl::unexpected<Error> damaged(const SessionReader& session, const std::string& what) {
  return failure(what, session.path().string(), "it was altered or damaged: use an unaltered copy");
}

Expected<void> check_names(const SessionReader& session) {
  const auto& other = session.info().other;
  if (const auto row = other.find("vehicle_models"); row != other.end()) {
    const auto json = shallow_json(row->second);
    bool are_models = json && json->is_array();
    for (std::size_t i = 0; are_models && i < json->size(); ++i) are_models = (*json)[i].is_object();
    if (!are_models) return damaged(session, "the meta row vehicle_models is not what Septet writes");
  }
  if (const auto names = participant_names(session); !names) return tl::unexpected(names.error());
  return {};
}

/// First tick of the drive: 0 or, if it began at a state kept by an earlier drive, that state's tick.
Expected<Tick> first_tick(const SessionReader& session) {
  const auto row = session.info().other.find(begun_at_row);
  if (row == session.info().other.end()) return Tick{0};
  Tick tick = 0;
  const char* const end = row->second.data() + row->second.size();
  const auto [read, error] = std::from_chars(row->second.data(), end, tick);
  const auto states = session.saved_state_ticks();
  if (!states) return tl::unexpected(states.error());
  if (error != std::errc() || read != end || states->empty() || states->front() != tick)
    return damaged(session, "it does not hold the state that its drive began at");
  return tick;
}

/// Snapshots follow each other from the first tick, each with the input that it was computed with.
Expected<std::uint64_t> check_ticks(const SessionReader& session, SessionDigest& digest,
                                    const std::function<void(double)>& on_progress) {
  const auto first = first_tick(session);
  if (!first) return tl::unexpected(first.error());
  const auto inputs = session.inputs();
  if (!inputs) return tl::unexpected(inputs.error());
  StateHash inputs_hash;
  for (const InputRecord& input : *inputs) add_to_hash(input, inputs_hash);
  if (const auto row = session.info().other.find("outcome"); row != session.info().other.end()) {
    const auto outcome = read_outcome(row->second, session.path().string());
    if (!outcome) return tl::unexpected(outcome.error());
    if (outcome->inputs_hash != inputs_hash.value())
      return damaged(session, "the driver inputs are not those that were driven with");
  }
  auto cursor = session.snapshots();
  if (!cursor) return tl::unexpected(cursor.error());
  std::uint64_t count = 0;
  auto input = inputs->begin();
  for (;; ++count) {
    const auto snapshot = cursor->next();
    if (!snapshot) return tl::unexpected(snapshot.error());
    if (!*snapshot) break;
    const Tick tick = (*snapshot)->tick;
    if (tick != *first + count)
      return damaged(session, fmt::format("the snapshot of tick {} is missing", *first + count));
    if (input != inputs->end() && input->tick < tick)
      return damaged(session, fmt::format("the driver inputs are out of order at tick {}", input->tick));
    if (input != inputs->end() && input->tick == tick)
      ++input;
    else if (tick > *first && (session.ended_cleanly() || input != inputs->end()))
      return damaged(session, fmt::format("the driver input of tick {} is missing", tick));
    else if (tick > *first)
      break;  // A drive that goes on has recorded more since its inputs were read.
    digest.add_tick(tick, (*snapshot)->simulated_time_s, (*snapshot)->state_hash);
    if (on_progress && count % 256 == 255 && !inputs->empty())
      on_progress(static_cast<double>(tick) / static_cast<double>(std::max<Tick>(inputs->back().tick, 1)));
  }
  if (count > 0 && inputs->end() - input > 1)
    return damaged(session, fmt::format("the snapshot of tick {} is missing", input->tick));
  return count;
}

}  // namespace

Expected<WholeSession> read_whole(const SessionReader& session, const std::function<void(double share)>& on_progress) {
  if (auto checked = session.check_integrity(); !checked) return tl::unexpected(checked.error());
  if (auto checked = session.check_values(); !checked) return tl::unexpected(checked.error());
  if (auto checked = check_names(session); !checked) return tl::unexpected(checked.error());
  SessionDigest digest;
  digest.add(session.info());
  const auto snapshots = check_ticks(session, digest, on_progress);
  if (!snapshots) return tl::unexpected(snapshots.error());
  const auto edits = session.scene_edits();
  if (!edits) return tl::unexpected(edits.error());
  for (const SceneEdit& edit : *edits) digest.add(edit);
  scene::Store store;
  if (auto restored = restore_scene(session, store); !restored) return tl::unexpected(restored.error());
  const auto samples = session.samples();
  if (!samples) return tl::unexpected(samples.error());
  for (const Sample& sample : *samples) digest.add(sample);
  const auto events = session.events();
  if (!events) return tl::unexpected(events.error());
  for (const Event& event : *events) digest.add(event);
  if (auto answers = session.questionnaire(); !answers) return tl::unexpected(answers.error());
  if (auto actuators = session.actuators(); !actuators) return tl::unexpected(actuators.error());
  const auto states = session.saved_state_ticks();
  if (!states) return tl::unexpected(states.error());
  for (const Tick tick : *states) {  // One at a time: each is large.
    const auto state = session.saved_state(tick);
    if (!state) return tl::unexpected(state.error());
    if (*state) digest.add(**state);
  }
  const auto row = session.info().other.find(digest_row);
  const bool has_digest = row != session.info().other.end();
  if (has_digest) {
    const auto altered = altered_part(digest, row->second, session.path().string());
    if (!altered) return tl::unexpected(altered.error());
    if (*altered) return damaged(session, fmt::format("{} altered or damaged since the drive", **altered));
  }
  return WholeSession{has_digest, *snapshots};
}

}  // namespace septet::logging
