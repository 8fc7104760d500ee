#pragma once
/// The operator's page at a drive: what is wished there is done between two ticks and logged, and the page is told how the drive stands.

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "logging/session/drive_end.hpp"
#include "sim-server/drive/drive_loader.hpp"
#include "sim-server/drive/driver_rating.hpp"
#include "sim-server/drive/lesson_watch.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/server_options.hpp"
#include "sim-server/drive/session_log.hpp"
#include "sim-server/drive/speaker.hpp"
#include "sim-server/drive/way_back.hpp"
#include "sim-server/host/screen_host.hpp"
#include "sim-server/page/operator_page.hpp"

namespace septet::server {

class OperatorDesk {
 public:
  /// Opens the page. `loaded` and `drive` outlive the desk. Error: the port cannot be had.
  static Expected<std::unique_ptr<OperatorDesk>> open(const ServerOptions& options, const LoadedDrive& loaded,
                                                      LiveDrive& drive);

  const std::string& url() const { return page_->url(); }
  /// `log` outlives the desk, which tells the page what is logged.
  void log_to(SessionLog& log);
  /// Does what was wished since the last call, and ten times a second shows how things stand. `screens` may be empty.
  void attend(const std::shared_ptr<const TakenSnapshot>& newest, const std::string& what,
              const std::vector<HostedScreen>& screens, double now_s);

  /// At which screens somebody on the page looks closely.
  std::set<std::string> watched() const { return page_->watched(); }
  /// What the student is to read now; empty: nothing.
  std::string word() const { return now_s_ < word_until_s_ ? word_ : std::string(); }
  /// Whether a word to the student can be heard.
  bool speaks() const { return speaker_.is_there(); }
  bool is_paused() const { return is_paused_; }
  /// Whether to drive without the screens that are missing.
  bool told_to_go() const { return told_to_go_; }
  std::optional<logging::DriveEnd> end_requested() const;
  /// The drive is to begin again at the newest state kept until this simulated time; 0: at its start. Empty: no such wish.
  const std::optional<double>& restart_at_s() const { return restart_at_s_; }
  /// How the drive ended, as the last thing that is shown.
  void show_end(const std::string& text, const std::vector<HostedScreen>& screens, double now_s);

 private:
  OperatorDesk(std::unique_ptr<page::OperatorPage> page, std::optional<DriverRating> rating,
               std::unique_ptr<LessonWatch> lesson, Speaker speaker, const LoadedDrive& loaded, LiveDrive& drive)
      : page_(std::move(page)),
        rating_(std::move(rating)),
        speaker_(std::move(speaker)),
        lesson_(std::move(lesson)),
        loaded_(loaded),
        drive_(drive),
        begun_s_(drive.state().time_s()) {}
  std::optional<std::string> fulfil(const page::OperatorWish& wish);
  std::optional<std::string> change(const page::OperatorWish& wish, const std::string& command);
  void note(const page::OperatorWish& wish, const std::string& kind, const std::string& what);
  void show(const std::string& what, const std::vector<HostedScreen>& screens, double now_s);

  std::optional<std::string> hold_brake(const page::OperatorWish& wish, bool held);
  std::optional<std::string> put_back(const page::OperatorWish& wish, double seconds);
  std::optional<std::string> restart(const page::OperatorWish& wish, double at_s);
  std::optional<std::string> say(const page::OperatorWish& wish, const page::Say& word);
  void keep_still(const std::vector<HostedScreen>& screens);
  std::optional<std::string> rate(const page::OperatorWish& wish, int value);

  std::unique_ptr<page::OperatorPage> page_;
  std::optional<DriverRating> rating_;  ///< None where its scale is not installed.
  Speaker speaker_;
  WayBack way_back_;
  std::optional<double> brake_until_s_;  ///< By the clock of `attend`; nothing: the instructor does not brake.
  std::string word_;                     ///< To the student, until then.
  double word_until_s_ = -1e9;           ///< By the clock of `attend`.
  double now_s_ = 0.0;                   ///< Of its newest call.
  std::unique_ptr<LessonWatch> lesson_;  ///< Null where the drive is none.
  std::shared_ptr<const std::string> seen_ahead_;  ///< The newest picture of the screen ahead that the lesson has.
  const LoadedDrive& loaded_;
  LiveDrive& drive_;
  double begun_s_;                         ///< Simulated; not 0 where the drive began at a kept state.
  std::optional<std::string> no_restart_;  ///< Why not (why_no_restart).
  std::optional<double> restart_at_s_;
  SessionLog* log_ = nullptr;
  std::shared_ptr<const TakenSnapshot> newest_;
  bool is_paused_ = false, told_to_go_ = false, is_ended_ = false;
  std::optional<double> shown_s_;
  double since_s_ = 0.0, since_time_s_ = 0.0,
         real_time_factor_ = 0.0;  ///< Of the second that is going on, and of the last one.
};

}  // namespace septet::server
