#pragma once
/// An event of the log as the operator's page is told of it: its kind and values, and the same in English words. The page has words of its
/// own for the kinds that it knows, in each language.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "logging/session/records.hpp"
#include "sim-server/page/drive_view.hpp"

namespace septet::server {

/// Nothing for what is no news to a person: elements of the storyboard that begin and end, glances, turns.
std::optional<page::PageEvent> told_on_page(const logging::Event& event);

/// The pairs of a detail: "tree speed_mps=4 note=has sneezed" is what=tree, speed_mps=4, note="has sneezed". A word without a name
/// belongs to the value before it.
std::vector<std::pair<std::string, std::string>> values_of(std::string_view detail);

}  // namespace septet::server
