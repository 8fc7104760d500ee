#pragma once
/// Frost and stars of cracks on windscreens: on that through which the driver looks where the inside of the car is drawn (in a rig
/// the glass is a real car's), and on those of the cars that are seen, where their mesh has glass. One thread.

#include <cstdint>
#include <map>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/effects/ice/glass.hpp"
#include "engine/instant/frame_input.hpp"

namespace septet::frame {

/// The windscreen of a vehicle as its prototype shows it: dark, smooth triangles that look forward. Empty where it has none.
ice::PaneShape windscreen_of(const scene::ResolvedScene& scene, const scene::Prototype& prototype);

class GlassDrawing {
 public:
  /// By the keyframe that the instant has, if it can be read.
  void show(const Snapshot& instant, const scene::ResolvedScene& scene);
  /// For the participants that the frame has.
  void add_to(instant::FrameInput& frame) const;

 private:
  struct Surfaces {
    ice::PaneShape shape;
    std::vector<ice::IceVertex> frost, cracks;  ///< Vehicle frame.
  };
  struct Made {
    ice::Pane pane;
    RigidTransform world_from_vehicle;
    std::map<std::uint32_t, Surfaces> by_prototype;  ///< Of its inside and of its outside.
    bool shown = false;
  };
  void make(Made& made, const Participant& vehicle, const scene::ResolvedScene& scene) const;

  std::map<ParticipantId, Made> made_;  ///< Made anew where they have changed.
  std::vector<ice::Pane> panes_;
  Bytes data_;  ///< Of the keyframe that they were read from.
  std::uint64_t scene_revision_ = 0;
};

}  // namespace septet::frame
