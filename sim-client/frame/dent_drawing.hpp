#pragma once
/// Dents of vehicles that have crashed: the meshes that stand in for theirs, outside and, where the driver sits, inside. Made once
/// when a dent comes, by each screen and film for itself from the one keyframe. One thread.

#include <cstdint>
#include <map>
#include <memory>

#include "engine/core/bytes.hpp"
#include "engine/effects/debris/dent.hpp"
#include "engine/instant/frame_input.hpp"

namespace septet::frame {

class DentDrawing {
 public:
  /// By the keyframe that the instant has, if it can be read.
  void show(const Snapshot& instant, const scene::ResolvedScene& scene);
  /// For the participants that the frame has.
  void add_to(instant::FrameInput& frame) const;

 private:
  struct Made {
    Bytes told;  ///< Its dents as the wire has them.
    std::map<std::uint32_t, std::shared_ptr<const instant::ReshapedParts>> by_prototype;
  };
  std::map<ParticipantId, Made> made_;  ///< Made anew where they have changed.
  Bytes data_;                          ///< Of the keyframe that they were read from.
  std::uint64_t scene_revision_ = 0;
};

}  // namespace septet::frame
