#pragma once
/// The operator's page of a drive: executes requests between two ticks and logs them, and shows the state of the drive.

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
#include "sim-server/drive/placing.hpp"
#include "sim-server/drive/server_options.hpp"
#include "sim-server/drive/session_log.hpp"
#include "sim-server/drive/speaker.hpp"
#include "sim-server/drive/way_back.hpp"
#include "sim-server/drive/world_gate.hpp"
#include "sim-server/host/screen_host.hpp"
#include "sim-server/page/operator_page.hpp"

namespace septet::server {

class OperatorDesk {
 public:
  /// Opens the page. `loaded` and `gate` outlive the desk. Error: the port is not available.
  static Expected<std::unique_ptr<OperatorDesk>> open(const ServerOptions& options, const LoadedDrive& loaded,
                                                      WorldGate& gate);

  const std::string& url() const { return page_->url(); }
  /// `log` outlives the desk; its events are shown on the page.
  void log_to(SessionLog& log);
  /// Executes the requests since the last call, and updates the page ten times a second and with each large picture.
  /// `screens` may be empty. `is_being_drawn`: as Moment's; what changes the world waits.
  void attend(const std::shared_ptr<const TakenSnapshot>& newest, const std::string& what,
              const std::vector<HostedScreen>& screens, double now_s, bool is_being_drawn);

  /// Names of the screens whose large picture is watched on the page.
  std::set<std::string> watched() const { return page_->watched(); }
  /// Text for the student to read now; empty: none.
  std::string word() const { return now_s_ < word_until_s_ ? word_ : std::string(); }
  /// True if a word to the student can be spoken aloud.
  bool speaks() const { return speaker_.is_there(); }
  bool is_paused() const { return is_paused_; }
  /// True if the drive should begin without the missing screens.
  bool told_to_go() const { return told_to_go_; }
  std::optional<logging::DriveEnd> end_requested() const;
  /// The drive is to begin again at the newest state kept until this simulated time; 0: at its start. Empty: not
  /// requested.
  const std::optional<double>& restart_at_s() const { return restart_at_s_; }
  /// Shows the end of the drive, as the last state of the page.
  void show_end(const std::string& text, const std::vector<HostedScreen>& screens, double now_s);

 private:
  OperatorDesk(std::unique_ptr<page::OperatorPage> page, std::optional<DriverRating> rating,
               std::unique_ptr<LessonWatch> lesson, Speaker speaker, std::unique_ptr<Placing> placing,
               const LoadedDrive& loaded, WorldGate& gate)
      : page_(std::move(page)),
        rating_(std::move(rating)),
        speaker_(std::move(speaker)),
        lesson_(std::move(lesson)),
        placing_(std::move(placing)),
        loaded_(loaded),
        gate_(gate),
        drive_(gate.drive()),
        begun_s_(gate.drive().state().time_s()) {}
  std::optional<std::string> fulfil(const page::OperatorWish& wish);
  std::optional<std::string> change(const page::OperatorWish& wish, const std::string& command);
  std::optional<std::string> edit(const page::OperatorWish& wish, const std::string& lines);
  void answer(const page::OperatorWish& wish);
  void note(const page::OperatorWish& wish, const std::string& kind, const std::string& what);
  void show(const std::string& what, const std::vector<HostedScreen>& screens, double now_s);

  std::optional<std::string> hold_brake(const page::OperatorWish& wish, bool held);
  std::optional<std::string> put_back(const page::OperatorWish& wish, double seconds);
  std::optional<std::string> restart(const page::OperatorWish& wish, double at_s);
  std::optional<std::string> say(const page::OperatorWish& wish, const page::Say& word);
  bool has_new_large_picture(const std::vector<HostedScreen>& screens);
  void keep_still(const std::vector<HostedScreen>& screens);
  std::optional<std::string> rate(const page::OperatorWish& wish, int value);

  std::unique_ptr<page::OperatorPage> page_;
  std::vector<page::OperatorWish> waiting_;  ///< Wishes kept until the world may be changed.
  std::optional<DriverRating> rating_;       ///< Empty if the scale's file is not installed.
  Speaker speaker_;
  WayBack way_back_;
  std::optional<double> brake_until_s_;  ///< On the clock of `attend`; empty: the instructor does not brake.
  std::string word_;                     ///< To the student, shown until the time below.
  double word_until_s_ = -1e9;           ///< On the clock of `attend`.
  double now_s_ = 0.0;                   ///< Time of the newest `attend`.
  std::unique_ptr<LessonWatch> lesson_;  ///< Null if the drive is not a lesson.
  std::unique_ptr<Placing> placing_;
  std::shared_ptr<const std::string> seen_ahead_;  ///< Newest picture of the screen ahead, handed to the lesson.
  std::vector<std::shared_ptr<const std::string>> large_pictures_;  ///< Newest one of each screen.
  const LoadedDrive& loaded_;
  WorldGate& gate_;
  LiveDrive& drive_;
  Tick from_ = 0;                          ///< First tick that shows what is done now.
  double begun_s_;                         ///< Simulated; not 0 where the drive began at a kept state.
  std::optional<std::string> no_restart_;  ///< Reason for the refusal of a restart (why_no_restart).
  std::optional<double> restart_at_s_;
  SessionLog* log_ = nullptr;
  std::shared_ptr<const TakenSnapshot> newest_;
  bool is_paused_ = false, told_to_go_ = false, is_ended_ = false;
  std::optional<double> shown_s_;
  double since_s_ = 0.0, since_time_s_ = 0.0,
         real_time_factor_ = 0.0;  ///< Beginning of the current second; factor of the last one.
};

}  // namespace septet::server
