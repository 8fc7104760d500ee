#pragma once
/// Lines of clients with the right to operate: a mark, a pause, some ticks, or an operator's command
/// (engine/simulation/operator_command.hpp), done between two ticks, in lockstep once the screens have shown the first, and
/// logged like those of the operator's page.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sim-server/attendants/drive_log.hpp"
#include "sim-server/drive/opened_drive.hpp"
#include "sim-server/drive/world_gate.hpp"
#include "sim-server/host/attendant.hpp"
#include "sim-server/host/screen_host.hpp"

namespace septet::server {

class OperatorLines final : public Attendant {
 public:
  /// All arguments outlive it. `log` and `gate`: null in a replay, which takes no lines.
  OperatorLines(OpenedDrive& drive, ScreenHost& host, DriveLog* log, WorldGate* gate)
      : drive_(drive), host_(host), log_(log), gate_(gate) {}

  void before_tick(const Moment& moment) override;
  Wishes wishes() override { return {.stands_still = pauser_ && ticks_to_go_ == 0}; }
  void after_tick(const std::shared_ptr<const TakenSnapshot>& tick, double shaking_share) override;

 private:
  std::optional<std::string> fulfil(const OperatorRequest& request, Tick from);
  std::optional<std::string> pause(const OperatorRequest& request, std::uint64_t ticks);
  void go_on(const std::string& name);
  void note(const std::string& name, const char* kind, std::string_view what);

  OpenedDrive& drive_;
  ScreenHost& host_;
  DriveLog* log_;
  WorldGate* gate_;
  std::optional<OperatorRequest> pauser_;  ///< Whose line has paused the drive; a drive goes on when that one has gone.
  std::uint64_t ticks_to_go_ = 0;          ///< Before it stands still again.
};

}  // namespace septet::server
