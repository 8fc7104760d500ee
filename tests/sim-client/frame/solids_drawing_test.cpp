#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/world/participant_shape.hpp"
#include "engine/world/solid.hpp"
#include "sim-client/frame/client_frame.hpp"

namespace septet::frame {

TEST_CASE("a box of the scenario is drawn as a participant, and a solid by the scene alone") {
  scene::ResolvedScene scene;
  scene.prototypes.emplace_back().name = vehicle_models()[box_model()].name;
  Snapshot shown;
  for (const ParticipantId id :
       {ParticipantId{2}, first_solid_participant, first_solid_participant + most_solids - 1}) {
    Participant box;
    box.id = id;
    box.model = box_model();
    set_box_size({4.0, 0.5, 2.0}, box);
    shown.participants.push_back(box);
  }
  const instant::FrameInput frame = client_frame(shown, {}, {}, scene);
  REQUIRE(frame.participants.size() == 1);
  CHECK(frame.participants.front().number == 2);
}

TEST_CASE("a thing with a mass is drawn by its motion until its box is free, and then where the box is") {
  scene::ResolvedScene scene;
  scene::Prototype& ball = scene.prototypes.emplace_back();
  ball.motion = {{10.0, 0.0, 0.5}, {1.0, 0.0, 0.0, 0.0}, {{.velocity_mps = {0.0, 2.0, 0.0}}}};
  ball.number = 7;
  ball.box = {first_solid_participant + 4, {0.0, 0.0, -0.5}};
  Snapshot shown;
  shown.simulated_time_s = 3.0;
  Participant& box = shown.participants.emplace_back();
  box.id = first_solid_participant + 4;
  box.model = box_model();
  box.world_from_vehicle.position_m = {40.0, 5.0, 0.25};
  for (const bool free : {false, true}) {
    box.lamps.set(Lamp::brake, free);
    const instant::FrameInput frame = client_frame(shown, {}, {}, scene);
    REQUIRE(frame.participants.size() == 1);
    CHECK(frame.participants.front().number == 7);
    const Vec3 at_m = frame.participants.front().world_from_vehicle.position_m;
    CHECK(glm::distance(at_m, free ? Vec3(40.0, 5.0, 0.75) : Vec3(10.0, 6.0, 0.5)) < 1e-9);
  }
}

}  // namespace septet::frame
