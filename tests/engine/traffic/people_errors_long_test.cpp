/// What comes of errors of people in an hour of a town; docs/town.md has the figures.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <doctest/doctest.h>

#include "tests/conformance/conformance_data.hpp"
#include "tests/engine/traffic/lit_town.hpp"
#include "tests/engine/traffic/public_town.hpp"
#include "tests/shipped_files.hpp"

namespace septet::traffic {
namespace {

struct Came {
  std::array<std::uint32_t, people_error_names.size()> begun{};
  std::uint32_t near = 0, touched = 0;  ///< Of overlooks: two have passed nearer than two metres; touched.
  TownRun run;
};

Came hour_of(const LitTown& town, std::uint32_t count, const PeopleErrorRates& rates) {
  TrafficParameters parameters = motorway_traffic(count, 3000.0);
  parameters.errors = rates;
  Came came;
  std::size_t heard = 0;
  const auto hear = [&](const TownState& now, const std::vector<Participant>&) {
    for (; heard < now.errors.told.size(); ++heard) {
      const ToldError& told = now.errors.told[heard];
      if (!told.end) ++came.begun[static_cast<std::size_t>(told.kind)];
      came.touched += told.end == ErrorEnd::touched;
      came.near += told.end == ErrorEnd::parted && told.nearest_m.value_or(1e9) < 2.0;
    }
  };
  came.run = run_town(town.network, town.graph, parameters, 3600.0, 11, 1.0 / 30.0, {}, hear, town.lights_at);
  return came;
}

void check_hour(const std::string& name, const LitTown& town, std::uint32_t count) {
  CAPTURE(name);
  const auto rates = read_error_rates("overlook=6 late_brake=20 telephone=10 red=2");
  REQUIRE(rates.has_value());
  for (const PeopleErrorRates& each : {PeopleErrorRates{}, *rates}) {
    const Came came = hour_of(town, count, each);
    const double hours = came.run.vehicle_s / 3600.0;
    std::string begun;
    for (std::size_t kind = 0; kind < people_error_names.size(); ++kind)
      begun += std::string(people_error_names[kind]) + ' ' + std::to_string(came.begun[kind]) + ", ";
    MESSAGE(name << ", " << hours << " vehicle-hours: begun " << begun << "near misses " << came.near << ", touched "
                 << came.touched << ", overlapped " << came.run.overlaps.size() << ", reds " << came.run.reds << " of "
                 << came.run.lit_lines << ", hard brakings " << came.run.hard_brakings << ", " << came.run.mean_mps()
                 << " m/s, longest stand " << came.run.longest_stand_s << " s");
    CHECK((came.begun[0] > 0) == each.any());
    CHECK((came.begun[1] > 0) == each.any());
    CHECK(came.begun[2] > (each.any() ? 5.0 * hours : -1.0));
    CHECK(came.begun[2] < (each.any() ? 15.0 * hours : 1.0));
    CHECK(came.run.longest_stand_s < 300.0);
  }
}

}  // namespace

TEST_CASE("in an hour of a town people err at their rates, and without a rate never") {
  check_hour("Town03", walled_town(public_town("Town03")), 40);
  const auto path = conformance_data("roads") / "multi_intersections.xodr";
  auto network = road::read_opendrive(text_of(path), path.string());
  REQUIRE(network.has_value());
  check_hour("multi_intersections", walled_town(std::move(*network)), 40);
  check_hour("scenarios/town", shipped_town(), 60);
}

}  // namespace septet::traffic
