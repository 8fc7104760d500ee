#include "engine/instant/view.hpp"

namespace septet::instant {

Vec3 world_eye(const FrameView& view) { return view.world_from_car * view.projection.eye_m; }

}  // namespace septet::instant
