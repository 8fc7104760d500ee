#pragma once
/// The driver's head position, from a tracker's datagrams.

#include <utility>

#include "car-io/head/head_tracker.hpp"
#include "sim-server/drive/seat/seat_device.hpp"

namespace septet::server {

class TrackedHead final : public SeatDevice {
 public:
  explicit TrackedHead(car_io::HeadTracker tracker) : tracker_(std::move(tracker)) {}

  void add_to(DriverInput& input) override;
  std::optional<std::string> take_message() override { return tracker_.take_message(); }

 private:
  car_io::HeadTracker tracker_;
};

}  // namespace septet::server
