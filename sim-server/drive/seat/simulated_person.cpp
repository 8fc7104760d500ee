#include "sim-server/drive/seat/simulated_person.hpp"

#include "engine/simulation/server_step.hpp"

namespace septet::server {

void SimulatedPerson::see(const Snapshot& before, std::span<const std::uint32_t> gone) {
  car_.drive(before, 1.0 / simulation::tick_rate_hz, gone);
}

}  // namespace septet::server
