#pragma once
/// What becomes of a MiscObject (OpenSCENARIO XML 1.3): a breakable thing, a box that stands and can be hit, or paint on
/// the road.

#include "engine/scenario/model/entity.hpp"

namespace septet::scenario {

enum class ObjectForm : std::uint8_t {
  none,       ///< No object, or its box holds nothing.
  breakable,  ///< Its name is that of a part (engine/world/breakable_names.hpp): debris.
  flat,       ///< Its category lies on the road: there is nothing to run into.
  box,
};
ObjectForm object_form(const Entity& entity);

/// Heavier ones stand like a wall; a laden container of 20 feet may have 24 t.
inline constexpr double heaviest_pushed_kg = 20'000.0;

/// Mass of a box for impacts: the file's; infinite where the file gives none, where it is too heavy to be pushed, and
/// where its category is fixed in the ground (buildings, poles, trees, rails, …).
double pushed_kg(const Entity& box);

/// Middle of the bottom of the entity's box, seen from the entity's origin.
Vec3 foot_of_box_m(const Entity& entity);

}  // namespace septet::scenario
