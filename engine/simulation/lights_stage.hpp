#pragma once
/// Traffic lights: the road file's signals that the scenario's controllers switch.
///
/// A function of simulated time (engine/scenario/model/signal_plan.hpp); nothing of it is state.

#include <optional>
#include <vector>

#include "engine/roadside/road_shape.hpp"
#include "engine/scenario/model/signal_plan.hpp"
#include "engine/simulation/model.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

/// The heads with signals named by a controller of the scenario, in the order of the road file; dark.
std::vector<SwitchedLight> switched_lights(const roadside::RoadShape& roads,
                                           const std::vector<scenario::SignalController>& controllers);

/// Lit lamps of a head at that time.
Lamps lamps_at(const Model& model, const SwitchedLight& light, double time_s);

/// All heads as they are lit at that time.
std::vector<TrafficLight> lit_heads(const Model& model, double time_s);

/// All heads at that tick, dated by the tick of the latest change; empty where there are none.
std::optional<EffectKeyframe> light_keyframe(const Model& model, Tick tick);

}  // namespace septet::simulation
