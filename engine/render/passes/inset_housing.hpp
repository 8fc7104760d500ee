#pragma once
/// The housing of a mirror whose picture lies over another view: a frame with rounded edges, and its foot on the edge of
/// the screen that it is near. Drawn over the finished picture, with the text.

#include <cstdint>
#include <vector>

#include "engine/instant/instant.hpp"
#include "engine/light/records.hpp"

namespace septet::render {

/// Of all views of the instant that are housed, for a target of that size in pixels; none of one too small to have an
/// edge.
std::vector<light::QuadConstants> inset_housings(const instant::Instant& instant, std::uint32_t width,
                                                 std::uint32_t height);

}  // namespace septet::render
