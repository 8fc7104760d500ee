#include "sim-server/drive/can_seat.hpp"

#include <memory>
#include <utility>

#include "car-io/can/can_bus.hpp"
#include "car-io/can/can_controls.hpp"
#include "car-io/can/dbc.hpp"
#include "car-io/can/instrument_sender.hpp"
#include "engine/core/regular_file.hpp"

namespace septet::server {

Expected<CanSeat> open_can_seat(const rig::Rig& rig, const std::filesystem::path& rig_file) {
  if (!rig.can) return CanSeat{};
  const auto path = rig_file.parent_path() / rig.can->dbc;
  const auto text = read_regular_file(path);
  if (!text) return tl::unexpected(text.error());
  const auto database = car_io::dbc::read_dbc(*text, path.string());
  if (!database) return tl::unexpected(database.error());
  const auto plan = car_io::plan_can(*database, *rig.can);
  if (!plan) return tl::unexpected(plan.error());
  const auto open = [interface = rig.can->interface, needs_fd = plan->needs_fd] {
    return car_io::open_socket_can(interface, needs_fd);
  };
  CanSeat seat;
  seat.notice = car_io::dbc::notice_of(*database);
  if (rig.car.source == rig::CarSource::can) {
    if (plan->heard.empty())
      return failure("none of its signals is a control of the car", path.string(),
                     "name some in the rig's [can.signals], or choose another [car] source");
    seat.controls = car_io::can_controls_opener(open, *plan, rig.car.calibration.steering_lock_rad);
  }
  if (plan->sent.empty()) return seat;
  const auto sender = std::make_shared<car_io::InstrumentThread>(car_io::InstrumentSender(open, *plan));
  seat.show = [sender](const car_io::Instruments& instruments) {
    sender->set(instruments);
    return sender->take_error();
  };
  seat.is_lost = [sender] { return sender->is_lost(); };
  return seat;
}

}  // namespace septet::server
