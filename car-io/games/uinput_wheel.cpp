#include "car-io/games/uinput_wheel.hpp"

#include <fcntl.h>
#include <linux/uinput.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "car-io/driver_buttons.hpp"

namespace septet::car_io {
namespace {

constexpr std::int32_t axis_most = 32767;
constexpr std::uint16_t vendor_id = 0x1209, product_id = 0x0002;
constexpr std::uint16_t first_button = BTN_TRIGGER;
constexpr std::size_t buttons = 16;

std::int32_t axis_value(double share) {
  return std::isfinite(share) ? static_cast<std::int32_t>(std::lround(std::clamp(share, -1.0, 1.0) * axis_most)) : 0;
}

struct Shown {
  std::array<std::int32_t, 4> axes{};  ///< X, Y, Z, RZ.
  std::array<bool, buttons> down{};
};
constexpr std::uint16_t axis_codes[] = {ABS_X, ABS_Y, ABS_Z, ABS_RZ};

Shown shown_of(const DriverInput& input, double steering_lock_rad) {
  Shown shown;
  shown.axes = {axis_value(-input.steering_wheel_rad / steering_lock_rad), axis_value(input.clutch),
                axis_value(input.accelerator), axis_value(input.brake)};
  const bool manual = input.selector == GearSelector::manual;
  std::ranges::copy(driver_buttons(input), shown.down.begin());
  constexpr std::size_t reverse = 7, first_gear = 8;
  shown.down[reverse] = input.selector == GearSelector::reverse || (manual && input.gear < 0);
  if (manual && input.gear >= 1 && input.gear <= 6)
    shown.down[first_gear - 1 + static_cast<std::size_t>(input.gear)] = true;
  return shown;
}

double share_of(std::int32_t value, double full) { return static_cast<double>(value) / full; }

ForceWave wave_of(std::uint16_t waveform) {
  switch (waveform) {
    case FF_SQUARE:
      return ForceWave::square;
    case FF_TRIANGLE:
      return ForceWave::triangle;
    case FF_SAW_UP:
      return ForceWave::saw_up;
    case FF_SAW_DOWN:
      return ForceWave::saw_down;
    default:
      return ForceWave::sine;
  }
}

void take_envelope(ForceEffect& result, const ff_envelope& envelope) {
  result.attack_s = envelope.attack_length / 1000.0;
  result.attack_level = share_of(envelope.attack_level, 32767.0);
  result.fade_s = envelope.fade_length / 1000.0;
  result.fade_level = share_of(envelope.fade_level, 32767.0);
}

void take_condition(ForceEffect& result, const ff_condition_effect& condition) {
  result.left_coefficient = share_of(condition.left_coeff, 32767.0);
  result.right_coefficient = share_of(condition.right_coeff, 32767.0);
  result.left_most = share_of(condition.left_saturation, 65535.0);
  result.right_most = share_of(condition.right_saturation, 65535.0);
  result.dead_band = share_of(condition.deadband, 32767.0);
  result.centre = -share_of(condition.center, 32767.0);  // An axis counts to the right.
}

}  // namespace

ForceEffect force_effect_of(const ff_effect& effect) {
  ForceEffect result;
  result.length_s = effect.replay.length / 1000.0;
  result.delay_s = effect.replay.delay / 1000.0;
  // 0x4000 is to the left. A direction along the other axis is unset.
  const double turned = std::sin(2.0 * std::numbers::pi * effect.direction / 65536.0);
  const double to_left = std::abs(turned) < 0.1 ? 1.0 : turned;
  switch (effect.type) {
    case FF_SPRING:
    case FF_DAMPER:
    case FF_FRICTION:
    case FF_INERTIA:
      result.kind = effect.type == FF_SPRING     ? ForceKind::spring
                    : effect.type == FF_DAMPER   ? ForceKind::damper
                    : effect.type == FF_FRICTION ? ForceKind::friction
                                                 : ForceKind::inertia;
      take_condition(result, effect.u.condition[0]);
      break;
    case FF_PERIODIC:
      result.kind = ForceKind::periodic;
      result.wave = wave_of(effect.u.periodic.waveform);
      result.period_s = effect.u.periodic.period / 1000.0;
      result.phase_turns = effect.u.periodic.phase / 65536.0;
      result.level = to_left * share_of(effect.u.periodic.magnitude, 32767.0);
      result.offset = to_left * share_of(effect.u.periodic.offset, 32767.0);
      take_envelope(result, effect.u.periodic.envelope);
      break;
    case FF_RAMP:
      result.kind = ForceKind::ramp;
      result.level = to_left * share_of(effect.u.ramp.start_level, 32767.0);
      result.end_level = to_left * share_of(effect.u.ramp.end_level, 32767.0);
      take_envelope(result, effect.u.ramp.envelope);
      break;
    default:
      result.level = effect.type == FF_CONSTANT ? to_left * share_of(effect.u.constant.level, 32767.0) : 0.0;
      if (effect.type == FF_CONSTANT) take_envelope(result, effect.u.constant.envelope);
  }
  return result;
}

std::vector<WheelEvent> wheel_events(const DriverInput& now, const DriverInput* before, double steering_lock_rad) {
  std::vector<WheelEvent> events;
  const Shown shown = shown_of(now, steering_lock_rad);
  const std::optional<Shown> earlier = before ? std::optional(shown_of(*before, steering_lock_rad)) : std::nullopt;
  for (std::size_t i = 0; i < shown.axes.size(); ++i)
    if (!earlier || earlier->axes[i] != shown.axes[i]) events.push_back({EV_ABS, axis_codes[i], shown.axes[i]});
  for (std::size_t i = 0; i < buttons; ++i)
    if (!earlier || earlier->down[i] != shown.down[i])
      events.push_back({EV_KEY, static_cast<std::uint16_t>(first_button + i), shown.down[i] ? 1 : 0});
  if (!events.empty()) events.push_back({EV_SYN, SYN_REPORT, 0});
  return events;
}

struct UinputWheel::State {
  explicit State(int opened) : file(opened) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { close(file); }  // The kernel takes the wheel away with its file.

