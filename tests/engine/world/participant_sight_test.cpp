#include "engine/world/participant_sight.hpp"

#include <doctest/doctest.h>

namespace septet {
namespace {

Participant at_ease(std::string_view model) {
  Participant body;
  body.model = *find_vehicle_model(model);
  body.world_from_vehicle = {{100.0, 20.0, 5.0}, orientation_from_angles(1.5707963267948966, 0.0, 0.0)};
  return body;
}

}  // namespace

TEST_CASE("a car hides what is behind it up to its windows, a van to its roof, and who walks or rides hides nothing") {
  const auto top_m = [](std::string_view model) {
    const auto box = opaque_box_of(at_ease(model));
    return box ? (box->world_from_box * Vec3(0.0, 0.0, box->half_m.z)).z - 5.0 : 0.0;
  };
  CHECK(top_m("saloon") == doctest::Approx(0.93));
  CHECK(top_m("van") == doctest::Approx(2.55));
  CHECK(top_m("lorry") == doctest::Approx(3.85));
  for (const auto* model : {"pedestrian", "bicycle", "motorcycle"})
    CHECK_FALSE(opaque_box_of(at_ease(model)).has_value());
}

TEST_CASE("a participant's box lies around its body from bumper to bumper") {
  const sight::Box box = box_of(at_ease("saloon"));  // Looks along y.
  const Vec3 front = box.world_from_box * Vec3(box.half_m.x, 0.0, box.half_m.z);
  CHECK(front.x == doctest::Approx(100.0));
  CHECK(front.y == doctest::Approx(20.0 + 4.62 - 0.98));
  CHECK(front.z == doctest::Approx(5.0 + 1.44));
}

}  // namespace septet
