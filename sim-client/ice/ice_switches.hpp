#pragma once
/// Keys of septet-ice's window: each part of the drawing on and off. Pure.

#include <string>
#include <vector>

#include "engine/world/key.hpp"
#include "sim-client/ice/ice_viewer.hpp"

namespace septet::ice_viewer {

/// Applies a pressed key; returns false if it changes nothing.
bool press(IceOptions& options, Key key);

/// One line per switch: its key, its name, and its state.
std::vector<std::string> switches(const IceOptions& options);

}  // namespace septet::ice_viewer
