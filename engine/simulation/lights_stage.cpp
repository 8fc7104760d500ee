#include "engine/simulation/lights_stage.hpp"

#include <algorithm>
#include <cmath>

#include "engine/roadside/signals.hpp"

namespace septet::simulation {

std::vector<SwitchedLight> switched_lights(const roadside::RoadShape& roads,
                                           const std::vector<scenario::SignalController>& controllers) {
  std::vector<SwitchedLight> lights;
  if (controllers.empty()) return lights;
  const auto is_named = [&](const std::string& signal) {
    return std::ranges::any_of(controllers, [&](const scenario::SignalController& controller) {
      return std::ranges::any_of(controller.phases, [&](const scenario::SignalPhase& phase) {
        return std::ranges::any_of(phase.states,
                                   [&](const scenario::SignalState& state) { return state.signal == signal; });
      });
    });
  };
  for (const roadside::StandingSignal& standing : roadside::standing_signals(roads)) {
    const bool walkers = standing.form == roadside::SignalForm::pedestrian_light;
    if ((!walkers && standing.form != roadside::SignalForm::light) || !is_named(standing.signal->id)) continue;
    if (lights.size() >= most_traffic_lights) break;
    SwitchedLight& light = lights.emplace_back();
    light.signal = standing.signal->id;
    light.head.road = standing.road;
    light.head.s_m = standing.signal->s_m;
    light.head.along_s = roadside::direction_of(roads.road(standing.road), *standing.signal) > 0;
    light.head.for_walkers = walkers;
    // Placed as the scenery hangs it.
    light.head.world_from_light =
        standing.world_from_signal * RigidTransform{Vec3(-0.06, 0.0, standing.bottom_m), Quat(1, 0, 0, 0)};
  }
  return lights;
}

Lamps lamps_at(const Model& model, const SwitchedLight& light, double time_s) {
  const scenario::SignalState* state = scenario::signal_state_at(model.scenario.signals, light.signal, time_s);
  return state ? state->lamps : Lamps{};
}

std::vector<TrafficLight> lit_heads(const Model& model, double time_s) {
  std::vector<TrafficLight> heads;
  heads.reserve(model.lights.size());
  for (const SwitchedLight& light : model.lights) {
    heads.push_back(light.head);
    heads.back().lamps = lamps_at(model, light, time_s);
  }
  return heads;
}

std::optional<EffectKeyframe> light_keyframe(const Model& model, Tick tick) {
  if (model.lights.empty()) return std::nullopt;
  const double time_s = static_cast<double>(tick) / tick_rate_hz;
  double since_s = 0.0;
  for (const scenario::SignalController& controller : model.scenario.signals)
    since_s = std::max(since_s, scenario::phase_at(controller, time_s).since_s);
  EffectKeyframe keyframe;
  keyframe.id = traffic_light_effect_id;
  keyframe.kind = traffic_light_keyframe_kind;
  keyframe.data = encode_traffic_lights(lit_heads(model, time_s));
  constexpr double slack = 1e-3;
  keyframe.tick = std::min(tick, static_cast<Tick>(std::ceil(std::clamp(since_s, 0.0, time_s) * tick_rate_hz - slack)));
  return keyframe;
}

}  // namespace septet::simulation
