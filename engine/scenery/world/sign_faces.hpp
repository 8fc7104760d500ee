#pragma once
/// Faces of traffic signs, painted with readable text. sRGB, straight alpha.

#include <string>
#include <vector>

#include "engine/image/image.hpp"

namespace septet::scenery {

struct SignLine {
  std::string place;
  int distance_km = 0;
};

/// Blue motorway sign with places and distances, 256 × 104.
image::Image direction_sign(std::string_view route, const std::vector<SignLine>& lines);

/// "Rest area 1 000 m" with a P, 256 × 104.
image::Image rest_area_sign(int distance_m);

/// Speed display above a lane: red ring and number on black, 64 × 64.
image::Image speed_display(int limit_kmh);

}  // namespace septet::scenery
