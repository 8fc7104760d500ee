// A device that sends arbitrary data: HID reports of any bytes for every layout, frames of any kind on a CAN bus, any
// axes and buttons of a joystick. The simulation always gets valid controls.
//
// The first byte chooses the device. Reports and frames are a byte with their length, then that many bytes.
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "car-io/can/can_bus.hpp"
#include "car-io/can/can_controls.hpp"
#include "car-io/can/can_plan.hpp"
#include "car-io/can/dbc.hpp"
#include "car-io/car_connection.hpp"
#include "car-io/car_layout.hpp"
#include "car-io/car_report.hpp"
#include "car-io/joystick/joystick_controls.hpp"
#include "car-io/joystick/joystick_lesson.hpp"

namespace {

using namespace septet;
using namespace septet::car_io;

std::deque<Bytes> pieces_of(std::span<const std::byte> bytes) {
  std::deque<Bytes> pieces;
  while (!bytes.empty()) {
    const auto size = std::min<std::size_t>(std::to_integer<std::size_t>(bytes[0]), bytes.size() - 1);
    pieces.emplace_back(bytes.begin() + 1, bytes.begin() + 1 + static_cast<std::ptrdiff_t>(size));
    bytes = bytes.subspan(1 + size);
  }
  return pieces;
}

void check(const DriverInput& input) {
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0; };
  if (!std::isfinite(input.steering_wheel_rad) || std::abs(input.steering_wheel_rad) > 1e3) std::abort();
  if (!is_share(input.accelerator) || !is_share(input.brake) || !is_share(input.clutch)) std::abort();
  if (static_cast<int>(input.selector) > 4 || input.gear < -1 || input.gear > 6) std::abort();
  if (!std::isfinite(input.gaze_heading_rad)) std::abort();
}

struct Sender final : HidDevice {
  explicit Sender(std::deque<Bytes>& from) : reports(from) {}
  Expected<std::optional<Bytes>> read_newest() override {
    if (reports.empty()) return failure("unplugged", "fuzz", "plug");
    Bytes report = std::move(reports.front());
    reports.pop_front();
    return report;
  }
  Expected<void> write(std::span<const std::byte>) override { return {}; }
  Expected<Bytes> get_feature(std::uint8_t, std::size_t) override { return Bytes{}; }
  Expected<void> send_feature(std::span<const std::byte>) override { return {}; }
  std::deque<Bytes>& reports;
};

void read_reports(const CarLayout& layout, bool is_calibrated, std::deque<Bytes> reports) {
  CarConnectionOptions options{.layout = &layout};
  if (is_calibrated) {
    options.calibration.steering = {.min = -0.8, .centre = 0.1, .max = 0.9, .dead_zone = 0.1, .inverted = true};
    options.calibration.accelerator = {.min = 0.2, .max = 0.3, .dead_zone = 0.5, .inverted = true};
    options.calibration.gear_lever = true;
  }
  for (const Bytes& report : reports) {
    if (const auto axes = read_axes(layout, report); axes && !std::isfinite(axes->steering)) std::abort();
    (void)decode_steering(report);
    (void)decode_device_status(report);
  }
  CarConnection car([&]() -> Expected<std::unique_ptr<HidDevice>> { return std::make_unique<Sender>(reports); },
                    options);
  const std::size_t count = reports.size();
  for (std::size_t i = 0; i <= count; ++i) check(car.poll(static_cast<double>(i) * 0.01).input);
}

/// A bus with a few controls and instruments, multiplexed, floating and of either byte order.
const char* const bus = R"(BS_:
BO_ 1 WHEEL: 8 X
 SG_ steering_wheel_deg : 0|32@1- (1,0) [0|0] "" X
 SG_ accelerator_percent : 39|16@0- (0.5,-10) [0|0] "" X
BO_ 2147483650 STALKS: 8 X
 SG_ m M : 0|2@1+ (1,0) [0|0] "" X
 SG_ selector_position m1 : 8|8@1- (0.1,0) [0|0] "" X
 SG_ gear_position m2 : 8|8@1- (1,0) [0|0] "" X
 SG_ brake_percent : 16|32@1- (1,0) [0|0] "" X
 SG_ clutch_percent : 48|8@1+ (1e300,0) [0|0] "" X
BO_ 3 DASH: 64 X
 SG_ speed_kmh : 0|64@1- (1,0) [0|0] "" X
 SG_ counter : 500|3@1+ (1,0) [0|0] "" X
SIG_VALTYPE_ 1 steering_wheel_deg : 1;
SIG_VALTYPE_ 3 speed_kmh : 2;
)";

void read_frames(const std::deque<Bytes>& frames) {
  static const CanPlan plan = plan_can(dbc::read_dbc(bus, "fuzz.dbc").value(), {}).value();
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends) != 0) std::abort();
  int taken = -1;
  const OpenCanBus open = [&]() -> Expected<std::unique_ptr<CanBus>> {
    if (std::exchange(taken, ends[0]) != -1) return failure("gone", "fuzz", "none");
    return can_bus_of_socket(ends[0], "fuzz0");
  };
  CarConnection car(can_controls_opener(open, plan, 7.85), {.calibration = {.steering_lock_rad = 7.85}});
  double now_s = 0.0;
  for (const Bytes& frame : frames) {
    check(car.poll(now_s += 0.01).input);
    [[maybe_unused]] const auto sent = write(ends[1], frame.data(), frame.size());
  }
  check(car.poll(now_s + 0.01).input);
  close(ends[1]);
  check(car.poll(now_s + 0.02).input);
  if (taken == -1) close(ends[0]);
}

void move_joystick(const std::deque<Bytes>& events) {
  InputState state{.axes = {{0, {0, -100, 100}}, {1, {255, 0, 255}}, {2, {0, 0, 0}}}};
  const std::vector<rig::JoystickControl> controls = {
      {.name = "steering", .is_axis = true, .code = 0, .at_zero = -3.0, .at_one = 2147483647.0, .dead_zone = 0.5},
      {.name = "accelerator", .is_axis = true, .code = 1, .at_zero = 255.0, .at_one = 0.0},
      {.name = "brake", .is_axis = true, .code = 9, .at_zero = 0.0, .at_one = 1e-300},
      {.name = "reverse", .code = 300},
      {.name = "gear_3", .code = 301}};
  JoystickDriver driver;
  JoystickLesson lesson;
  lesson.show_rest(state);
  for (const Bytes& event : events) {
    std::uint16_t code = 0;
    std::int32_t value = 0;
    if (event.size() < sizeof code + sizeof value) continue;
    std::memcpy(&code, event.data(), sizeof code);
    std::memcpy(&value, event.data() + sizeof code, sizeof value);
    if (code < 64)
      state.axes[code].value = value;
    else if (value != 0)
      state.down.insert(code);
    else
      state.down.erase(code);
    check(advance(driver, controls, state, 7.85));
    lesson.show(state);
  }
  if (const auto learnt = lesson.learnt("steering")) (void)joystick_toml({*learnt});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  if (bytes.empty()) return 0;
  const auto pieces = pieces_of(bytes.subspan(1));
  const unsigned choice = std::to_integer<unsigned>(bytes[0]);
  const auto layouts = car_layouts();
  if (choice % 4 == 0)
    read_frames(pieces);
  else if (choice % 4 == 1)
    move_joystick(pieces);
  else
    read_reports(layouts[choice / 8 % layouts.size()], choice % 8 < 4, pieces);
  return 0;
}
