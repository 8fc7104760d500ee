#pragma once
/// Sight of one participant by another at an instant: straight, and in each mirror of the observer's vehicle.

#include <string>
#include <vector>

#include "sim-client/sight/observed_world.hpp"

namespace septet::sight {

struct RasterSettings {
  std::uint32_t longer_side = 64;     ///< Pixels along the longer side of a target's picture.
  std::uint32_t mirror_across = 160;  ///< Lines across a mirror's glass.
};

/// Straight sight, from the eyes taken last.
Sight straight_sight(const ObservedWorld& world, const Participant& target, const RasterSettings& settings);

struct MirrorSight {
  std::string mirror;
  Sight sight;  ///< Of the part of the target's image that lies in the glass; nearest_m counts from the mirror.
};

/// Sight in each mirror in whose glass the target has an image. The way from eye to glass is a part of the line.
std::vector<MirrorSight> mirror_sights(const ObservedWorld& world, const Participant& observer,
                                       const std::vector<Mirror>& mirrors, const Participant& target,
                                       const RasterSettings& settings);

}  // namespace septet::sight
