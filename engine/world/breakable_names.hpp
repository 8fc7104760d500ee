#pragma once
/// What can be placed as a breakable thing, as users write it: the name of a MiscObject, an operator's choice.

#include <array>
#include <string_view>

namespace septet {

/// In the order of debris::Part.
inline constexpr std::array<std::string_view, 8> breakable_names{
    "bumper", "door", "lamp", "windscreen", "traffic-cone", "barrier-post", "ice-slab", "side-window"};

}  // namespace septet
