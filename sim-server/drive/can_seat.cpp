#include "sim-server/drive/can_seat.hpp"

#include <memory>
#include <utility>

#include "car-io/can/can_bus.hpp"
#include "car-io/can/can_controls.hpp"
#include "car-io/can/instrument_sender.hpp"
#include "car-io/can/rig_can.hpp"

namespace septet::server {

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
  if (plan.sent.empty()) return seat;
  const auto sender = std::make_shared<car_io::InstrumentThread>(car_io::InstrumentSender(open, plan));
  seat.show = [sender](const car_io::Instruments& instruments) {
    sender->set(instruments);
    return sender->take_error();
  };
  seat.is_lost = [sender] { return sender->is_lost(); };
  return seat;
}

}  // namespace septet::server
