#include "sim-server/drive/seat/tracked_head.hpp"

#include "engine/simulation/server_step.hpp"

namespace septet::server {

void TrackedHead::add_to(DriverInput& input) { tracker_.move(input, 1.0 / simulation::tick_rate_hz); }

}  // namespace septet::server
