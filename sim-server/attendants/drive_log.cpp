#include "sim-server/attendants/drive_log.hpp"

#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/core.h>

namespace septet::server {

Expected<void> DriveLog::begin() {
  std::error_code error;
  std::filesystem::create_directories(options_.out, error);
  if (error) return failure(error.message(), options_.out.string(), "choose a folder that can be written with --out");
  const std::filesystem::path session = options_.out / "session.sqlite";
  if (std::filesystem::exists(session, error))
    return failure(
        "a drive lies there already, and a log is never overwritten", session.string(),
        fmt::format("give another folder with --out, or move that drive aside first, which `septet drive` does by "
                    "itself: mv '{0}' '{0}.1'",
                    options_.out.string()));
  auto log = SessionLog::create(loaded_, options_, live_.state().tick);
  if (!log) return tl::unexpected(log.error());
  session_.emplace(std::move(*log));
  if (host_)
    session_->tell([host = host_](const logging::Event& event) {
      host->tell_event({0, event.tick, event.simulated_time_s, event.kind, event.participant.has_value(),
                        event.participant.value_or(0), event.detail});
    });
  session_->record_scene(store_);
  live_.log_to(*session_);
  return {};
}

void DriveLog::hear(const Message& message) {
  if (!message.is_logged) session_->record_message("screen", message.text);
}

void DriveLog::close(ServeResult& result) {
  const std::vector<HostedScreen>& screens = screens_of(host_);
  const auto failed = [&](const Error& error) {
    if (result.end == logging::DriveEnd::log_failed) return;  // The loop has reported it.
    line_.message(fmt::format("septet-server: {}", describe(error)));
    if (exit_status(result.end) == logging::failed_status) return;
    result.end = logging::DriveEnd::log_failed;
    result.error = error;
  };
  live_.log_unfinished();
  if (const auto finished = session_->finish(session_->outcome(result, screens)); !finished) failed(finished.error());
  if (const auto remark = session_->remark()) line_.message(*remark);
  if (const auto written = write_results(loaded_, options_, session_->outcome(result, screens)); !written)
    failed(written.error());
  const auto lines = write_standing(loaded_, options_, session_->game());
  if (!lines) return failed(lines.error());
  for (const std::string& line : *lines) line_.message(line);
}

}  // namespace septet::server
