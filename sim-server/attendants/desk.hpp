#pragma once
/// The operator's desk (drive/operator_desk.hpp) as an attendant of the loop: passes on the page's requests, and shows
/// the state of the drive.

#include <memory>
#include <utility>

#include "sim-server/attendants/drive_log.hpp"
#include "sim-server/drive/operator_desk.hpp"
#include "sim-server/host/attendant.hpp"
#include "sim-server/host/screen_host.hpp"

namespace septet::server {

class Desk final : public Attendant {
 public:
  /// `log` and `host` outlive the desk. `host`: null without screens.
  Desk(std::unique_ptr<OperatorDesk> desk, DriveLog& log, ScreenHost* host)
      : desk_(std::move(desk)), log_(log), host_(host) {}

  Expected<void> begin() override;
  void before_tick(const Moment& moment) override;
  Wishes wishes() override;
  void close(ServeResult& result) override;

 private:
  std::unique_ptr<OperatorDesk> desk_;
  DriveLog& log_;
  ScreenHost* host_;
};

}  // namespace septet::server
