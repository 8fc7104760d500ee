#include "septet_firmware.h"

enum {
  PRESSED_AFTER_MS = 5,   ///< A contact bounces for some milliseconds.
  RELEASED_AFTER_MS = 20, ///< Letting go is later than pressing: a switch with a bad contact stays pressed.
  STOP_RELEASED_AFTER_MS = 50,
  FULL_IN_MS = 1000,
  MOTOR_FULL_IN_MS = 50
};

void septet_start(septet_device *device) {
  static const septet_device reset = {
      .steering = {-32767, 0, 32767, 0},
      .accelerator = {0, 0, 65535, 0},
      .brake = {0, 0, 65535, 0},
      .clutch = {0, 0, 65535, 0},
      .now = {.buttons = (uint16_t)(1U << (uint32_t)SEPTET_EMERGENCY_STOP_BIT), .selector = 2U, .gear = 1U, .head = INT16_MIN},
      .raw_buttons = (uint16_t)(1U << (uint32_t)SEPTET_EMERGENCY_STOP_BIT),
      .watchdog_ms = (uint16_t)SEPTET_USUAL_WATCHDOG_MS,
      .state = SEPTET_EMERGENCY_STOP,
  };
  *device = reset;
}

/// How long a button's reading must last before it counts; the emergency stop's counts at once.
static uint8_t settles_after_ms(uint32_t bit, bool pressed) {
  uint8_t after_ms = pressed ? (uint8_t)PRESSED_AFTER_MS : (uint8_t)RELEASED_AFTER_MS;
  if (bit == (uint32_t)SEPTET_EMERGENCY_STOP_BIT) {
    after_ms = pressed ? (uint8_t)0 : (uint8_t)STOP_RELEASED_AFTER_MS;
  }
  return after_ms;
}

static void debounce(septet_device *device, uint16_t raw, uint32_t elapsed_ms) {
  const uint16_t changed = (uint16_t)(raw ^ device->raw_buttons);
  for (uint32_t bit = 0; bit < (uint32_t)SEPTET_BUTTONS; ++bit) {
    const uint16_t mask = (uint16_t)(1UL << bit);
    const bool pressed = (raw & mask) != 0U;
    if ((changed & mask) != 0U) {
      device->settled_ms[bit] = 0;
    } else {
      const uint32_t settled_ms = device->settled_ms[bit] + elapsed_ms;
      device->settled_ms[bit] = (uint8_t)((settled_ms < 255U) ? settled_ms : 255U);
    }
    if (device->settled_ms[bit] >= settles_after_ms(bit, pressed)) {
      device->now.buttons = (uint16_t)(pressed ? (device->now.buttons | mask) : (device->now.buttons & ~(uint32_t)mask));
    }
  }
  device->raw_buttons = raw;
}

/// The value that follows `from` on its way to `to`: down at once, up by `step` at most.
static uint16_t rising(uint16_t from, uint16_t to, uint32_t step) {
  uint32_t next = to;
  if ((to > from) && (step < ((uint32_t)to - from))) {
    next = (uint32_t)from + step;
  }
  return (uint16_t)next;
}

static int16_t turning(int16_t from, int16_t to, uint32_t step) {
  const int32_t most = (step < 65534U) ? (int32_t)step : (int32_t)65534;
  int32_t way = (int32_t)to - (int32_t)from;
  if (way > most) {
    way = most;
  } else if (way < -most) {
    way = -most;
  } else {
    // Near enough.
  }
  return (int16_t)((int32_t)from + way);
}

void septet_watch_host(septet_device *device, uint32_t now_ms) {
  if ((device->state == SEPTET_RUNS) && ((uint32_t)(now_ms - device->fed_ms) > device->watchdog_ms)) {
    device->state = SEPTET_HOST_SILENT;
  }
  if (device->has_steering && ((uint32_t)(now_ms - device->steering_ms) > device->watchdog_ms)) {
    device->has_steering = false;
    device->wanted_steering = 0;
  }
}

static void watch(septet_device *device, uint32_t now_ms) {
  const bool is_stopped = (device->now.buttons & (1U << (uint32_t)SEPTET_EMERGENCY_STOP_BIT)) != 0U;
  if (is_stopped) {
    device->state = SEPTET_EMERGENCY_STOP;
  } else if (device->state == SEPTET_EMERGENCY_STOP) {
    device->state = SEPTET_NOT_ARMED;
  } else {
    // As it was.
  }
  septet_watch_host(device, now_ms);
}

void septet_step(septet_device *device, const septet_readings *readings, uint32_t now_ms, septet_outputs *outputs) {
  const uint32_t since_ms = (uint32_t)(now_ms - device->stepped_ms);
  const uint32_t elapsed_ms = (since_ms < 100U) ? since_ms : 100U;
  const uint16_t buttons = device->now.buttons;
  device->stepped_ms = now_ms;
  device->now = *readings;
  device->now.buttons = buttons;
  debounce(device, readings->buttons, elapsed_ms);
  watch(device, now_ms);

  septet_outputs *out = &device->outputs;
  out->vibration_phase = outputs->vibration_phase;
  if (device->state == SEPTET_RUNS) {
    const uint32_t step = (elapsed_ms * 65535U) / (uint32_t)FULL_IN_MS;
    out->fan = rising(out->fan, device->wanted_fan, step);
    out->vibration = rising(out->vibration, device->wanted_vibration, step);
    out->vibration_hz = device->wanted_hz;
    out->steering = turning(out->steering, device->wanted_steering, (elapsed_ms * 32767U) / (uint32_t)MOTOR_FULL_IN_MS);
    out->fan_power = true;
    out->amplifier_power = true;
    out->motor_power = device->has_steering;
  } else {
    out->fan = 0;
    out->vibration = 0;
    out->steering = 0;
    out->fan_power = false;
    out->amplifier_power = false;
    out->motor_power = false;
  }
  *outputs = *out;
}
