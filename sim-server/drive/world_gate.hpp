#pragma once
/// The one gate through which the world of a running drive is changed between two ticks, by editors and scripts, the
/// operator's page and the storyboard: rights, the change, what of it can be met, the log; or a refusal with its reason.
///
/// What each author did last can be undone, by the inverses of its commands, through the same gate.

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/constants_told.hpp"
#include "engine/scene/store.hpp"
#include "engine/simulation/operator_command.hpp"
#include "sim-server/drive/opened_drive.hpp"
#include "sim-server/drive/scene_gate.hpp"
#include "sim-server/drive/session_log.hpp"
#include "sim-server/drive/solid_things.hpp"

namespace septet::server {

/// Of one author: batches that may be undone, and bytes of the commands that would do so. Older ones are forgotten.
inline constexpr std::size_t most_undone_batches = 100, most_undone_bytes = 32u << 20;

/// Vertices, and polygons, of a shape that is edited: to make or remove a larger one holds up the drive for many ticks.
inline constexpr std::uint32_t most_elements_of_shape = 1u << 20;

class WorldGate {
 public:
  /// Told each command that was done, and the first tick that shows it.
  using Done = std::function<void(const scene::Command&, Tick from)>;

  /// `drive` is a live one and outlives the gate.
  explicit WorldGate(OpenedDrive& drive) : drive_(drive) {}

  void tell(Done done) { done_ = std::move(done); }
  /// `log` outlives the gate.
  void log_to(SessionLog& log) { log_ = &log; }
  /// The drive begins: solids of its world stand, and what is hidden of it does not.
  void begin();

  /// Changes the world by a whole batch, or refuses it whole. `from`: the first tick that shows it. `may_be_undone`: undo()
  /// takes it back.
  std::optional<replication::Refusal> make(const Editor& editor, std::vector<scene::Command> batch, Tick from,
                                           bool may_be_undone = true);
  /// The same of one line of text (engine/scene/command_text.hpp).
  Expected<void> make_line(const Editor& editor, std::string_view line, Tick from);
  /// Undoes the author's newest batch that is not undone. Refused where there is none, where somebody else has changed one of
  /// its nodes since, and where the author may no longer do it: the next undo is then of the batch before.
  std::optional<replication::Refusal> undo(const Editor& editor, Tick from);

  /// The first tick that shows what is done now: a world that does not drive shows its tick on, with the changes.
  Tick shown_from(std::string_view doing) const { return drive_.live->state().tick + (doing == "driving" ? 1 : 0); }
  const scene::Store& scene() const { return drive_.store; }
  /// The world before any edit; null where it was not kept.
  const scene::Store* generated() const { return drive_.generated ? &*drive_.generated : nullptr; }
  LiveDrive& drive() { return *drive_.live; }
  /// For the console: what went wrong outside of a request, and once of each author's fragments that are constants here.
  std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

 private:
  struct Batch {
    std::vector<scene::Command> inverse;
    std::map<scene::NodeId, std::string> makers;  ///< Of the nodes that it destroyed; nobody: the world had it.
    std::size_t bytes = 0;
  };

  replication::Refusal with_names(replication::Refusal refusal, std::span<const scene::Command> batch) const;
  void note_gone(std::span<const scene::Command> batch);
  void execute(const std::vector<simulation::OperatorCommand>& commands);
  void tag_pushable(Tick from);
  void remember(const Editor& editor, Batch batch);
  std::optional<replication::Refusal> pass(const Editor& editor, std::span<const scene::Command> batch, Tick from,
                                           const Batch* undone, Batch* done);

  OpenedDrive& drive_;
  SessionLog* log_ = nullptr;
  Done done_ = [](const scene::Command&, Tick) {};
  NodeMakers makers_;
  std::map<scene::NodeId, std::string> changers_;  ///< Who has changed a node last.
  std::map<scene::NodeId, std::string> gone_;      ///< Names of nodes that are gone, so that a refusal can name them.
  std::map<std::string, std::deque<Batch>> undo_;  ///< By author, the newest last.
  SolidThings solids_;
  scene::ConstantsTold constants_;
  std::vector<std::string> messages_;
};

}  // namespace septet::server
