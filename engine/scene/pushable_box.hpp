#pragma once
/// The box by which an object that can be pushed is met, seen from the object: so that a picture shows the object where
/// its box has come to.
///
/// Tags `participant` and `foot_m` of its group `body`, which the server sets (CONVENTIONS.md). Metres.

#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/math/rigid_transform.hpp"
#include "engine/scene/motion.hpp"
#include "engine/scene/node.hpp"

namespace septet::scene {

struct PushableBox {
  std::uint32_t participant = 0;  ///< The box's number in snapshots.
  Vec3 foot_m{0.0};               ///< Middle of its bottom from the object's origin, in the box's frame.
  bool operator==(const PushableBox&) const = default;
};

/// How an object's motion turns it.
enum class Turning : std::uint8_t {
  upright,  ///< Never, or about the vertical alone: its box turns with it.
  rolling,  ///< About one level axis: its box lies along that.
  any,
};
Turning turning_of(const Motion& motion);

/// Heading of the box of an object of this rotation and motion, as the box stands before the first leg.
double box_heading_rad(const Quat& rotation, const Motion& motion);

/// The object's pose where its box stands at `world_from_box`; `rotation` and `motion` are the object's own.
RigidTransform pose_by_box(const PushableBox& box, const RigidTransform& world_from_box, const Quat& rotation,
                           const Motion& motion);

/// The group, and its tags.
inline constexpr std::string_view solid_group = "body", solid_tag = "solid", mass_tag = "mass_kg",
                                  participant_tag = "participant", foot_tag = "foot_m";

/// Empty: the node's tags name no box.
std::optional<PushableBox> pushable_box(const Node& node);

}  // namespace septet::scene
