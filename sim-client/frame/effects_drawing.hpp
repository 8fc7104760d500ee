#pragma once
/// Debris, dents, still ice, smoke and soot of an instant, as a screen or a film draws them. Holds caches of decoded
/// keyframes: for the same keyframes the same drawing. One thread.

#include "sim-client/frame/debris_drawing.hpp"
#include "sim-client/frame/dent_drawing.hpp"
#include "sim-client/frame/glass_drawing.hpp"
#include "sim-client/frame/ice_drawing.hpp"
#include "sim-client/frame/smoke_drawing.hpp"
#include "sim-client/frame/soot_drawing.hpp"

namespace septet::frame {

class EffectsDrawing {
 public:
  /// Takes the effects of `instant`, by the keyframes around it in `history`.
  void show(const Snapshot& instant, const TickHistory& history, double tick_s, const scene::ResolvedScene& scene);
  /// Adds the effects of the last `show`, also after its ticks have gone with a lost server; of still ice only pieces
  /// near the frame's eye.
  void add_to(instant::FrameInput& frame) const;

 private:
  DebrisDrawing debris_;
  DentDrawing dents_;
  IceDrawing ice_;
  GlassDrawing glass_;
  SmokeDrawing smoke_;
  SootDrawing soot_;
  DrawnDebris debris_shown_;
  std::vector<instant::SmokePuff> puffs_;
};

}  // namespace septet::frame
