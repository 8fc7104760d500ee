#include <doctest/doctest.h>

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

}  // namespace septet::frame
