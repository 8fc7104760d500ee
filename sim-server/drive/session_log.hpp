#pragma once
/// The session file of a drive, written tick by tick, and the results at the end.

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.hpp"
#include "engine/road/road_network.hpp"
#include "engine/scene/store.hpp"
#include "engine/simulation/operator_command.hpp"
#include "engine/simulation/state.hpp"
#include "logging/session/outcome.hpp"
#include "logging/session/session_digest.hpp"
#include "logging/session/session_writer.hpp"
#include "logging/study/drive_observer.hpp"
#include "sim-server/drive/drive_loader.hpp"
#include "sim-server/drive/server_options.hpp"
#include "sim-server/host/serve.hpp"

namespace septet::server {

/// Kind of events that are operator's commands. They are input like the driver's; their tick is the first one that they
/// affect.
inline constexpr std::string_view operator_command_event = logging::operator_command_kind;

/// The session file of a drive.
struct SessionFile {
  std::string name = "session.sqlite";
  std::map<std::string, std::string> meta{};  ///< Further meta rows; they replace the drive's own of that name.
};

class SessionLog {
 public:
  /// Creates the session file in the drive's folder. `first`: the drive's first tick, not 0 if it begins at a kept state.
  static Expected<SessionLog> create(const LoadedDrive& drive, const ServerOptions& options, Tick first = 0,
                                     const SessionFile& file = {});

  /// Sets listeners for samples and events, called in the order of the file. They must be fast.
  void watch(std::function<void(const logging::Sample&)> sampled, std::function<void(const logging::Event&)> happened) {
    sampled_ = std::move(sampled);
    happened_ = std::move(happened);
  }
  /// Sets another listener for events.
  void tell(std::function<void(const logging::Event&)> heard) { heard_ = std::move(heard); }
  void record_scene(const scene::Store& store);
  /// Records changes of the scene that hold from this tick on.
  void record_edits(Tick from, std::span<const scene::Command> changes);
  void record_input(logging::InputRecord input);
  /// Records the tick's snapshot and events, and at 10 Hz a sample with the events that it completes (lane changes,
  /// glances).
  void record_tick(std::shared_ptr<const TakenSnapshot> taken, const std::vector<simulation::Event>& events);
  /// Records events as of the newest tick; record_tick has recorded its own.
  void record_events(const std::vector<simulation::Event>& events);
  /// Records an operator's command, applied before this tick.
  void record_command(Tick before, const simulation::OperatorCommand& command);
  void record_state(logging::StateRecord state) {
    if (samples_only_) return;
    digest_.add(state);
    writer_.record(std::move(state));
  }
  void record_actuators(logging::ActuatorRecord actuators) { writer_.record(actuators); }
  void record_message(const std::string& kind, const std::string& text);
  void record_answer(logging::QuestionnaireRecord answer) { writer_.record(std::move(answer)); }
  std::optional<Error> take_error() { return writer_.take_error(); }
  /// In real time: the disk has delayed the drive, with the total delay so far; again after each further tenth of a
  /// second.
  std::optional<std::string> take_warning();
  /// State of the game, if the scenario is one.
  const std::optional<GameStanding>& game() const { return game_; }
  double waited_s() const { return writer_.waited_s(); }

  /// Outcome of the drive, after its end.
  logging::DriveOutcome outcome(const ServeResult& result, const std::vector<HostedScreen>& screens) const;
  /// Closes the file, which contains the outcome.
  Expected<void> finish(const logging::DriveOutcome& outcome);
  /// Advice for copying the closed file; empty if it is a single file.
  std::optional<std::string> remark() const;
  /// The end in one line: reason, time, and problems of the log.
  std::string ending(const ServeResult& result) const;

 private:
  SessionLog(logging::SessionWriter writer, std::shared_ptr<const simulation::Model> model, bool real_time,
             bool samples_only)
      : writer_(std::move(writer)), model_(std::move(model)), real_time_(real_time), samples_only_(samples_only) {}

  void record(logging::Event event);
  void name_solid(logging::Event& event) const;

  logging::SessionWriter writer_;
  std::function<void(const logging::Sample&)> sampled_;
  std::function<void(const logging::Event&)> happened_, heard_;
  std::shared_ptr<const simulation::Model> model_;
  bool real_time_;
  bool samples_only_;  ///< True: no snapshots, states or scene.
  double told_waited_s_ = 0.0;
  logging::DriveObserver observer_;
  std::map<ParticipantId, std::string> solids_;  ///< Names of those that stand or stood, by the newest command.
  StateHash inputs_hash_;
  logging::SessionDigest digest_;
  std::uint32_t bad_numbers_ = 0;  ///< From the last tick's diagnostics.
  std::optional<GameStanding> game_;
  Tick tick_ = 0;
  double simulated_time_s_ = 0.0;
};

/// The nearest participant ahead in the driver's lane, within 250 m.
std::optional<logging::Leader> find_leader(const Snapshot& snapshot, const road::RoadNetwork& roads);

/// Lines for the driver at the end of a game or a lesson; writes debrief.html into the drive's folder, and enters the
/// game into best-list.json in the parent folder.
Expected<std::vector<std::string>> write_standing(const LoadedDrive& drive, const ServerOptions& options,
                                                  const std::optional<GameStanding>& game);

/// Writes summary.json and report.html beside the session file. The summary is written even if the session cannot be
/// read.
Expected<void> write_results(const LoadedDrive& drive, const ServerOptions& options,
                             const logging::DriveOutcome& outcome);

}  // namespace septet::server
