#pragma once
/// Soot as a screen draws it: the share of a surface's reflection that is covered, cell by cell. One thread.

#include <span>

#include "engine/effects/smoke/soot_keyframe.hpp"
#include "engine/instant/frame_input.hpp"

namespace septet::frame {

/// Field of a keyframe. A surface lies up to a cell beside the cells that hold its soot, so each cell takes the maximum
/// of its neighbourhood.
instant::SootField soot_field(const smoke::SootKeyframe& keyframe);

class SootDrawing {
 public:
  /// Soot of a snapshot; an empty field if there is none.
  const instant::SootField& draw(std::span<const EffectKeyframe> effects);
  /// Last field drawn.
  const instant::SootField& field() const { return field_; }

 private:
  Tick tick_ = 0;
  instant::SootField field_;  ///< Field of the keyframe of that tick: each is read once.
};

}  // namespace septet::frame
