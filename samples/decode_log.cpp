/// Decodes the log of a drive: who drove what, and where the driver's car was, from the snapshot of every tick.
///
///     septet drive --no-screens --seconds 2 && decode_log out/latest/session.sqlite
#include <fmt/core.h>

#include "engine/world/snapshot.hpp"
#include "logging/session/session_reader.hpp"

int main(int argc, char** argv) {
  using namespace septet;
  const auto fail = [](const Error& error) {
    fmt::print(stderr, "decode_log: {}\n", describe(error));
    return 1;
  };
  if (argc != 2) {
    fmt::print(stderr, "usage: decode_log session.sqlite\n");
    return 2;
  }
  const auto session = logging::SessionReader::open(argv[1]);
  if (!session) return fail(session.error());
  const logging::SessionInfo& info = session->info();
  fmt::print("Septet {}, {}, {} ticks a second\n", info.septet_version, info.started_utc, info.ticks_per_second);

  auto cursor = session->snapshots();
  if (!cursor) return fail(cursor.error());
  std::size_t ticks = 0;
  for (;;) {
    const auto snapshot = cursor->next();
    if (!snapshot) return fail(snapshot.error());
    if (!*snapshot) break;
    const DriverCar& driver = (*snapshot)->driver_car;
    const Participant* car = find_participant(**snapshot, driver.participant);
    if (car && ticks % 60 == 0)
      fmt::print("tick {:5}  {:7.3f} s  x {:9.3f} m  y {:9.3f} m  {:6.1f} km/h  lane {}  {} others\n",
                 (*snapshot)->tick, (*snapshot)->simulated_time_s, car->world_from_vehicle.position_m.x,
                 car->world_from_vehicle.position_m.y, driver.speed_mps * 3.6, driver.lane,
                 (*snapshot)->participants.size() - 1);
    ++ticks;
  }
  fmt::print("{} ticks\n", ticks);
  return 0;
}
