#pragma once
/// Channels of an OpenEXR picture of a traced frame beside its light, and the picture made of a frame's pixels.
///
/// R, G, B are linear Rec. 709 after exposure, 1 being white; the header's whiteLuminance gives that in cd/m². FILM.md
/// has the table of the layers and of the header.

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "engine/exr/exr.hpp"
#include "sim-client/film/traced/messages.hpp"

namespace septet::film {

/// Parses "depth,normal" or "all" into the set. Returns the fault, or an empty string.
std::string read_layers(const std::string& text, std::set<Layer>& layers);
/// Names of the layers, in the form of read_layers.
std::string layers_text(const std::set<Layer>& layers);

/// Facts of the session and the frame for the header, beside those that each tile carries (FrameFacts).
struct ExrFacts {
  std::string septet, session, drive_seeds;
  double ticks_per_second = 120.0, frames_per_second = 25.0;
  std::uint64_t frame = 0;  ///< Its number, also the seed of its noise.
  std::uint32_t samples = 0;
};

exr::Picture exr_picture(const raytrace::TracedPicture& traced, const FrameFacts& facts, const ExrFacts& more,
                         ExrNumbers numbers, const std::set<Layer>& layers);

}  // namespace septet::film
