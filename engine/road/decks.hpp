#pragma once
/// Bridges that files leave out: roads that lie over others.
///
/// Many files with roads on two levels name no <bridge> (OpenDRIVE 1.8, §13.8, leaves it to their author). A road whose
/// lanes lie more than `least_rise_m` over lanes, seen from above on one another, is carried there all the same.

#include "engine/road/road_network.hpp"

namespace septet::road {

/// Less than this over another lane is no bridge: nobody could drive below it.
inline constexpr double least_rise_m = 4.0;
/// Length of a deck beyond the lanes that it crosses.
inline constexpr double deck_beyond_m = 3.0;

/// Marks the bridges that have lanes below them, and adds a bridge wherever lanes have lanes below them and the file gives no
/// structure. A lane in a tunnel counts as earth. Needs the spatial index (road_locate.hpp).
void find_decks(RoadNetwork& network);

}  // namespace septet::road
