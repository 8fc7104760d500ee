#pragma once
/// Cross-section of a road tunnel's tubes, one on either side of its axis, for their drawing, for cars that run against
/// them, and for smoke that fills them.

namespace septet::roadside::tunnel_shape {

inline constexpr double wall_clear_m = 0.5;    ///< Distance from the asphalt's edge to the wall.
inline constexpr double middle_wall_m = 0.35;  ///< Half the thickness of the wall between the tubes.
/// Heights over the road: of the ceiling, and of its lower edge along the wall; the ceiling slopes over
/// `haunch_width_m`.
inline constexpr double ceiling_m = 6.6, haunch_m = 5.0, haunch_width_m = 1.9;

inline constexpr double portal_before_m = 0.25;  ///< Distance of the portal's face before the mouth.
inline constexpr double portal_out_m = 46.0;     ///< Reach of a portal's wing walls beyond the asphalt.

}  // namespace septet::roadside::tunnel_shape
