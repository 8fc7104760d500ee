#pragma once
/// The upright box in the place of an object of the scene that can be hit: one with the boolean tag `solid` of its group
/// `body` (CONVENTIONS.md).
///
/// The box heads as the object does and holds all that is drawn of it and of what hangs below it, each geometry by its
/// own bounds: exact for what stands upright, large enough for what leans. What rolls about a level axis is held in all
/// its turns by a box along that axis; what turns otherwise, by a cube about its origin. Metres, world frame.

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/scene/motion.hpp"
#include "engine/scene/pushable_box.hpp"
#include "engine/scene/store.hpp"

namespace septet::scene {

struct SolidBox {
  Vec3 foot_m{0.0};          ///< Middle of its bottom.
  double heading_rad = 0.0;  ///< Of its length, counter-clockwise from x.
  Vec3 size_m{0.0};          ///< Along the heading, to its left, up; 0 along an axis on which all is flat.
  bool operator==(const SolidBox&) const = default;
};

/// A node, and its drawn revision as it was read.
using ReadNode = std::pair<NodeId, std::uint64_t>;

struct ReadSolid {
  std::optional<SolidBox> box;    ///< Empty: it is hidden, or there is nothing to be seen of it.
  Vec3 about_m{0.0};              ///< What the box turns about: the object's origin.
  std::vector<MotionLeg> legs;    ///< The box's: about the vertical, or turning not at all. `box` is before the first.
  std::optional<double> mass_kg;  ///< Empty: it stands fast, or goes its way whatever it meets.
  std::vector<ReadNode> read_from;  ///< What the box depends on.
};

/// Range of the tag `mass_kg`.
inline constexpr double lightest_solid_kg = 0.1, heaviest_solid_kg = 20'000.0;
/// True for an object whose tag says that it can be hit.
bool is_tagged_solid(const Node& node);

/// `object` is tagged. Error: it is a prototype, has too many parts, or its mass is no number of that range.
Expected<ReadSolid> read_solid(const Store& store, NodeId object);

/// True where nothing has changed since.
bool is_as_read(const Store& store, const std::vector<ReadNode>& read_from);

/// The lowest object that has this one as its child, if there is one.
std::optional<NodeId> parent_of(const Store& store, NodeId child);

}  // namespace septet::scene
