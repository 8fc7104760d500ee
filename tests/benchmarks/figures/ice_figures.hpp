#pragma once
/// Figures of Seipel and Nivfors (2006) from Septet's own pictures and times.

#include <filesystem>

#include "engine/core/expected.hpp"

namespace septet::figures {

/// Figures 6 and 7 (frame rates) as SVG, and what the text of section 5 says of costs. Drawn in software, the paper's 1024 × 768. Times are of the
/// processor, the lower quartile of frames that the compared ways of drawing take in turn, so that what else runs there disturbs all of them.
Expected<void> draw_ice_times(const std::filesystem::path& folder);

/// Figures 1, 4 and 5 and the three objects as PNG, each as the paper shows it and where it adds something in the quality mode, too.
Expected<void> draw_ice_pictures(const std::filesystem::path& folder);

}  // namespace septet::figures
