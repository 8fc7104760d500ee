#include "sim-client/frame/effects_drawing.hpp"

namespace septet::frame {

void EffectsDrawing::show(const Snapshot& instant, const TickHistory& history, double tick_s,
                          const scene::ResolvedScene& scene) {
  const double simulated_time_s = instant.simulated_time_s;
  debris_shown_ = debris_.draw(effects_at(history, simulated_time_s, tick_s), simulated_time_s / tick_s, scene,
                               instant.environment.temperature_k);
  dents_.show(instant, scene);
  ice_.show(instant, scene);
  glass_.show(instant, scene);
  puffs_ = smoke_.draw(instant.effects, simulated_time_s);
  soot_.draw(instant.effects);
}

void EffectsDrawing::add_to(instant::FrameInput& frame) const {
  frame.meshes.insert(frame.meshes.end(), debris_shown_.meshes.begin(), debris_shown_.meshes.end());
  frame.ice = debris_shown_.ice;
  dents_.add_to(frame);
  ice_.add_to(frame);
  glass_.add_to(frame);
  frame.ice_surroundings_px = 32;  // Uneven ice under a crust shows no finer surroundings.
  frame.smoke = puffs_;
  frame.soot = soot_.field();
}

}  // namespace septet::frame
