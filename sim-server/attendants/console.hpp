#pragma once
/// The console of a drive: messages and progress on standard error, signals, and the words "go" and "rearm" on standard
/// input.

#include "program/console.hpp"
#include "program/go_word.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/host/attendant.hpp"

namespace septet::server {

class Console final : public Attendant {
 public:
  /// `line` and `live` outlive the console. `live`: null for a replay. `reads_go`: the drive has screens and may begin
  /// without the missing ones; without screens, standard input is read for "rearm" alone.
  Console(program::ProgressLine& line, LiveDrive* live, bool reads_go)
      : line_(line), live_(live), reads_go_(reads_go) {}

  void before_tick(const Moment& moment) override;
  Wishes wishes() override;
  void hear(const Message& message) override { line_.message(message.text); }
  void show(const Progress& progress) override;
  void close(ServeResult& result) override;

 private:
  program::ProgressLine& line_;
  LiveDrive* live_;
  bool reads_go_;
  bool has_begun_ = false;
  program::GoWord input_;
};

}  // namespace septet::server
