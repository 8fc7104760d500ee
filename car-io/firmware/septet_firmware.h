#ifndef SEPTET_FIRMWARE_H
#define SEPTET_FIRMWARE_H
/// Core of the firmware of the microcontroller in the car, without its hardware: reports in and out
/// (car-io/REPORTS.md), debouncing of contacts, calibration of axes, and outputs that are safe at any behaviour of the
/// host. C11, no heap, no floating point, no clock and no pins of its own: a port passes readings, the time in
/// milliseconds (which wraps) and the reports of its USB stack, and sets the pins by the outputs (README.md).
///
///     septet_start(&device);                                       once
///     septet_take_report(&device, bytes, size, now_ms);            from the USB stack, as an output report comes
///     septet_step(&device, &readings, now_ms, &outputs);           every millisecond or so
///     septet_pack_controls(&device, report);                       for each input report, 100 times a second or more
///
/// One thread: call all of it from one place, or with interrupts held off.

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
  SEPTET_FIRMWARE_VERSION = 0x0100,
  SEPTET_CONTROLS_ID = 1,
  SEPTET_ACTUATORS_ID = 2,
  SEPTET_DEVICE_ID = 3,
  SEPTET_STEERING_ID = 4,
  SEPTET_CONTROLS_BYTES = 15,
  SEPTET_ACTUATORS_BYTES = 7,
  SEPTET_DEVICE_BYTES = 5,
  SEPTET_STEERING_BYTES = 4,
  SEPTET_USUAL_WATCHDOG_MS = 250,
  SEPTET_LONGEST_WATCHDOG_MS = 1000,
  SEPTET_BUTTONS = 16,
  SEPTET_EMERGENCY_STOP_BIT = 7,
  SEPTET_REARM_BIT = 8
};

/// Descriptor for the USB stack (HID 1.11, 6.2.2); its reports have the sizes of car-io/car_report.hpp
/// (tests/car-io/car_report_test.cpp).
extern const uint8_t septet_report_descriptor[];
extern const uint16_t septet_report_descriptor_bytes;

/// Raw readings (of an analogue converter, an encoder) at both ends: hand wheel full right, straight, full left; pedal
/// released and floored. They may ascend or descend.
typedef struct {
  int32_t at_least, at_centre, at_most;
  int32_t dead_zone; ///< Raw steps around straight, or from released, that read as 0.
} septet_axis;

/// Present readings of the pins.
typedef struct {
  int32_t steering, accelerator, brake, clutch; ///< Raw.
  uint16_t buttons;                             ///< By bits of the report, including emergency stop and re-arm.
  uint8_t selector, gear;                       ///< As in the report: 0 park … 4 manual; 0 reverse, 1 neutral, 2 … 7.
  int16_t head;                                 ///< INT16_MIN: no head tracker.
} septet_readings;

/// Outputs for the port. All are off after a reset.
typedef struct {
  bool fan_power, amplifier_power, motor_power; ///< Relays: without its PWM a fan would run at full speed.
  uint16_t fan;                                 ///< Duty of the PWM, 0 to 65535.
  uint16_t vibration;                           ///< Amplitude likewise, of vibration_hz.
  uint8_t vibration_hz;
  int16_t steering; ///< −32767 turns the wheel to the left with the motor's full torque.
  uint32_t vibration_phase;
} septet_outputs;

/// Reason for outputs that are off.
typedef enum {
  SEPTET_RUNS = 0,
  SEPTET_NOT_ARMED = 1,      ///< No report at rest since the reset, or since a reason below ended.
  SEPTET_HOST_SILENT = 2,    ///< No new output report within the watchdog's time.
  SEPTET_EMERGENCY_STOP = 3, ///< Its contact is open.
} septet_state;

typedef struct {
  septet_axis steering, accelerator, brake, clutch; ///< Set by the port after septet_start.
  // Members below are private to the core.
  septet_readings now; ///< Debounced.
  uint16_t raw_buttons;
  uint8_t settled_ms[SEPTET_BUTTONS];
  uint8_t sequence;
  uint16_t watchdog_ms;
  septet_state state;
  bool is_fed, has_steering;
  uint8_t fed_sequence, steering_sequence;
  uint32_t fed_ms, steering_ms, stepped_ms;
  uint16_t wanted_fan, wanted_vibration;
  uint8_t wanted_hz;
  int16_t wanted_steering;
  septet_outputs outputs;
} septet_device;

/// Sets the state after a reset: all off, emergency stop taken as pressed until its contact has been closed for 50 ms.
void septet_start(septet_device *device);

/// Takes an output report (ids 2 and 4), or the feature report that sets the watchdog (id 3). Returns false for any
/// other, of which nothing is kept. A report after the watchdog's time does not undo the silence, even if no step has
/// noticed it.
bool septet_take_report(septet_device *device, const uint8_t *report, uint32_t size, uint32_t now_ms);

/// Detects a host that has been silent for too long; septet_take_report and septet_step call it.
void septet_watch_host(septet_device *device, uint32_t now_ms);

/// Debounces, watches, moves the outputs at safe rates: to 0 at once, to full in a second, the motor in 50 ms.
void septet_step(septet_device *device, const septet_readings *readings, uint32_t now_ms, septet_outputs *outputs);

/// Writes the next input report.
void septet_pack_controls(septet_device *device, uint8_t report[SEPTET_CONTROLS_BYTES]);
/// Writes the feature report that the host reads.
void septet_pack_device(const septet_device *device, uint8_t report[SEPTET_DEVICE_BYTES]);

/// Hand wheel in the report's terms: −32767 full left to 32767 full right. A reading beyond an end counts as the end;
/// ends that coincide read as 0.
int16_t septet_wheel(const septet_axis *axis, int32_t raw);
/// Pedal: 0 released to 65535 floored; at_centre does not count.
uint16_t septet_pedal(const septet_axis *axis, int32_t raw);

/// The shaker's next sample, −32767 to 32767, for a port that plays it itself; `rate_hz` samples a second, at least
/// 1000. The wave never jumps.
int16_t septet_vibration_sample(septet_outputs *outputs, uint32_t rate_hz);

#ifdef __cplusplus
}
#endif
#endif
