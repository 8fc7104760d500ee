#pragma once
/// The messages about what is placed on the map (placing_view.hpp): PROTOCOL.md has every member.

#include <cstdint>
#include <string>
#include <vector>

#include "sim-server/page/placing_view.hpp"

namespace septet::page {

/// Sent once, behind `hello`.
std::string placing_facts_text(const PlacingFacts& facts);
/// All that was placed or changed.
std::string placed_text(const PlacedView& view);
/// The answer to FindNear.
std::string found_text(std::uint64_t id, const std::vector<PlacedThing>& found);
/// The answer to SaveEdits: the file that was written.
std::string saved_text(std::uint64_t id, const std::string& file);

}  // namespace septet::page
