#include "septet_firmware.h"

const uint8_t septet_report_descriptor[] = {
    0x05, 0x01, 0x09, 0x04, 0xa1, 0x01,                         // A joystick of Generic Desktop.
    0x85, SEPTET_CONTROLS_ID,                                   // Report id 1
    0x05, 0x02, 0x09, 0xc8, 0x16, 0x01, 0x80, 0x26, 0xff, 0x7f, //   Simulation Controls: steering, −32767 to 32767
    0x75, 16, 0x95, 1, 0x81, 0x02,                              //   16 bits, input
    0x09, 0xc4, 0x09, 0xc5, 0x09, 0xc6,                         //   accelerator, brake, clutch
    0x15, 0x00, 0x27, 0xff, 0xff, 0x00, 0x00,                   //   0 to 65535
    0x95, 3, 0x81, 0x02,                                        //   3 × 16 bits
    0x05, 0x09, 0x19, 1, 0x29, SEPTET_BUTTONS, 0x25, 0x01,      //   buttons
    0x75, 1, 0x95, SEPTET_BUTTONS, 0x81, 0x02,                  //   a bit each
    0x06, 0x00, 0xff, 0x09, 0x01, 0x26, 0xff, 0x00,             //   vendor's own: selector and gear
    0x75, 8, 0x95, 1, 0x81, 0x02,                               //   a byte
    0x09, 0x02, 0x16, 0x00, 0x80, 0x26, 0xff, 0x7f,             //   heading of the head
    0x75, 16, 0x81, 0x02,                                       //   16 bits
    0x09, 0x03, 0x15, 0x00, 0x26, 0xff, 0x00, 0x75, 8, 0x81, 0x02, // sequence
    0x85, SEPTET_ACTUATORS_ID,                                  // Report id 2
    0x09, 0x10, 0x09, 0x11, 0x27, 0xff, 0xff, 0x00, 0x00,       //   fan, vibration
    0x75, 16, 0x95, 2, 0x91, 0x02,                              //   2 × 16 bits, output
    0x09, 0x12, 0x09, 0x13, 0x26, 0xff, 0x00,                   //   frequency, sequence
    0x75, 8, 0x95, 2, 0x91, 0x02,                               //   2 × 8 bits
    0x85, SEPTET_DEVICE_ID,                                     // Report id 3
    0x09, 0x20, 0x09, 0x21, 0x27, 0xff, 0xff, 0x00, 0x00,       //   firmware, watchdog
    0x75, 16, 0x95, 2, 0xb1, 0x02,                              //   2 × 16 bits, feature
    0x85, SEPTET_STEERING_ID,                                   // Report id 4
    0x09, 0x30, 0x16, 0x01, 0x80, 0x26, 0xff, 0x7f,             //   force of the hand wheel
    0x75, 16, 0x95, 1, 0x91, 0x02,                              //   16 bits, output
    0x09, 0x31, 0x15, 0x00, 0x26, 0xff, 0x00, 0x75, 8, 0x91, 0x02, // sequence
    0xc0,
};
const uint16_t septet_report_descriptor_bytes = (uint16_t)sizeof septet_report_descriptor;

static void put_u16(uint8_t *bytes, uint16_t value) {
  bytes[0] = (uint8_t)(value & 0xffU);
  bytes[1] = (uint8_t)(value >> 8U);
}

static uint16_t get_u16(const uint8_t *bytes) { return (uint16_t)(bytes[0] | ((uint32_t)bytes[1] << 8U)); }

/// Two's complement, without what C leaves to the compiler.
static int16_t get_i16(const uint8_t *bytes) {
  int32_t value = (int32_t)get_u16(bytes);
  if (value > 32767) {
    value -= 65536;
  }
  return (int16_t)value;
}

void septet_pack_controls(septet_device *device, uint8_t report[SEPTET_CONTROLS_BYTES]) {
  const septet_readings *now = &device->now;
  ++device->sequence;
  report[0] = (uint8_t)SEPTET_CONTROLS_ID;
  put_u16(&report[1], (uint16_t)septet_wheel(&device->steering, now->steering));
  put_u16(&report[3], septet_pedal(&device->accelerator, now->accelerator));
  put_u16(&report[5], septet_pedal(&device->brake, now->brake));
  put_u16(&report[7], septet_pedal(&device->clutch, now->clutch));
  put_u16(&report[9], now->buttons);
  // A lever between two positions is in neutral.
  report[11] = (uint8_t)((now->selector <= 4U) ? now->selector : 2U);
  report[11] = (uint8_t)(report[11] | (uint32_t)(((now->gear <= 7U) ? now->gear : 1U) << 4U));
  put_u16(&report[12], (uint16_t)now->head);
  report[14] = device->sequence;
}

void septet_pack_device(const septet_device *device, uint8_t report[SEPTET_DEVICE_BYTES]) {
  report[0] = (uint8_t)SEPTET_DEVICE_ID;
  put_u16(&report[1], (uint16_t)SEPTET_FIRMWARE_VERSION);
  put_u16(&report[3], device->watchdog_ms);
}

static void take_actuators(septet_device *device, const uint8_t *report, uint32_t now_ms) {
  const uint8_t sequence = report[6];
  // A host that repeats itself is one that hangs.
  const bool is_new = (!device->is_fed) || (sequence != device->fed_sequence);
  device->wanted_fan = get_u16(&report[1]);
  device->wanted_vibration = get_u16(&report[3]);
  device->wanted_hz = report[5];
  if (is_new) {
    device->is_fed = true;
    device->fed_sequence = sequence;
    device->fed_ms = now_ms;
    const bool at_rest = (device->wanted_fan == 0U) && (device->wanted_vibration == 0U) && (device->wanted_hz == 0U) &&
                         (device->wanted_steering == 0);
    if (at_rest && ((device->state == SEPTET_NOT_ARMED) || (device->state == SEPTET_HOST_SILENT))) {
      device->state = SEPTET_RUNS;
    }
  }
}

static void take_steering(septet_device *device, const uint8_t *report, uint32_t now_ms) {
  const uint8_t sequence = report[3];
  const int16_t force = get_i16(&report[1]);
  device->wanted_steering = (force < -32767) ? (int16_t)-32767 : force;
  if ((!device->has_steering) || (sequence != device->steering_sequence)) {
    device->has_steering = true;
    device->steering_sequence = sequence;
    device->steering_ms = now_ms;
  }
}

bool septet_take_report(septet_device *device, const uint8_t *report, uint32_t size, uint32_t now_ms) {
  bool taken = false;
  // Before this report ends the silence.
  septet_watch_host(device, now_ms);
  if ((report != (const uint8_t *)0) && (size > 0U)) {
    if ((report[0] == (uint8_t)SEPTET_ACTUATORS_ID) && (size == (uint32_t)SEPTET_ACTUATORS_BYTES)) {
      take_actuators(device, report, now_ms);
      taken = true;
    } else if ((report[0] == (uint8_t)SEPTET_STEERING_ID) && (size == (uint32_t)SEPTET_STEERING_BYTES)) {
      take_steering(device, report, now_ms);
      taken = true;
    } else if ((report[0] == (uint8_t)SEPTET_DEVICE_ID) && (size == (uint32_t)SEPTET_DEVICE_BYTES)) {
      const uint16_t watchdog_ms = get_u16(&report[3]);
      if ((watchdog_ms > 0U) && (watchdog_ms <= (uint16_t)SEPTET_LONGEST_WATCHDOG_MS)) {
        device->watchdog_ms = watchdog_ms;
        taken = true;
      }
    } else {
      // Nothing of ours.
    }
  }
  return taken;
}
