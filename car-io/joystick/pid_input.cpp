#include "car-io/joystick/pid_input.hpp"

#include <cstddef>
#include <fstream>
#include <span>
#include <system_error>
#include <utility>

#include "car-io/pid/hid_fields.hpp"
#include "car-io/pid/pid_wheel.hpp"
#include "engine/core/bytes.hpp"

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

std::optional<PidNode> find_pid_node(const std::string& event, const std::filesystem::path& sys,
                                     const std::filesystem::path& dev) {
  const auto hid = sys / "class/input" / event / "device/device";
  std::error_code none;
  const std::filesystem::directory_iterator nodes(hid / "hidraw", none);
  if (none || nodes == std::filesystem::directory_iterator()) return std::nullopt;
  std::ifstream file(hid / "report_descriptor", std::ios::binary);
  Bytes descriptor(most_descriptor_bytes + 1);
  file.read(reinterpret_cast<char*>(descriptor.data()), static_cast<std::streamsize>(descriptor.size()));
  const auto fields = read_hid_fields(std::span(descriptor).first(static_cast<std::size_t>(file.gcount())));
  if (!fields) return std::nullopt;
  auto reports = find_pid_reports(*fields);
  if (!reports) return std::nullopt;
  return PidNode{(dev / nodes->path().filename()).string(), std::move(*reports)};
}

std::unique_ptr<InputDevice> with_pid_force(std::unique_ptr<InputDevice> input, std::unique_ptr<HidDevice> motor,
                                            const PidReports& reports) {
  return std::make_unique<PidInput>(std::move(input), std::move(motor), reports);
}

}  // namespace septet::car_io
