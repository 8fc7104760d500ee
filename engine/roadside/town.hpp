#pragma once
/// Stretches of road in a town: kerbs and lawns instead of ditches, houses and lamps beside them, no marker posts.
///
/// A road's type decides (OpenDRIVE 1.8, §8.3 with e_roadType: town and its variants, lowSpeed, pedestrian, bicycle);
/// for a road without a type its pavements; for one within a junction the roads that lead into it.

#include "engine/road/road_network.hpp"

namespace septet::roadside {

bool is_in_town(const road::RoadNetwork& network, road::RoadIndex road, double s_m);

}  // namespace septet::roadside
