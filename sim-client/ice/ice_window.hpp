#pragma once
/// Object of ice in a window, turning, until Escape.

#include "engine/core/expected.hpp"
#include "sim-client/ice/ice_viewer.hpp"

namespace septet::ice_viewer {

/// Shows the object and returns the exit status.
Expected<int> show_in_window(const ice::Surface& surface, IceOptions options);

}  // namespace septet::ice_viewer
