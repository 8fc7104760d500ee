#pragma once
/// Cross-section of a road bridge's deck, for its drawing and for the icicles that hang from it.

namespace septet::roadside::bridge_shape {

inline constexpr double overhang_m = 1.4;     ///< Overhang of the deck beyond the asphalt.
inline constexpr double edge_foot_m = -0.45;  ///< Lower rim of its edge beams, relative to the road.

}  // namespace septet::roadside::bridge_shape
