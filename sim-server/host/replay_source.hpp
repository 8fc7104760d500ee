#pragma once
/// A session as a source of ticks: screens receive exactly the ticks of the drive.

#include "logging/session/session_reader.hpp"
#include "sim-server/host/tick_source.hpp"

namespace septet::server {

class ReplaySource final : public TickSource {
 public:
  /// `session` outlives the source. Begins at the tick at or before `from_s`.
  static Expected<std::unique_ptr<ReplaySource>> start(const logging::SessionReader& session, double from_s);

  Expected<std::shared_ptr<const TakenSnapshot>> next(const std::optional<DriverInput>& controls) override;
  logging::DriveEnd end() const override { return logging::DriveEnd::session_end; }
  double tick_rate_hz() const override { return tick_rate_hz_; }

 private:
  ReplaySource(logging::SnapshotCursor cursor, double tick_rate_hz)
      : cursor_(std::move(cursor)), tick_rate_hz_(tick_rate_hz) {}
  logging::SnapshotCursor cursor_;
  double tick_rate_hz_;
};

}  // namespace septet::server
