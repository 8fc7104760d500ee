#pragma once
/// The driver's car as the simulation sees it: one input per tick, whatever happens to the cable.
///
/// `poll` drains the device to its newest report and decodes it. A device that is missing or lost
/// is opened again every `retry_s`; refused reports are counted and change nothing; a sequence that
/// stands still for `stale_after_s` releases accelerator and horn (REPORTS.md). The clock is the
/// caller's. Threads: one at a time. Opening enumerates devices, which takes a millisecond or so,
/// and only happens while none is there.

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
  bool repeats = false;  ///< Reports come again and again, so that silence is stale also without a
                         ///< sequence: a car behind a network.
  double retry_s = 0.5;
};

struct CarReading {
  DriverInput input;            ///< What the simulation shall use.
  CarSwitches switches;         ///< Of a stale car the emergency stop as it last was, and nobody who re-arms.
  std::optional<Bytes> report;  ///< The newest report that came since the last poll, as it was read.
  bool is_connected = false;
  bool is_stale = false;  ///< Also while not connected.
};

/// What a seat that has fallen silent stands for: nobody's foot is on the pedal and nobody's hand on the horn; the rest is held.
inline DriverInput released(DriverInput input) {
  input.accelerator = 0.0;
  input.horn = false;
  return input;
}

class CarConnection {
 public:
  CarConnection(OpenHidDevice open, const CarConnectionOptions& options);

  CarReading poll(double now_s);
  /// Why the device is away or a report was refused, once per change of the reason.
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
  std::optional<double> fresh_at_s_;  ///< When the sequence last moved, or the last report came where there is none.
  std::uint64_t refused_reports_ = 0;
  std::optional<Error> error_;
  std::string last_reason_;
};

}  // namespace septet::car_io
