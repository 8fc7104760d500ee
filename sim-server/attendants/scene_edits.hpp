#pragma once
/// Changes of the scene that clients with the right to edit ask for: passed through the gate before each tick, sent to all
/// screens and logged. A session that is shown again shows its own changes at their ticks, and takes none.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim-server/attendants/drive_log.hpp"
#include "sim-server/drive/opened_drive.hpp"
#include "sim-server/host/attendant.hpp"
#include "sim-server/host/screen_host.hpp"

namespace septet::server {

class SceneEdits final : public Attendant {
 public:
  /// All arguments outlive it. `log`: null in a replay.
  SceneEdits(OpenedDrive& drive, ScreenHost& host, DriveLog* log) : drive_(drive), host_(host), log_(log) {}

  void before_tick(const Moment& moment) override;
  void after_tick(const std::shared_ptr<const TakenSnapshot>& tick, double shaking_share) override;
  std::vector<std::string> take_messages() override { return std::exchange(messages_, {}); }

 private:
  OpenedDrive& drive_;
  ScreenHost& host_;
  DriveLog* log_;
  std::vector<std::string> messages_;
};

}  // namespace septet::server
