#pragma once
/// Frames of one screen of a rig: the world through its window, the car around the eyes, effects, the driver's text.
///
/// septet-screen draws these frames, and so do the golden pictures: the comparison covers the client's own frames.

#include <optional>
#include <string>

#include "sim-client/frame/client_frame.hpp"
#include "sim-client/frame/effects_drawing.hpp"

namespace septet::frame {

class ScreenFrames {
 public:
  /// Selects this screen from now on; both must outlive its use. `eyes`: whose, of a replay; empty: the driver's. Error:
  /// a screen that the eyes do not see from its front.
  Expected<void> look_through(const rig::Rig& rig, const rig::Screen& screen, std::optional<Eyes> eyes = std::nullopt);
  /// Takes the effects of an instant, by the keyframes around it in `history`.
  void show(const Snapshot& instant, const TickHistory& history, double tick_s, const scene::ResolvedScene& scene) {
    effects_.show(instant, history, tick_s, scene);
  }
  /// Frame of the selected screen. Effects are those of the last `show`. `message`: across the middle, instead of
  /// instruments.
  ///
  /// With `eyes` the screen ahead says whose. Of the driver the logged head and gaze turn the pictures; of others no
  /// gaze is known, and they look straight on with their vehicle. While they are not there, the screens stay at their
  /// last place, before their first one at the driver's eyes.
  instant::FrameInput frame(const Snapshot& shown, const scene::ResolvedScene& scene,
                            std::optional<std::string> message = std::nullopt);

 private:
  /// Views at a viewpoint, with the inside of what is around it.
  ScreenViews views_in(const Snapshot& shown, const Viewpoint& viewpoint, bool are_drivers) const;

  const rig::Rig* rig_ = nullptr;
  const rig::Screen* screen_ = nullptr;
  ScreenViews views_;
  Head head_;  ///< Head that the views were computed for.
  std::optional<Eyes> eyes_;
  std::optional<Viewpoint> last_place_;  ///< Of other eyes than the driver's.
  EffectsDrawing effects_;
};

}  // namespace septet::frame
