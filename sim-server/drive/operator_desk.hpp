#pragma once
/// The operator's page at a drive: what is wished there is done between two ticks and logged, and the page is told how the drive stands.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "logging/drive_end.hpp"
#include "sim-server/drive/drive_loader.hpp"
#include "sim-server/drive/driver_rating.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/server_options.hpp"
#include "sim-server/drive/session_log.hpp"
#include "sim-server/host/screen_host.hpp"
#include "sim-server/page/operator_page.hpp"

namespace septet::server {

class OperatorDesk {
 public:
  /// Opens the page. `loaded` and `drive` outlive the desk. Error: the port cannot be had.
  static Expected<std::unique_ptr<OperatorDesk>> open(const ServerOptions& options, const LoadedDrive& loaded,
                                                      LiveDrive& drive);

  const std::string& url() const { return page_->url(); }
  /// `log` outlives the desk.
  void log_to(SessionLog& log) { log_ = &log; }
  /// Does what was wished since the last call, and ten times a second shows how things stand. `screens` may be empty.
  void attend(const std::shared_ptr<const TakenSnapshot>& newest, const std::string& what,
              const std::vector<HostedScreen>& screens, double now_s);
  /// For the list of events on the page.
  void tell(const std::string& text) { page_->tell(drive_.state().time_s(), text); }

  bool is_paused() const { return is_paused_; }
  /// Whether to drive without the screens that are missing.
  bool told_to_go() const { return told_to_go_; }
  std::optional<logging::DriveEnd> end_requested() const;
  /// How the drive ended, as the last thing that is shown.
  void show_end(const std::string& text, const std::vector<HostedScreen>& screens, double now_s);

 private:
  OperatorDesk(std::unique_ptr<page::OperatorPage> page, std::optional<DriverRating> rating, const LoadedDrive& loaded,
               LiveDrive& drive)
      : page_(std::move(page)), rating_(std::move(rating)), loaded_(loaded), drive_(drive) {}
  std::optional<std::string> fulfil(const page::OperatorWish& wish);
  std::optional<std::string> change(const page::OperatorWish& wish, const std::string& command);
  void note(const page::OperatorWish& wish, const std::string& kind, const std::string& what);
  void show(const std::string& what, const std::vector<HostedScreen>& screens, double now_s);

  std::optional<std::string> rate(const page::OperatorWish& wish, int value);

  std::unique_ptr<page::OperatorPage> page_;
  std::optional<DriverRating> rating_;  ///< None where its scale is not installed.
  const LoadedDrive& loaded_;
  LiveDrive& drive_;
  SessionLog* log_ = nullptr;
  std::shared_ptr<const TakenSnapshot> newest_;
  bool is_paused_ = false, told_to_go_ = false, is_ended_ = false;
  std::optional<double> shown_s_;
  double since_s_ = 0.0, since_time_s_ = 0.0,
         real_time_factor_ = 0.0;  ///< Of the second that is going on, and of the last one.
};

}  // namespace septet::server
