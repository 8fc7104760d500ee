#include "sim-server/drive/motion_times.hpp"

#include <algorithm>
#include <map>
#include <variant>

namespace septet::server {
namespace {

using namespace scene;

bool is_from_now(const Command& command) {
  const auto* asked = std::get_if<MotionSet>(&command);
  return asked && asked->from_now;
}

using Pushed = std::function<std::optional<RigidTransform>(NodeId)>;

/// Where a batch has put its objects so far; of others pushes or the store tell it.
class PlacedObjects {
 public:
  PlacedObjects(const Store& store, const Pushed& pushed) : store_(store), pushed_(pushed) {}

  /// Null: there is no such object.
  ObjectData* find(NodeId object) {
    if (const auto known = placed_.find(object); known != placed_.end()) return &known->second;
    const Node* node = store_.find(object);
    const auto* stored = node ? std::get_if<ObjectData>(&node->data) : nullptr;
    if (!stored) return nullptr;
    ObjectData& data = placed_[object];
    data.transform = stored->transform, data.motion = stored->motion;
    if (const auto pose = pushed_ ? pushed_(object) : std::nullopt) {
      data.transform.position_m = pose->position_m, data.transform.rotation = pose->orientation;
      data.motion = {};
    }
    return &data;
  }

  void take(const Command& command) {
    if (const auto* created = std::get_if<NodeCreate>(&command)) {
      if (!find(created->node)) placed_[created->node] = {};
    } else if (const auto* placed = std::get_if<TransformSet>(&command)) {
      if (ObjectData* data = find(placed->node)) data->transform = placed->transform;
    } else if (const auto* moved = std::get_if<MotionSet>(&command)) {
      if (ObjectData* data = find(moved->node)) data->motion = moved->motion;
    }
  }

 private:
  const Store& store_;
  const Pushed& pushed_;
  std::map<NodeId, ObjectData> placed_;
};

RigidTransform pose_of(const ObjectData& data, double now_s) {
  if (!data.motion.legs.empty()) return pose_at(data.motion, now_s).world_from_object;
  return RigidTransform{data.transform.position_m, data.transform.rotation};
}

}  // namespace

void put_true_times(const Store& store, std::span<Command> batch, double now_s, const Pushed& pushed) {
  if (std::ranges::none_of(batch, is_from_now)) return;
  PlacedObjects objects(store, pushed);
  for (Command& command : batch) {
    auto* asked = std::get_if<MotionSet>(&command);
    const ObjectData* data = is_from_now(command) ? objects.find(asked->node) : nullptr;
    if (data) {  // Of no object the store refuses it.
      const RigidTransform pose = pose_of(*data, now_s);
      asked->from_now = false;
      asked->motion.position_m = pose.position_m;
      asked->motion.rotation = pose.orientation;
      for (MotionLeg& leg : asked->motion.legs) leg.from_s += now_s;
    }
    objects.take(command);
  }
}

}  // namespace septet::server
