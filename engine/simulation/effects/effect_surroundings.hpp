#pragma once
/// Surroundings of debris: the road's surface, vehicles, and obstacles beside the road, as planes and boxes.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/effects/debris/debris_state.hpp"
#include "engine/simulation/effects/effects_state.hpp"

namespace septet::simulation {

/// The surface at a place, with the memory that makes repeated queries cheap.
debris::GroundPoint surface_below(const road::RoadNetwork& roads, double friction_factor, double x_m, double y_m,
                                  EffectsState& state);

/// The vehicles that debris may touch within the step; `driver_box` is the index of the driver's car among them, or −1.
std::vector<debris::Box> vehicle_boxes(const EffectsWorld& world, const debris::State& debris, int& driver_box);

/// Places of moving debris, near which barriers matter.
std::vector<Vec3> moving_places(const debris::State& debris);

/// Obstacles beside the road within seven metres of any of the places; empty without `obstacles`. `gone` as of Obstacles::near.
std::vector<debris::Box> standing_boxes(const roadside::Obstacles* obstacles, std::span<const std::uint32_t> gone,
                                        const std::vector<Vec3>& places);

}  // namespace septet::simulation
