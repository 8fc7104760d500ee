/// What stands in a shipped world is what the scene draws there.

#include <doctest/doctest.h>

#include "engine/roadside/parked_cars.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "sim-server/drive/standing_things.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {

TEST_CASE("each thing beside the roads that can be gone has its object in the generated world, at its very place") {
  for (const char* scenario : {"behind-ambulance", "town"}) {
    CAPTURE(scenario);
    const LoadedDrive drive = shipped_drive(scenario, "desktop");
    const simulation::Model& model = *drive.model;
    scene::Store store;
    scene::SceneBuilder builder(store);
    scenery::build_vehicles(builder, nullptr,
                            roadside::parked_cars({model.roads, roadside::usual_overrun_m}, model.seed));
    scenery::build_road_world(builder, model.roads, model.seed, {.raised = model.raised.get()});
    const StandingThings things(store, *model.obstacles);
    CHECK(model.obstacles->things() > 100);
    CHECK(things.size() == model.obstacles->things());
  }
}

}  // namespace septet::server
