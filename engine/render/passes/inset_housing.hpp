#pragma once
/// Housing of a mirror whose picture lies over another view: a frame with rounded edges, and its foot on the nearest
/// edge of the screen. It is drawn over the finished picture, with the text.

#include <cstdint>
#include <vector>

#include "engine/instant/instant.hpp"
#include "engine/light/records.hpp"

namespace septet::render {

/// Housings of all views of the instant that have one, for a target of that size in pixels; mirrors too small for a
/// frame get no housing.
std::vector<light::QuadConstants> inset_housings(const instant::Instant& instant, std::uint32_t width,
                                                 std::uint32_t height);

}  // namespace septet::render
