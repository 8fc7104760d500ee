#pragma once
/// A loaded drive at its beginning, a simulated driver at the wheel and the scenario's own traffic around, without
/// screens or log.

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "sim-server/drive/driver_seat.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {

inline std::unique_ptr<LiveDrive> simulated_drive(const LoadedDrive& loaded, const std::string& driver,
                                                  std::uint64_t seed) {
  auto seat = open_driver_seat(rig::Car{.driver = driver}, seed, loaded.model);
  REQUIRE(seat.has_value());
  auto drive = LiveDrive::start(loaded.model, traffic::own_traffic(loaded.model->roads, seed), std::move(*seat));
  REQUIRE(drive.has_value());
  return std::move(*drive);
}

}  // namespace septet::server
