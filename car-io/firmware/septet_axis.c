#include "septet_firmware.h"

/// share × full of a way from 0, 0 to full.
static int64_t along(int64_t way, int64_t length, int64_t full) {
  int64_t result = 0;
  if (length > 0) {
    result = ((way * full) + (length / 2)) / length;
    if (result < 0) {
      result = 0;
    } else if (result > full) {
      result = full;
    } else {
      // Between the ends.
    }
  }
  return result;
}

/// 1 where readings count the way that the host does, −1 where they count against it.
static int64_t turn_of(const septet_axis *axis) {
  int64_t turn = 1;
  if (axis->at_most < axis->at_least) {
    turn = -1;
  }
  return turn;
}

int16_t septet_wheel(const septet_axis *axis, int32_t raw) {
  const int64_t full = 32767;
  // Counted so that left is more.
  const int64_t turn = turn_of(axis);
  const int64_t from_centre = turn * ((int64_t)raw - axis->at_centre);
  const int64_t to_left = turn * ((int64_t)axis->at_most - axis->at_centre);
  const int64_t to_right = turn * ((int64_t)axis->at_centre - axis->at_least);
  int64_t result = 0;
  if (from_centre > axis->dead_zone) {
    result = -along(from_centre - axis->dead_zone, to_left - axis->dead_zone, full);
  } else if (from_centre < -(int64_t)axis->dead_zone) {
    result = along(-from_centre - axis->dead_zone, to_right - axis->dead_zone, full);
  } else {
    // Straight.
  }
  return (int16_t)result;
}

uint16_t septet_pedal(const septet_axis *axis, int32_t raw) {
  const int64_t turn = turn_of(axis);
  const int64_t way = (turn * ((int64_t)raw - axis->at_least)) - axis->dead_zone;
  const int64_t length = (turn * ((int64_t)axis->at_most - axis->at_least)) - axis->dead_zone;
  return (uint16_t)along(way, length, 65535);
}
