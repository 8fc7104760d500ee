#include "engine/world/participant_shape.hpp"

#include <doctest/doctest.h>

#include "engine/world/participant_quantisation.hpp"
#include "tests/relative.hpp"

namespace septet {

TEST_CASE("a box of any size comes through the wire as large as it is") {
  for (const Vec3& size_m :
       {Vec3(0.05, 0.1, 0.12), Vec3(0.6, 0.6, 1.1), Vec3(12.2, 2.44, 2.6), Vec3(900.0, 0.3, 3.0)}) {
    Participant box;
    box.model = box_model();
    set_box_size(size_m, box);
    WireParticipant wire;
    quantise(box, wire);
    const Participant sent = dequantise(wire);
    REQUIRE(is_box(sent));
    const VehicleModel shape = shape_of(sent);
    CHECK(shape.length_m == relative(size_m.x, 2e-4));
    CHECK(shape.width_m == relative(size_m.y, 2e-4));
    CHECK(shape.height_m == relative(size_m.z, 2e-4));
    CHECK(shape.centre_x_m() == 0.0);
    CHECK(shape.front_m() == relative(0.5 * size_m.x, 2e-4));
  }
}

TEST_CASE("all others measure what their model does") {
  for (ModelIndex model = 0; model < vehicle_models().size(); ++model) {
    if (model == box_model()) continue;
    Participant one;
    one.model = model;
    one.wheel_lift_m = {0.01, 0.02, 0.03, 0.04};
    CHECK_FALSE(is_box(one));
    CHECK(shape_of(one).name == vehicle_models()[model].name);
    CHECK(shape_of(one).length_m == vehicle_models()[model].length_m);
  }
}

}  // namespace septet
