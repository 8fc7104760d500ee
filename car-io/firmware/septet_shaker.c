#include "septet_firmware.h"

/// A quarter of a sine, 0 to 32767.
static const int16_t quarter[65] = {
    0, 804, 1608, 2410, 3212, 4011, 4808, 5602, 6393, 7179, 7962, 8739, 9512,
    10278, 11039, 11793, 12539, 13279, 14010, 14732, 15446, 16151, 16846, 17530, 18204, 18868,
    19519, 20159, 20787, 21403, 22005, 22594, 23170, 23731, 24279, 24811, 25329, 25832, 26319,
    26790, 27245, 27683, 28105, 28510, 28898, 29268, 29621, 29956, 30273, 30571, 30852, 31113,
    31356, 31580, 31785, 31971, 32137, 32285, 32412, 32521, 32609, 32678, 32728, 32757, 32767,
};

/// Of a full turn of 2³².
static int32_t sine(uint32_t phase) {
  const uint32_t position = (phase & 0x3fffffffU) >> 16U; // Of a quarter, 0 to 16383.
  uint32_t way = position;
  if ((phase & 0x40000000U) != 0U) {
    way = 16384U - position;
  }
  const uint32_t index = way >> 8U;
  uint32_t next = index;
  if (index < 64U) {
    next = index + 1U;
  }
  const int32_t low = quarter[index];
  const int32_t high = quarter[next];
  const uint32_t part = way & 0xffU;
  const int32_t size = low + (((high - low) * (int32_t)part) / 256);
  return ((phase & 0x80000000U) != 0U) ? -size : size;
}

int16_t septet_vibration_sample(septet_outputs *outputs, uint32_t rate_hz) {
  if (rate_hz >= 1000U) {
    outputs->vibration_phase += (uint32_t)(((uint64_t)outputs->vibration_hz << 32U) / rate_hz);
  }
  int64_t sample = 0;
  if (outputs->amplifier_power) {
    const int64_t size = outputs->vibration;
    sample = ((int64_t)sine(outputs->vibration_phase) * size) / 65535;
  }
  return (int16_t)sample;
}
