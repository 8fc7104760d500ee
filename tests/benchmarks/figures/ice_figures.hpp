#pragma once
/// Figures of Seipel and Nivfors (2006) from Septet's own pictures and times.

#include <filesystem>

#include "engine/core/expected.hpp"

namespace septet::figures {

/// Figures 6 and 7 (frame rates) as SVG, and the costs named in the text of section 5. Drawn in software, at the
/// paper's 1024 × 768. Times are processor times, the lower quartile of frames that the compared methods draw in turn,
/// so that other load disturbs all of them alike.
Expected<void> draw_ice_times(const std::filesystem::path& folder);

/// Figures 1, 4 and 5 and the three objects as PNG, each as in the paper and, if it differs, also in the quality mode.
Expected<void> draw_ice_pictures(const std::filesystem::path& folder);

}  // namespace septet::figures
