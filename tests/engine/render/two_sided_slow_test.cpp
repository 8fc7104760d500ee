/// Drawn sides of a surface: the counterpart of tests/engine/raytrace/two_sided_test.cpp. Software device, validation
/// layer on.

#include <doctest/doctest.h>

#include "engine/render/renderer.hpp"
#include "tests/engine/instant/two_sided_plate.hpp"

namespace septet::render {
namespace {

/// Radiance in the middle of a picture with the plate, and without it.
struct Seen {
  glm::vec3 plate{0.0f}, behind{0.0f};
};

Seen seen(const instant::PlateLook& look) {
  Seen result;
  for (const bool there : {true, false}) {
    Renderer renderer = *Renderer::create({64, 64, DevicePreference::software, true, Antialiasing::none, nullptr});
    REQUIRE(renderer.upload(instant::plate_scene(look, there)).has_value());
    FrameInput input;
    input.environment = instant::plate_day();
    input.views = {instant::plate_view(64)};
    input.views[0].mirrored = look.in_a_mirror;
    REQUIRE(renderer.draw(input).has_value());
    CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
    (there ? result.plate : result.behind) = renderer.read_radiance()->at(32, 30);
  }
  return result;
}

}  // namespace

TEST_CASE("the back of a plate is drawn where its material is two-sided and is not there otherwise") {
  for (const bool in_a_mirror : {false, true}) {
    CAPTURE(in_a_mirror);
    const Seen back = seen({.two_sided = false, .from_behind = true, .in_a_mirror = in_a_mirror});
    CHECK(glm::length(back.plate - back.behind) < 1e-3f * glm::length(back.behind));
    const Seen front = seen({.two_sided = false, .from_behind = false, .in_a_mirror = in_a_mirror}),
               both_front = seen({.two_sided = true, .from_behind = false, .in_a_mirror = in_a_mirror}),
               both_back = seen({.two_sided = true, .from_behind = true, .in_a_mirror = in_a_mirror});
    CHECK(glm::length(front.plate - front.behind) > 0.05f * glm::length(front.behind));
    // The back is lit as a front there would be.
    CHECK(glm::length(both_front.plate - front.plate) < 1e-3f * glm::length(front.plate));
    CHECK(glm::length(both_back.plate - front.plate) < 2e-2f * glm::length(front.plate));
  }
}

TEST_CASE("what has holes and what is seen through shows its back without being two-sided") {
  for (const instant::PlateLook look : {instant::PlateLook{.two_sided = false, .from_behind = true, .opacity = 0.5f},
                                        instant::PlateLook{.two_sided = false, .from_behind = true, .holes = true}}) {
    const Seen back = seen(look);
    CHECK(glm::length(back.plate - back.behind) > 0.02f * glm::length(back.behind));
  }
}

}  // namespace septet::render
