#include "sim-server/drive/motion_times.hpp"

#include <cstddef>
#include <optional>
#include <variant>

namespace septet::server {
namespace {

using namespace scene;

/// Of an object at a time, by what `batch` and the store say of it; none: there is no such object.
std::optional<RigidTransform> pose_of(NodeId object, const Store& store, std::span<const Command> batch, double now_s) {
  ObjectData data;
  const Node* node = store.find(object);
  const auto* known = node ? std::get_if<ObjectData>(&node->data) : nullptr;
  bool is_there = known != nullptr;
  if (known) data.transform = known->transform, data.motion = known->motion;
  for (const Command& command : batch) {
    if (const auto* created = std::get_if<NodeCreate>(&command); created && created->node == object) is_there = true;
    if (const auto* placed = std::get_if<TransformSet>(&command); placed && placed->node == object)
      data.transform = placed->transform;
    if (const auto* moved = std::get_if<MotionSet>(&command); moved && moved->node == object)
      data.motion = moved->motion;
  }
  if (!is_there) return std::nullopt;
  if (!data.motion.legs.empty()) return pose_at(data.motion, now_s).world_from_object;
  return RigidTransform{data.transform.position_m, data.transform.rotation};
}

}  // namespace

void put_true_times(const Store& store, std::span<Command> batch, double now_s) {
  for (std::size_t i = 0; i < batch.size(); ++i) {
    auto* asked = std::get_if<MotionSet>(&batch[i]);
    if (!asked || !asked->from_now) continue;
    const auto pose = pose_of(asked->node, store, batch.first(i), now_s);
    if (!pose) continue;  // The store refuses it.
    asked->from_now = false;
    asked->motion.position_m = pose->position_m;
    asked->motion.rotation = pose->orientation;
    for (MotionLeg& leg : asked->motion.legs) leg.from_s += now_s;
  }
}

}  // namespace septet::server