  tl::unexpected<Error> failed(const std::string& doing) const {
    return failure(fmt::format("{} failed: {}", doing, std::strerror(errno)), "/dev/uinput",
                   "load the module uinput, and give your user access with a udev rule (car-io/games/README.md)");
  }
  bool set(unsigned long request, int value) const { return ioctl(file, request, value) >= 0; }

  Expected<void> set_up() const {
    bool done = set(UI_SET_EVBIT, EV_ABS) && set(UI_SET_EVBIT, EV_KEY) && set(UI_SET_EVBIT, EV_FF);
    for (std::size_t i = 0; i < buttons; ++i) done = done && set(UI_SET_KEYBIT, static_cast<int>(first_button + i));
    for (const int bit : {FF_CONSTANT, FF_SPRING, FF_DAMPER, FF_FRICTION, FF_INERTIA, FF_RAMP, FF_PERIODIC, FF_SQUARE,
                          FF_TRIANGLE, FF_SINE, FF_SAW_UP, FF_SAW_DOWN, FF_GAIN, FF_AUTOCENTER})
      done = done && set(UI_SET_FFBIT, bit);
    for (const std::uint16_t code : axis_codes) {
      uinput_abs_setup axis{};
      axis.code = code;
      axis.absinfo.minimum = code == ABS_X ? -axis_most : 0;
      axis.absinfo.maximum = axis_most;
      done = done && ioctl(file, UI_ABS_SETUP, &axis) >= 0;
    }
    uinput_setup setup{};
    setup.id.bustype = BUS_USB;
    setup.id.vendor = vendor_id;
    setup.id.product = product_id;
    setup.id.version = 1;
    setup.ff_effects_max = 16;
    std::strncpy(setup.name, "Septet game wheel", sizeof setup.name - 1);
    done = done && ioctl(file, UI_DEV_SETUP, &setup) >= 0 && ioctl(file, UI_DEV_CREATE) >= 0;
    if (!done) return failed("making a wheel");
    return {};
  }

  int file;
  std::optional<DriverInput> shown;
};

UinputWheel::UinputWheel(std::unique_ptr<State> state) : state_(std::move(state)) {}
UinputWheel::UinputWheel(UinputWheel&&) noexcept = default;
UinputWheel& UinputWheel::operator=(UinputWheel&&) noexcept = default;
UinputWheel::~UinputWheel() = default;

Expected<UinputWheel> UinputWheel::create() {
  const int file = open("/dev/uinput", O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (file < 0)
    return failure(fmt::format("it cannot be opened: {}", std::strerror(errno)), "/dev/uinput",
                   "load the module uinput, and give your user access with a udev rule (car-io/games/README.md)");
  auto state = std::make_unique<State>(file);
  if (auto done = state->set_up(); !done) return tl::unexpected(done.error());
  return UinputWheel(std::move(state));
}

Expected<void> UinputWheel::show(const DriverInput& input, double steering_lock_rad) {
  std::vector<input_event> events;
  for (const WheelEvent& event : wheel_events(input, state_->shown ? &*state_->shown : nullptr, steering_lock_rad)) {
    input_event out{};
    out.type = event.type;
    out.code = event.code;
    out.value = event.value;
    events.push_back(out);
  }
  state_->shown = input;
  const std::size_t bytes = events.size() * sizeof(input_event);
  if (bytes > 0 && write(state_->file, events.data(), bytes) != static_cast<ssize_t>(bytes) && errno != EAGAIN)
    return state_->failed("telling the game what the driver does");
  return {};
}

Expected<void> UinputWheel::take_effects(ForceEffects& effects, double now_s) {
  std::array<input_event, 64> events{};
  const ssize_t count = read(state_->file, events.data(), sizeof events);
  if (count < 0) {
    if (errno == EAGAIN || errno == EINTR) return {};
    return state_->failed("hearing the game's forces");
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(count) / sizeof(input_event); ++i) {
    const input_event& event = events[i];
    if (event.type == EV_UINPUT && event.code == UI_FF_UPLOAD) {
      uinput_ff_upload upload{};
      upload.request_id = static_cast<std::uint32_t>(event.value);
      if (ioctl(state_->file, UI_BEGIN_FF_UPLOAD, &upload) < 0) continue;  // The game has gone meanwhile.
      effects.load(upload.effect.id, force_effect_of(upload.effect));
      upload.retval = 0;
      ioctl(state_->file, UI_END_FF_UPLOAD, &upload);
    } else if (event.type == EV_UINPUT && event.code == UI_FF_ERASE) {
      uinput_ff_erase erase{};
      erase.request_id = static_cast<std::uint32_t>(event.value);
      if (ioctl(state_->file, UI_BEGIN_FF_ERASE, &erase) < 0) continue;
      effects.erase(static_cast<std::int16_t>(erase.effect_id));
      erase.retval = 0;
      ioctl(state_->file, UI_END_FF_ERASE, &erase);
    } else if (event.type == EV_FF && event.code == FF_GAIN) {
      effects.set_gain(event.value / 65535.0);
    } else if (event.type == EV_FF && event.code == FF_AUTOCENTER) {
      effects.set_autocentre(event.value / 65535.0);
    } else if (event.type == EV_FF) {
      effects.play(static_cast<std::int16_t>(event.code), event.value, now_s);
    }
  }
  return {};
}

}  // namespace septet::car_io
