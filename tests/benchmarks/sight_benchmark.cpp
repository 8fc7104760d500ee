// Who is unobstructed for whom, on one core: instants a second of six pairs both ways, with mirrors, among the
// motorway's traffic. 30 s of a session are 300 instants.
#include <stdexcept>

#include <benchmark/benchmark.h>

#include "sim-client/sight/pair_sight.hpp"
#include "tests/images/motorway_view.hpp"

namespace septet::sight {
namespace {

constexpr std::size_t pairs = 6;

void six_pairs(benchmark::State& state) {
  const Motorway motorway;
  const Snapshot world = motorway.snapshot({"", 800.0, 0.0, false, false});
  const Participant& car = world.participants.back();
  const SceneParts parts(motorway.scene());
  const auto standing = StandingWorld::create(parts, car.world_from_vehicle.position_m);
  if (!standing) throw std::runtime_error(describe(standing.error()));
  auto observed = ObservedWorld::create(parts, **standing);
  if (!observed) throw std::runtime_error(describe(observed.error()));
  const DriverSeat seat{Vec3(1.35, 0.37, 1.17), std::nullopt};
  const auto look_at = [&](const Participant& observer, const Participant& target) {
    benchmark::DoNotOptimize(straight_sight(*observed, target, {}));
    benchmark::DoNotOptimize(mirror_sights(*observed, observer, mirrors_of(observer, world, seat), target, {}));
  };
  for (auto unused : state) {
    observed->take(world);
    observed->look_from(car.id, seat);
    for (std::size_t n = 0; n < pairs; ++n) look_at(car, world.participants[n]);
    for (std::size_t n = 0; n < pairs; ++n) {
      observed->look_from(world.participants[n].id, seat);
      look_at(world.participants[n], car);
    }
  }
  state.counters["instants"] = benchmark::Counter(double(state.iterations()), benchmark::Counter::kIsRate);
}

BENCHMARK(six_pairs)->Name("sight/six_pairs")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace septet::sight
