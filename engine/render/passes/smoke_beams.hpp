#pragma once
/// Headlights' light in smoke, dimmed by the smoke that it has crossed.

#include <span>
#include <vector>

#include "engine/instant/frame_input.hpp"
#include "engine/instant/participants.hpp"

namespace septet::render {

using instant::Headlight, instant::SmokePuff;

/// Illuminance that beams bring to the middle of each puff, of a surface that faces the lamp: sums over the lamps nearest to the eye.
std::vector<glm::vec3> light_of_beams(std::span<const SmokePuff> puffs, std::span<const Headlight> headlights,
                                      const Vec3& eye_m);

}  // namespace septet::render
