#include "logging/session/input_hash.hpp"

namespace septet::logging {

void add_to_hash(const InputRecord& record, StateHash& hash) {
  const DriverInput& input = record.input;
  hash.add(record.tick);
  for (const double value :
       {input.steering_wheel_rad, input.accelerator, input.brake, input.clutch, input.gaze_heading_rad})
    hash.add(value);
  hash.add(static_cast<int>(input.selector));
  hash.add(input.gear);
  hash.add(static_cast<int>(input.indicator));
  for (const bool is_on : {input.hazard_lights, input.horn, input.low_beam, input.high_beam, input.parking_brake})
    hash.add(is_on ? 1 : 0);
  hash.add(input.sequence);
  if (input.head == Head{}) return;  // Keeps the hash of sessions from before head positions were input.
  for (const double value :
       {input.head.from_rest_m.x, input.head.from_rest_m.y, input.head.from_rest_m.z, input.head.turn_rad})
    hash.add(value);
}

}  // namespace septet::logging
