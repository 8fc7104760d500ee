#pragma once
/// The windscreen between its pillars, of the car with a drawn interior (the Volvo S80), vehicle frame.

#include "engine/math/rigid_transform.hpp"

namespace septet::windscreen {

/// The left ends of its foot and of its head; the right ones are their mirror images.
inline constexpr Vec3 foot_left_m{2.30, 0.76, 0.945}, head_left_m{1.66, 0.58, 1.43};

}  // namespace septet::windscreen
