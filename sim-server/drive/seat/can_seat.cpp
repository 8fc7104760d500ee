#include "sim-server/drive/seat/can_seat.hpp"

#include <utility>

#include "car-io/can/can_bus.hpp"
#include "car-io/can/can_controls.hpp"
#include "car-io/can/instrument_sender.hpp"
#include "car-io/can/rig_can.hpp"

namespace septet::server {
namespace {

/// An instrument cluster on the bus; a thread sends to it.
class InstrumentCluster final : public SeatDevice {
 public:
  explicit InstrumentCluster(car_io::InstrumentSender sender) : thread_(std::move(sender)) {}

  bool shows() const override { return true; }
  std::optional<Error> show(const car_io::Instruments& instruments) override {
    thread_.set(instruments);
    return thread_.take_error();
  }
  bool is_lost() const override { return thread_.is_lost(); }

 private:
  car_io::InstrumentThread thread_;
};

}  // namespace

Expected<CanSeat> open_can_seat(const rig::Rig& rig, const std::filesystem::path& rig_file) {
  if (!rig.can) return CanSeat{};
  const auto can = car_io::read_rig_can(rig, rig_file);
  if (!can) return tl::unexpected(can.error());
  const car_io::CanPlan& plan = can->plan;
  const auto open = [interface = rig.can->interface, needs_fd = plan.needs_fd] {
    return car_io::open_socket_can(interface, needs_fd);
  };
  CanSeat seat;
  seat.notice = can->notice;
  if (rig.car.source == rig::CarSource::can)
    seat.controls = car_io::can_controls_opener(open, plan, rig.car.calibration.steering_lock_rad);
  if (!plan.sent.empty()) seat.instruments = std::make_unique<InstrumentCluster>(car_io::InstrumentSender(open, plan));
  return seat;
}

}  // namespace septet::server
