#pragma once
/// Changes of the scene that clients with the right to edit, or the storyboard, ask for: passed through the drive's gate
/// (drive/world_gate.hpp) before each tick, in lockstep once the screens have shown the one before, and sent to all
/// screens; or kept until the tick that a client named, or its turn (edit_turns.hpp). A session that is shown again shows
/// its own changes at their ticks, and takes none.

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim-server/attendants/drive_log.hpp"
#include "sim-server/attendants/edit_turns.hpp"
#include "sim-server/drive/opened_drive.hpp"
#include "sim-server/drive/world_gate.hpp"
#include "sim-server/host/attendant.hpp"
#include "sim-server/host/screen_host.hpp"

namespace septet::server {

class SceneEdits final : public Attendant {
 public:
  /// All arguments outlive it. `host`: null without screens. `log` and `gate`: null in a replay. `save`: file for what differs
  /// from the generated world; empty: none.
  SceneEdits(OpenedDrive& drive, ScreenHost* host, DriveLog* log, WorldGate* gate, std::filesystem::path save)
      : drive_(drive), host_(host), log_(log), gate_(gate), save_(std::move(save)) {}

  Expected<void> begin() override;
  void before_tick(const Moment& moment) override;
  void after_tick(const std::shared_ptr<const TakenSnapshot>& tick, double shaking_share) override;
  std::vector<std::string> take_messages() override;
  void close(ServeResult& result) override;

 private:
  void make(const SceneRequest& request, Tick from, double now_s);
  void carry_out_storyboard(Tick from);
  void take_requests(Tick from, const Moment& moment);

  OpenedDrive& drive_;
  ScreenHost* host_;
  DriveLog* log_;
  WorldGate* gate_;
  std::filesystem::path save_;
  EditTurns turns_;
  std::vector<std::string> messages_;
};

}  // namespace septet::server
