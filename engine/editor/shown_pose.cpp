#include "engine/editor/shown_pose.hpp"

#include <variant>

#include <glm/gtc/quaternion.hpp>

#include "engine/scene/motion.hpp"
#include "engine/scene/pushable_box.hpp"
#include "engine/world/solid.hpp"

namespace septet::editor {

RigidTransform shown_pose(const scene::Node& node, const Snapshot& snapshot) {
  const auto& object = std::get<scene::ObjectData>(node.data);
  const bool moves = !object.motion.legs.empty();
  if (const auto box = scene::pushable_box(node)) {
    const Participant* pushed = find_participant(snapshot, box->participant);
    const Quat& rotation = moves ? object.motion.rotation : object.transform.rotation;
    if (pushed && is_free_solid(*pushed))
      return scene::pose_by_box(*box, pushed->world_from_vehicle, glm::normalize(rotation), object.motion);
  }
  if (moves) return scene::pose_at(object.motion, snapshot.simulated_time_s).world_from_object;
  return {object.transform.position_m, object.transform.rotation};
}

}  // namespace septet::editor
