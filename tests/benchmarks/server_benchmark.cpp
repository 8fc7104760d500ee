// What a tick of the server costs with the driver's car and 200 vehicles, and what its snapshot costs on the wire.

#include <benchmark/benchmark.h>

#include "engine/core/check.hpp"
#include "engine/world/wire_snapshot.hpp"
#include "sim-server/drive_loader.hpp"
#include "sim-server/driver_seat.hpp"
#include "sim-server/resources.hpp"

namespace septet::server {
namespace {

std::shared_ptr<const SimulationModel> motorway_model() {
  const auto scenario = find_resource("motorway-ambulance", "scenarios", ".xosc");
  const auto rig = find_resource("seven-screens", "rigs", ".toml");
  SEPTET_CHECK(scenario && rig, "the shipped scenario and rig are missing");
  const auto drive = load_drive(DriveFiles{scenario->string(), rig->string(), 1});
  SEPTET_CHECK(drive.has_value(), "{}", describe(drive.error()));
  return drive->model;
}

/// The drive some seconds after its start, when everybody has found their pace.
struct RunningDrive {
  std::shared_ptr<const SimulationModel> model = motorway_model();
  SimulationState state = *initial_state(*model, traffic::own_traffic(model->roads, 1));
  std::vector<SimulationEvent> events;
  DriverInput input;

  RunningDrive() {
    input.accelerator = 0.35;
    for (int tick = 0; tick < 240; ++tick) step();
  }
  Snapshot step() {
    events.clear();
    return server_step(*model, input, state, events);
  }
};

void server_tick_200(benchmark::State& bench) {
  RunningDrive drive;
  for (auto _ : bench) benchmark::DoNotOptimize(drive.step());
  bench.counters["vehicles"] = static_cast<double>(capture_snapshot(*drive.model, drive.state).participants.size());
}
BENCHMARK(server_tick_200)->Name("server_tick/200")->Unit(benchmark::kMicrosecond);

/// Simulated over computed time: driver's car, simulated driver and traffic, without log and screens.
void server_realtime_factor(benchmark::State& bench) {
  const auto model = motorway_model();
  std::uint64_t ticks = 0;
  auto seat = open_driver_seat(rig::Car{}, "plain", 1, model);
  auto drive = LiveDrive::start(model, traffic::own_traffic(model->roads, 1), std::move(*seat), nullptr);
  for (auto _ : bench) {
    benchmark::DoNotOptimize((*drive)->next(std::nullopt));
    ++ticks;
  }
  bench.counters["times_real_time"] = benchmark::Counter(static_cast<double>(ticks) / tick_rate_hz, benchmark::Counter::kIsRate);
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
