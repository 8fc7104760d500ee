#pragma once
/// A block of another participant: tyres, engine, siren, horn, impacts, through the wall of the driver's car.

#include <cstdint>
#include <span>

#include "engine/audio/soundtrack.hpp"

namespace septet::audio {

void begin_other(OtherState& state, const OtherSound& sound, std::uint32_t first_seed, std::uint32_t second_seed);
/// Renders each one's `last`; fades out where it is leaving. `voices` are as many, in the same order.
void render_others(std::span<OtherState* const> states, std::span<Voice> voices);

}  // namespace septet::audio
