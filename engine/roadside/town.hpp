#pragma once
/// Which stretches of road lie in a town: kerbs and lawns instead of ditches, houses and lamps beside them, no marker posts.
///
/// A road says so by its type (OpenDRIVE 1.8, §8.3 with e_roadType: town and what belongs to it); one without a type by its pavements; one
/// within a junction by the roads that lead into it.

#include "engine/road/road_network.hpp"

namespace septet::roadside {

bool is_in_town(const road::RoadNetwork& network, road::RoadIndex road, double s_m);

}  // namespace septet::roadside
