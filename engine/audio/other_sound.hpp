#pragma once
/// A block of somebody else: tyres, engine, siren, horn, blows, through the wall of the driver's car.

#include "engine/audio/soundtrack.hpp"

namespace septet::audio {

void begin_other(OtherState& state, const OtherSound& sound, std::uint32_t first_seed, std::uint32_t second_seed);
/// Of `state.last`; silence at its end where it is leaving.
void render_other(OtherState& state, Voice& voice);

}  // namespace septet::audio
