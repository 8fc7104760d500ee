#pragma once
/// The driver's car as the simulation sees it: one input per tick, in any state of the cable.
///
/// `poll` drains the device to its newest report and decodes it. A missing or lost device is opened again every
/// `retry_s`; refused reports are counted and change nothing; a sequence that does not advance for `stale_after_s`
/// releases accelerator and horn (REPORTS.md). The clock is the caller's. Threads: one at a time. Opening enumerates
/// devices, which takes a millisecond or so, and only happens while no device is there.

#include <cstdint>
#include <memory>
#include <optional>

#include "car-io/car_layout.hpp"
#include "car-io/hid_device.hpp"

namespace septet::car_io {

struct CarConnectionOptions {
  const CarLayout* layout = &car_layouts().front();
  rig::CarCalibration calibration = {};
  double stale_after_s = 0.1;
  /// Reports are repeated, so that silence means stale also without a sequence: a car behind a network.
  bool repeats = false;
  double retry_s = 0.5;
};

struct CarReading {
  DriverInput input;            ///< Input for the simulation.
  CarSwitches switches;         ///< For a stale car the last state of the emergency stop, and no re-arming.
  std::optional<Bytes> report;  ///< Newest report since the last poll, as read.
  bool is_connected = false;
  bool is_stale = false;  ///< True also while not connected.
};

/// Input of a silent seat: accelerator and horn are released; the rest is held.
inline DriverInput released(DriverInput input) {
  input.accelerator = 0.0;
  input.horn = false;
  return input;
}

class CarConnection {
 public:
  CarConnection(OpenHidDevice open, const CarConnectionOptions& options);

  CarReading poll(double now_s);
  /// Reason of a missing device or a refused report, once per change.
  std::optional<Error> take_error();
  std::uint64_t refused_reports() const { return refused_reports_; }

 private:
  void read(double now_s, CarReading& reading);
  void report_error(Error error);

  OpenHidDevice open_;
  CarConnectionOptions options_;
  std::unique_ptr<HidDevice> device_;
  std::optional<double> next_try_s_;
  DriverInput input_;  ///< As last decoded; likewise:
  CarSwitches switches_;
  std::optional<double> fresh_at_s_;  ///< Time of the sequence's last advance, or of the last report without one.
  std::uint64_t refused_reports_ = 0;
  std::optional<Error> error_;
  std::string last_reason_;
};

}  // namespace septet::car_io
