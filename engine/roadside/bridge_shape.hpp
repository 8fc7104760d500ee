#pragma once
/// A road bridge's deck across the road: what is drawn, and where icicles hang.

namespace septet::roadside::bridge_shape {

inline constexpr double overhang_m = 1.4;     ///< Of the deck beyond the asphalt.
inline constexpr double edge_foot_m = -0.45;  ///< Lower rim of its edge beams, over the road.

}  // namespace septet::roadside::bridge_shape
