#pragma once
/// The log of a drive, from its first record to summary and report.

#include <optional>

#include "program/console.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/server_options.hpp"
#include "sim-server/drive/session_log.hpp"
#include "sim-server/host/attendant.hpp"
#include "sim-server/host/screen_host.hpp"

namespace septet::server {

class DriveLog final : public Attendant {
 public:
  /// All arguments outlive the log. `host`: null without screens.
  DriveLog(const ServerOptions& options, const LoadedDrive& loaded, const scene::Store& store, LiveDrive& live,
           ScreenHost* host, program::ProgressLine& line)
      : options_(options), loaded_(loaded), store_(store), live_(live), host_(host), line_(line) {}

  /// Creates the session file, which must not exist yet. From here on `session` may be called.
  Expected<void> begin() override;
  void hear(const Message& message) override;
  /// Closes the file and writes summary and report. A log that cannot be closed becomes the drive's end, unless the
  /// drive has failed already.
  void close(ServeResult& result) override;

  SessionLog& session() { return *session_; }

 private:
  const ServerOptions& options_;
  const LoadedDrive& loaded_;
  const scene::Store& store_;
  LiveDrive& live_;
  ScreenHost* host_;
  program::ProgressLine& line_;
  std::optional<SessionLog> session_;
};

}  // namespace septet::server
