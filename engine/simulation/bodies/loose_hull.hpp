#pragma once
/// Loose bodies against what stands beside the road, as the driver's car meets it (engine/physics/vehicle/hull.hpp).

#include <cstdint>
#include <span>
#include <vector>

#include "engine/simulation/bodies/bodies_state.hpp"
#include "engine/simulation/model.hpp"

namespace septet::simulation {

/// True while an obstacle presses it, or its impact is not told yet.
bool is_engaged(const LooseBody& loose);

/// All that it may reach within a tick, but for things that are `gone` (roadside::Obstacles::near).
std::vector<Obstacle> obstacles_near(const Model& model, std::span<const std::uint32_t> gone, const LooseBody& loose);

/// Call it after each of its steps. `due`: to it by contacts with others. Appends to `report`.
void meet_obstacles(std::span<const Obstacle> obstacles, double dt_s, const impact::Due& due, LooseBody& loose,
                    vehicle::HullReport& report);

}  // namespace septet::simulation
