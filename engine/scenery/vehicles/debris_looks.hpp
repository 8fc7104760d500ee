#pragma once
/// Materials of debris.

#include "engine/scene/builder.hpp"

namespace septet::scenery {

/// Adds "model/debris/ice", "model/debris/steel-sheet", …: prototypes whose material debris wears. Their shape, a small
/// plate, is never drawn: the drawn shape comes with the effects' keyframes.
void build_debris_looks(scene::SceneBuilder& builder);

}  // namespace septet::scenery
