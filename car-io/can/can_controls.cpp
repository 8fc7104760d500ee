#include "car-io/can/can_controls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "car-io/can/signal_codec.hpp"
#include "car-io/car_report.hpp"

namespace septet::car_io {
namespace {

bool is_on(double value) { return value >= 0.5; }

class CanControlsDevice final : public HidDevice {
 public:
  CanControlsDevice(std::unique_ptr<CanBus> bus, CanPlan plan, double steering_lock_rad)
      : bus_(std::move(bus)),
        plan_(std::move(plan)),
        steering_lock_rad_(steering_lock_rad),
        has_come_(plan_.heard.size()) {}

  Expected<std::optional<Bytes>> read_newest() override {
    bool came = false;
    for (int i = 0; i < most_at_once; ++i) {
      const auto frame = bus_->receive();
      if (!frame) return tl::unexpected(frame.error());
      if (!*frame) break;
      came |= take(**frame);
    }
    // A controller off the bus hears nothing; its silence makes the car stale.
    if (!came) return std::nullopt;
    input_ = driver_input_of(controls_, input_);
    if (all_have_come()) {
      ++input_.sequence;
      has_come_.assign(has_come_.size(), false);
    }
    const auto report = encode_controls(input_, steering_lock_rad_,
                                        {is_on(controls_.emergency_stop_switch), is_on(controls_.rearm_switch)});
    return Bytes(report.begin(), report.end());
  }
  Expected<void> write(std::span<const std::byte>) override { return takes_none(); }
  Expected<Bytes> get_feature(std::uint8_t, std::size_t) override { return takes_none(); }
  Expected<void> send_feature(std::span<const std::byte>) override { return takes_none(); }

 private:
  static constexpr int most_at_once = 1000;

  static tl::unexpected<Error> takes_none() {
    return failure("controls on a CAN bus take no reports", "CAN bus", "name a HID device for fan and shaker");
  }

  bool take(const CanFrame& frame) {
    bool of_ours = false;
    for (std::size_t i = 0; i < plan_.heard.size(); ++i) {
      const HeardMessage& heard = plan_.heard[i];
      if (heard.message.id != frame.id || heard.message.is_extended != frame.is_extended) continue;
      bool any = false;
      for (const HeardSignal& signal : heard.signals)
        if (const auto value = dbc::decode(heard.message, signal.signal, frame.payload());
            value && std::isfinite(*value)) {
          controls_.*signal.control = *value;
          any = true;
        }
      has_come_[i] = has_come_[i] || any;
      of_ours |= any;
    }
    return of_ours;
  }
  bool all_have_come() const {
    for (std::size_t i = 0; i < plan_.heard.size(); ++i)
      if (plan_.heard[i].must_beat && !has_come_[i]) return false;
    return true;
  }

  std::unique_ptr<CanBus> bus_;
  CanPlan plan_;
  double steering_lock_rad_;
  CanControls controls_;
  DriverInput input_;
  std::vector<bool> has_come_;  ///< Heard messages that have come since the sequence advanced.
};

double share(double percent) { return std::clamp(percent / 100.0, 0.0, 1.0); }

}  // namespace

DriverInput driver_input_of(const CanControls& controls, const DriverInput& before) {
  DriverInput input = before;
  input.steering_wheel_rad = std::clamp(controls.steering_wheel_deg, -10000.0, 10000.0) * std::numbers::pi / 180.0;
  input.accelerator = share(controls.accelerator_percent);
  input.brake = share(controls.brake_percent);
  input.clutch = share(controls.clutch_percent);
  const bool left = is_on(controls.indicator_left_switch), right = is_on(controls.indicator_right_switch);
  input.indicator = left == right ? IndicatorStalk::off : left ? IndicatorStalk::left : IndicatorStalk::right;
  input.hazard_lights = is_on(controls.hazard_switch) || (left && right);
  input.horn = is_on(controls.horn_switch);
  input.low_beam = is_on(controls.low_beam_switch);
  input.high_beam = is_on(controls.high_beam_switch);
  input.parking_brake = is_on(controls.parking_brake_switch);
  if (controls.selector_position >= 0.0 && controls.selector_position < 4.5)
    input.selector = static_cast<GearSelector>(static_cast<int>(std::lround(controls.selector_position)));
  if (controls.gear_position > -1.5 && controls.gear_position < 6.5)
    input.gear = static_cast<std::int8_t>(std::lround(controls.gear_position));
  return input;
}

OpenHidDevice can_controls_opener(OpenCanBus open, CanPlan plan, double steering_lock_rad) {
  return [open = std::move(open), plan = std::move(plan), steering_lock_rad]() -> Expected<std::unique_ptr<HidDevice>> {
    auto bus = open();
    if (!bus) return tl::unexpected(bus.error());
    return std::make_unique<CanControlsDevice>(std::move(*bus), plan, steering_lock_rad);
  };
}

}  // namespace septet::car_io
