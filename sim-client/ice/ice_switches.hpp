#pragma once
/// What the keys of septet-ice's window do: each part of the drawing on and off. Pure.

#include <string>
#include <vector>

#include "engine/world/key.hpp"
#include "sim-client/ice/ice_viewer.hpp"

namespace septet::ice_viewer {

/// Applies a key that has been pressed; false for one that changes nothing.
bool press(IceOptions& options, Key key);

/// One line a switch: its key, its name, and how it stands.
std::vector<std::string> switches(const IceOptions& options);

}  // namespace septet::ice_viewer
