#pragma once
/// Figures 2 to 7 and 9 to 13 of Gustavsson, Engström and Gustavsson, "A multi-sampling approach for smoke behavior in real-time
/// graphics" (SIGRAD 2006), from Septet's own functions, as SVG.

#include <filesystem>

#include "engine/core/expected.hpp"

namespace septet::figures {

/// Figures 2 to 7, the sampling: `smoke-sampling.svg`. Figure 8 is `biased_sample` of bias_texture.hpp.
Expected<void> draw_smoke_sampling(const std::filesystem::path& folder);
/// Figures 9 to 13, the room over time, by the published update and by Septet's: `smoke-room.svg`.
Expected<void> draw_smoke_room(const std::filesystem::path& folder);

}  // namespace septet::figures
