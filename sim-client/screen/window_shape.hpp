#pragma once
/// The shape of a window, which a person at a desk chooses, and the screen of the rig that is seen in it.
///
/// Pure functions. A screen that takes its window's shape is drawn in the window's own pixels: the vertical angle is kept, and its corners go apart or together
/// around their middle.

#include <cstdint>

#include "engine/rig/rig.hpp"

namespace septet::screen {

/// Whether nobody has measured where it stands: a cockpit alone on its rig, without `full_screen`; or a panel of instruments, which fills any shape. The
/// others keep their corners, and black bars fill the window.
bool takes_window_shape(const rig::Rig& rig, const rig::Screen& screen);

/// `screen`, as its rig has it, in a window of so many pixels (both at least 1). Wider than `widest_rad` it does not see: then less of the height is
/// seen. Insets keep their shape, are at most as large a share of either side as before, and stay at the edge near which they are.
inline constexpr double widest_rad = 2.4;
rig::Screen shaped_to_window(const rig::Screen& screen, const Vec3& eye_m, std::uint32_t width_px,
                             std::uint32_t height_px);

}  // namespace septet::screen
