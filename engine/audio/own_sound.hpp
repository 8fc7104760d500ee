#pragma once
/// A block of the driver's own car: engine, exhaust, wind, tyres, rain, relay, horn, crash, and shaker.

#include "engine/audio/soundtrack.hpp"

namespace septet::audio {

/// `voices` has a place for each OwnVoice.
void render_own(OwnState& state, const CarSound& car, const OwnCar& heard, std::vector<Voice>& voices);

}  // namespace septet::audio
