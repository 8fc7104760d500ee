#pragma once
/// Dents of crashed vehicles, and the lack of what was torn off them: meshes that replace theirs, outside and inside. Built once per
/// change of the dents, by each screen and film for itself from the one keyframe. One thread.

#include <cstdint>
#include <map>
#include <memory>

#include "engine/core/bytes.hpp"
#include "engine/effects/debris/dent.hpp"
#include "engine/instant/frame_input.hpp"

namespace septet::frame {

class DentDrawing {
 public:
  /// Updates from the keyframe of the instant, if it can be read.
  void show(const Snapshot& instant, const scene::ResolvedScene& scene);
  /// Adds the dented meshes to the participants of the frame.
  void add_to(instant::FrameInput& frame) const;

 private:
  struct Made {
    Bytes told;  ///< Its dents and losses as encoded on the wire.
    std::map<std::uint32_t, std::shared_ptr<const instant::ReshapedParts>> by_prototype;
  };
  std::map<ParticipantId, Made> made_;  ///< Cache: rebuilt when they change.
  Bytes data_;                          ///< Bytes of the keyframe that they were read from.
  std::uint64_t scene_revision_ = 0;
};

}  // namespace septet::frame
