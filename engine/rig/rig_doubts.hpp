#pragma once
/// Settings of a rig that are valid, but most likely a mistake.

#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/rig/rig.hpp"

namespace septet::rig {

/// Doubts, at most one a screen: its front looks away from the driver, its picture stands on its head, or its pixels are
/// wider than high, or higher than wide, by more than 5 %. `file` is used in messages.
std::vector<Error> doubts_of(const Rig& rig, std::string_view file);

}  // namespace septet::rig
