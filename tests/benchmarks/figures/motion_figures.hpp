#pragma once
/// Figures and tables of two papers of SIGRAD 2006 from Septet's own functions, as SVG: Hast, Barrera and Bengtsson
/// (incremental spherical interpolation) and Parus, Hast and Kolingerová (temporal face normals).

#include <filesystem>

#include "engine/core/expected.hpp"

namespace septet::figures {

/// Figures 1 to 3, and a turn that slows down: `turning.svg`.
Expected<void> draw_turns(const std::filesystem::path& folder);
/// Figure 1 (a moving face), figures 2 and 3 as the angle by which each method errs over time, tables 1 and 2:
/// `normals.svg`. Times are processor times.
Expected<void> draw_normals(const std::filesystem::path& folder);

}  // namespace septet::figures
