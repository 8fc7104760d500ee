#include <fcntl.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "car-io/devices/device_list.hpp"
#include "car-io/joystick/input_device.hpp"
#include "car-io/joystick/pid_input.hpp"
#include "car-io/pid/pid_node.hpp"

namespace septet::car_io {
namespace {

template <std::size_t Most>
using Bits = std::array<unsigned char, Most / 8 + 1>;

template <std::size_t Size>
bool has(const std::array<unsigned char, Size>& bits, unsigned bit) {
  return bit / 8 < Size && (bits[bit / 8] >> bit % 8 & 1u) != 0;
}

class EvdevDevice final : public InputDevice {
 public:
  EvdevDevice(int file, std::string node) : file_(file), node_(std::move(node)) {
    Bits<FF_MAX> effects{};
    const bool has_effects = ioctl(file_, EVIOCGBIT(EV_FF, effects.size()), effects.data()) >= 0;
    has_force_ = has_effects && has(effects, FF_CONSTANT);
    for (Condition& condition : conditions_) condition.is_there = has_effects && has(effects, condition.type);
    read_all();
  }
  EvdevDevice(const EvdevDevice&) = delete;
  EvdevDevice& operator=(const EvdevDevice&) = delete;
  /// The kernel ends a device's effects with the file that made them.
  ~EvdevDevice() override { close(file_); }

  bool has_force() const { return has_force_; }

  Expected<const InputState*> read() override {
    constexpr int most_at_once = 64;
    for (int i = 0; i < most_at_once; ++i) {
      std::array<input_event, 64> events{};
      const ssize_t count = ::read(file_, events.data(), sizeof events);
      if (count < 0 && (errno == EAGAIN || errno == EINTR)) break;
      if (count <= 0) return lost("reading", count == 0 ? ENODEV : errno);
      for (std::size_t e = 0; e < static_cast<std::size_t>(count) / sizeof(input_event); ++e) take(events[e]);
    }
    return &state_;
  }

  Expected<bool> set_force(double force) override {
    if (!has_force_) return false;
    ff_effect effect = constant_effect(force, effect_);
    if (ioctl(file_, EVIOCSFF, &effect) < 0) return lost("setting its force", errno);
    effect_ = effect.id;
    if (!play(effect_)) return lost("playing its force", errno);
    for (const Condition& condition : conditions_)
      if (condition.id >= 0 && !play(condition.id)) return lost("playing its force", errno);
    return true;
  }

  Expected<bool> set_feel(const WheelFeel& feel) override {
    bool any = false;
    const double shares[] = {feel.spring, feel.damper, feel.friction};
    for (std::size_t i = 0; i < conditions_.size(); ++i) {
      Condition& condition = conditions_[i];
      if (!condition.is_there || (shares[i] <= 0.0 && condition.id < 0)) continue;
      ff_effect effect = condition_effect(condition.type, shares[i], condition.id);
      // A wheel may have no room for another effect, and drives without it.
      if (ioctl(file_, EVIOCSFF, &effect) < 0) {
        if (errno == ENODEV) return lost("setting its feel", errno);
        condition.is_there = false;
        continue;
      }
      condition.id = effect.id;
      any = true;
    }
    return any;
  }

 private:
  struct Condition {
    std::uint16_t type;
    bool is_there = false;
    std::int16_t id = -1;  ///< Not loaded yet.
  };

  bool play(std::int16_t id) const {
    input_event event{};
    event.type = EV_FF;
    event.code = static_cast<std::uint16_t>(id);
    event.value = 1;
    return ::write(file_, &event, sizeof event) == static_cast<ssize_t>(sizeof event);
  }
  void read_all() {
    state_ = {};
    Bits<ABS_MAX> axes{};
    if (ioctl(file_, EVIOCGBIT(EV_ABS, axes.size()), axes.data()) >= 0)
      for (unsigned code = 0; code <= ABS_MAX; ++code) {
        input_absinfo info{};
        if (has(axes, code) && ioctl(file_, EVIOCGABS(code), &info) >= 0)
          state_.axes[static_cast<std::uint16_t>(code)] = {info.value, info.minimum, info.maximum};
      }
    Bits<KEY_MAX> keys{};
    if (ioctl(file_, EVIOCGKEY(keys.size()), keys.data()) >= 0)
      for (unsigned code = 0; code <= KEY_MAX; ++code)
        if (has(keys, code)) state_.down.insert(static_cast<std::uint16_t>(code));
  }
  void take(const input_event& event) {
    if (event.type == EV_ABS) {
      state_.axes[event.code].value = event.value;
    } else if (event.type == EV_KEY) {
      if (event.value != 0)
        state_.down.insert(event.code);
      else
        state_.down.erase(event.code);
    } else if (event.type == EV_SYN && event.code == SYN_DROPPED) {
      read_all();  // The kernel has thrown events away.
    }
  }
  tl::unexpected<Error> lost(const char* doing, int reason) const {
    return failure(fmt::format("{} failed: {}", doing, std::strerror(reason)), "input device " + node_,
                   "check the cable; it is opened again by itself");
  }

  int file_;
  std::string node_;
  InputState state_;
  bool has_force_ = false;
  std::int16_t effect_ = -1;  ///< Not loaded yet.
  std::array<Condition, 3> conditions_{{{FF_SPRING}, {FF_DAMPER}, {FF_FRICTION}}};
};

}  // namespace

Expected<std::unique_ptr<InputDevice>> open_input_device(const InputAddress& address, const std::filesystem::path& sys,
                                                         const std::filesystem::path& dev) {
  const std::string name = fmt::format("input device {:04x}:{:04x}{}", address.vendor_id, address.product_id,
                                       address.serial.empty() ? "" : " serial " + address.serial);
  for (const FoundDevice& found : list_devices(sys, dev)) {
    if (found.kind != DeviceKind::joystick || found.vendor_id != address.vendor_id ||
        found.product_id != address.product_id || (!address.serial.empty() && found.serial != address.serial))
      continue;
    // A wheel without a motor need not be written to.
    int file = open(found.node.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) file = open(found.node.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0)
      return failure(fmt::format("{} cannot be opened: {}", found.node, std::strerror(errno)), name,
                     "septet devices says which udev rule helps");
    auto device = std::make_unique<EvdevDevice>(file, found.node);
    if (device->has_force()) return device;
    const auto pid = find_pid_node(std::filesystem::path(found.node).filename().string(), sys, dev);
    if (!pid) return device;
    auto motor = open_hid_node(pid->node);
    if (!motor) return device;  // It drives without its force, which is reported to callers that want force.
    return with_pid_force(std::move(device), std::move(*motor), pid->reports);
  }
  return failure("no such wheel or joystick is plugged in", name,
                 "septet devices lists them; the rig's [car] names vendor_id and product_id");
}

}  // namespace septet::car_io
