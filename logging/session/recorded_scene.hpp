#pragma once
/// The scene of a session, from its scene edits.

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/store.hpp"
#include "logging/session/session_reader.hpp"

namespace septet::logging {

/// Applies every edit to an empty store. Error: the file is damaged, or an edit is invalid.
Expected<void> restore_scene(const SessionReader& session, scene::Store& store);

/// The scene as it changes during the session.
class RecordedScene {
 public:
  /// Error: the file is damaged.
  static Expected<RecordedScene> open(const SessionReader& session);

  /// Applies the edits that hold at this tick and are not applied yet; `applied` is called for each. Error: an edit is
  /// invalid.
  Expected<void> advance(Tick tick, scene::Store& store,
                         const std::function<void(const scene::Command&)>& applied = nullptr);
  /// True if an edit later than `tick` is applied: the scene has to begin anew, with an empty store.
  bool is_past(Tick tick) const { return next_ > 0 && edits_[next_ - 1].tick > tick; }
  void begin_anew() { next_ = 0; }

 private:
  RecordedScene(std::vector<SceneEdit> edits, std::string where) : edits_(std::move(edits)), where_(std::move(where)) {}

  std::vector<SceneEdit> edits_;
  std::string where_;
  std::size_t next_ = 0;
};

}  // namespace septet::logging
