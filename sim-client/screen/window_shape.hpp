#pragma once
/// Shape of a window, which a person chooses, and the screen of the rig that it shows.
///
/// Pure functions. A screen that takes its window's shape is drawn in the window's own pixels: the vertical angle is
/// kept, and its corners move apart or together about their middle.

#include <cstdint>

#include "engine/rig/rig.hpp"

namespace septet::screen {

/// True for a screen without a measured place: a cockpit alone on its rig, without `full_screen`; or a panel of
/// instruments, which fills any shape. The others keep their corners, and black bars fill the window.
bool takes_window_shape(const rig::Rig& rig, const rig::Screen& screen);

/// `screen`, as its rig has it, in a window of this many pixels (both at least 1). The horizontal angle is at most
/// `widest_rad`: beyond, less of the height is visible. Insets keep their shape, are at most as large a share of either
/// side as before, and stay near their edge.
inline constexpr double widest_rad = 2.4;
rig::Screen shaped_to_window(const rig::Screen& screen, const Vec3& eye_m, std::uint32_t width_px,
                             std::uint32_t height_px);

}  // namespace septet::screen
