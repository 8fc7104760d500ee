// Costs of the server's tick with the driver's car and 200 vehicles, and of its snapshot on the wire.

#include <chrono>
#include <optional>

#include <benchmark/benchmark.h>

#include "engine/core/check.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/collisions.hpp"
#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/driver_eyes.hpp"
#include "engine/simulation/server_step.hpp"
#include "engine/world/wire_snapshot.hpp"
#include "program/resources.hpp"
#include "program/temporary_folder.hpp"
#include "sim-server/drive/drive_loader.hpp"
#include "sim-server/drive/driver_seat.hpp"

namespace septet::server {
namespace {

LoadedDrive motorway_drive() {
  const auto scenario = program::find_resource("behind-ambulance", "scenarios", ".xosc");
  const auto rig = program::find_resource("seven-screens", "rigs", ".toml");
  SEPTET_CHECK(scenario && rig, "the shipped scenario and rig are missing");
  auto drive = load_drive(DriveFiles{scenario->string(), rig->string(), 1});
  SEPTET_CHECK(drive.has_value(), "{}", describe(drive.error()));
  return std::move(*drive);
}

/// The drive some seconds after its start, when everybody has found their pace.
struct RunningDrive {
  std::shared_ptr<const simulation::Model> model = motorway_drive().model;
  simulation::State state = *simulation::initial_state(*model, traffic::own_traffic(model->roads, 1));
  std::vector<simulation::Event> events;
  DriverInput input;

  RunningDrive() {
    input.accelerator = 0.35;
    for (int tick = 0; tick < 240; ++tick) step();
  }
  Snapshot step() {
    events.clear();
    return simulation::server_step(*model, input, state, events);
  }
};

void server_tick_200(benchmark::State& bench) {
  // Without steering the car meets somebody in tick 408, and the ticks from then on are those of a crash.
  constexpr int ticks_on_the_road = 150;
  std::optional<RunningDrive> drive;
  int left = 0;
  for (auto _ : bench) {
    if (left-- == 0) {
      bench.PauseTiming();
      drive.emplace();
      left = ticks_on_the_road - 1;
      bench.ResumeTiming();
    }
    benchmark::DoNotOptimize(drive->step());
  }
  SEPTET_CHECK(drive->state.diagnostics.collisions == 0, "the car has met somebody in {} ticks", drive->state.tick);
  bench.counters["vehicles"] =
      static_cast<double>(simulation::capture_snapshot(*drive->model, drive->state).participants.size());
}
BENCHMARK(server_tick_200)->Name("server_tick/200")->Unit(benchmark::kMicrosecond);

/// The part of that tick which anybody's being hit costs while nobody is: beside server_tick/200 of the same run.
void collisions_of_nobody_200(benchmark::State& bench) {
  RunningDrive drive;
  const Snapshot now = drive.step();
  simulation::DrivenCar car = simulation::driven_car(*drive.model, drive.state);
  std::vector<Participant> participants = now.participants;
  for (auto _ : bench) {
    simulation::place_in_storyboard(*drive.model, drive.state);
    simulation::advance_bodies(*drive.model, drive.state, drive.events);
    simulation::append_bodies(drive.state, participants);
    simulation::find_collisions(*drive.model, car, participants, drive.state, drive.events);
  }
  SEPTET_CHECK(drive.state.bodies.empty(), "somebody was hit in tick {}", drive.state.tick);
}
BENCHMARK(collisions_of_nobody_200)->Name("server_tick/200_collisions_of_nobody")->Unit(benchmark::kMicrosecond);

/// One look of the driver's eyes at those around, of which a tick has a twelfth: beside server_tick/200 of the same run.
void whom_the_driver_sees_200(benchmark::State& bench) {
  RunningDrive drive;
  const std::vector<Participant> participants = drive.step().participants;
  for (auto _ : bench) simulation::look_for_others(*drive.model, participants, drive.state, drive.events);
  SEPTET_CHECK(!drive.state.sightings.near.empty(), "nobody is near");
}
BENCHMARK(whom_the_driver_sees_200)->Name("server_tick/200_whom_the_driver_sees")->Unit(benchmark::kMicrosecond);

/// Simulated over computed time, without screens: driver's car, simulated driver, traffic and the session log. The
/// benchmark's own figure is the CPU time of the thread that simulates; by the clock the log's thread, which encodes
/// and writes, counts too.
void server_realtime_factor(benchmark::State& bench) {
  const LoadedDrive loaded = motorway_drive();
  const auto folder = program::TemporaryFolder::make("septet-bench");
  SEPTET_CHECK(folder.has_value(), "{}", describe(folder.error()));
  auto log = SessionLog::create(loaded, {.out = folder->path(), .lockstep = true});
  SEPTET_CHECK(log.has_value(), "{}", describe(log.error()));
  auto seat = open_driver_seat(rig::Car{}, 1, loaded.model);
  auto drive = LiveDrive::start(loaded.model, traffic::own_traffic(loaded.model->roads, 1), std::move(*seat));
  (*drive)->log_to(*log);
  std::uint64_t ticks = 0;
  const auto begun = std::chrono::steady_clock::now();
  for (auto _ : bench) {
    const auto tick = (*drive)->next(std::nullopt);
    SEPTET_CHECK(tick && *tick, "the drive has ended after {} ticks: measure for a shorter time", ticks);
    ++ticks;
  }
  SEPTET_CHECK(log->finish({}).has_value(), "the log of {} ticks is not complete", ticks);
  const std::chrono::duration<double> clock = std::chrono::steady_clock::now() - begun;
  const double simulated_s = static_cast<double>(ticks) / simulation::tick_rate_hz;
  bench.counters["times_real_time"] = benchmark::Counter(simulated_s, benchmark::Counter::kIsRate);
  bench.counters["by_the_clock"] = simulated_s / clock.count();
  bench.counters["vehicles"] = static_cast<double>((*drive)->newest().participants.size());
}
BENCHMARK(server_realtime_factor)->Unit(benchmark::kMicrosecond);

void snapshot_encode(benchmark::State& bench) {
  RunningDrive drive;
  const WireSnapshot before = to_wire(drive.step());
  const Snapshot now = drive.step();
  std::size_t bytes = 0;
  for (auto _ : bench) {
    Bytes out;
    encode_snapshot(to_wire(now), &before, out);
    bytes = out.size();
  }
  bench.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(snapshot_encode)->Name("snapshot_encode/200")->Unit(benchmark::kMicrosecond);

void snapshot_decode(benchmark::State& bench) {
  RunningDrive drive;
  const WireSnapshot before = to_wire(drive.step());
  Bytes bytes;
  encode_snapshot(to_wire(drive.step()), &before, bytes);
  for (auto _ : bench) benchmark::DoNotOptimize(from_wire(*decode_snapshot(bytes, &before)));
}
BENCHMARK(snapshot_decode)->Name("snapshot_decode/200")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace septet::server
