#include "engine/traffic/looks.hpp"

#include <cstddef>
#include <map>
#include <set>
#include <string_view>

#include <doctest/doctest.h>

#include "engine/traffic/traffic.hpp"
#include "engine/world/vehicle_body.hpp"
#include "tests/relative.hpp"

namespace septet::traffic {

// Of heights each look has its own, which is met and drawn: traffic drives in plan.
TEST_CASE("what a vehicle looks like has the outline, the axles and the mass of what drives") {
  for (ModelIndex model = 0; model < vehicle_models().size(); ++model)
    for (ParticipantId id = 0; id < 2000; ++id) {
      const VehicleModel &drives = vehicle_models()[model], &shown = vehicle_models()[look_of(model, id)];
      CAPTURE(shown.name);
      REQUIRE(shown.length_m == drives.length_m);
      REQUIRE(shown.width_m == drives.width_m);
      REQUIRE(shown.wheelbase_m == drives.wheelbase_m);
      REQUIRE(shown.rear_overhang_m == drives.rear_overhang_m);
      REQUIRE(shown.track_m == drives.track_m);
      REQUIRE(shown.wheel_radius_m == drives.wheel_radius_m);
      REQUIRE(vehicle_body(shown.kind).mass_kg == vehicle_body(drives.kind).mass_kg);
      REQUIRE(vehicle_body(shown.kind).clearance_m == vehicle_body(drives.kind).clearance_m);
    }
}

TEST_CASE("a motorway's traffic shows twenty and more shapes, as often as their shares say") {
  std::map<std::string_view, int> seen;
  std::set<ModelIndex> shapes;
  const TrafficParameters parameters = motorway_traffic(200, 1500.0);
  for (const VehicleClass& kind : parameters.classes)
    for (ParticipantId id = 1000; id < 3000; ++id) {
      const ModelIndex look = look_of(kind.model, id);
      shapes.insert(look);
      ++seen[vehicle_models()[look].name];
    }
  CHECK(shapes.size() >= 20);
  CHECK(seen["taxi"] == relative(200, 0.25));
  CHECK(seen["city-articulated"] == relative(520, 0.15));
  CHECK(seen["saloon"] == relative(1500, 0.1));
  CHECK(look_of(5, 1234) == look_of(5, 1234));
}

}  // namespace septet::traffic
