#pragma once
/// The screens of a drive: their lanes, and their settings and notices before the first tick.

#include <memory>

#include "sim-server/attendants/lane_endpoint.hpp"
#include "sim-server/drive/opened_drive.hpp"
#include "sim-server/host/attendant.hpp"
#include "sim-server/host/screen_host.hpp"
#include "sim-server/host/serve.hpp"

namespace septet::server {

class Screens final : public Attendant, public ServeClock {
 public:
  /// Opens sockets and keys. `drive` and `line` outlive the screens. Error: as open_lane_endpoint.
  static Expected<std::unique_ptr<Screens>> open(const ServerOptions& options, const ServeOptions& serving,
                                                 const OpenedDrive& drive, program::ProgressLine& line);

  /// Announces that screens may connect; prints the keyboard's keys if a keyboard drives.
  Expected<void> begin() override;

  /// The machine's clock; waiting ends when a screen sends.
  double now_s() const override;
  void wait(double seconds) override;

  ScreenHost& host() { return *host_; }

 private:
  Screens(LaneEndpoint endpoint, bool by_keyboard, program::ProgressLine& line);

  LaneEndpoint endpoint_;
  std::unique_ptr<ScreenHost> host_;
  bool by_keyboard_;
  program::ProgressLine& line_;
};

}  // namespace septet::server
