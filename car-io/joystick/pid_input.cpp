#include "car-io/joystick/pid_input.hpp"

#include <utility>

#include "car-io/pid/pid_wheel.hpp"

namespace septet::car_io {
namespace {

class PidInput final : public InputDevice {
 public:
  PidInput(std::unique_ptr<InputDevice> input, std::unique_ptr<HidDevice> motor, const PidReports& reports)
      : input_(std::move(input)), wheel_(std::move(motor), reports) {}

  Expected<const InputState*> read() override { return input_->read(); }
  Expected<bool> set_force(double force) override { return wheel_.set_force(force); }
  Expected<bool> set_feel(const WheelFeel& feel) override {
    bool any = false;
    for (const auto& [kind, share] : {std::pair{PidCondition::spring, feel.spring},
                                      {PidCondition::damper, feel.damper},
                                      {PidCondition::friction, feel.friction}}) {
      const auto set = wheel_.set_condition(kind, share);
      if (!set) return tl::unexpected(set.error());
      any |= *set;
    }
    return any;
  }

 private:
  std::unique_ptr<InputDevice> input_;
  PidWheel wheel_;
};

}  // namespace

std::unique_ptr<InputDevice> with_pid_force(std::unique_ptr<InputDevice> input, std::unique_ptr<HidDevice> motor,
                                            const PidReports& reports) {
  return std::make_unique<PidInput>(std::move(input), std::move(motor), reports);
}

}  // namespace septet::car_io
