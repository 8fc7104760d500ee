#pragma once
/// An event of the log, converted for the operator's page: its kind and values, and the same in English words. The page
/// has texts of its own for known kinds, in each language.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "logging/session/records.hpp"
#include "sim-server/page/drive_view.hpp"

namespace septet::server {

/// Empty for events of no interest to a person: storyboard elements that begin and end, glances, turns.
std::optional<page::PageEvent> told_on_page(const logging::Event& event);

/// The pairs of a detail: "tree speed_mps=4 note=has sneezed" is what=tree, speed_mps=4, note="has sneezed". A word
/// without a name belongs to the value before it.
std::vector<std::pair<std::string, std::string>> values_of(std::string_view detail);
/// The same of an event of this kind: a call's words are told as it was made (engine/world/call.hpp).
std::vector<std::pair<std::string, std::string>> values_of(std::string_view kind, std::string_view detail);

}  // namespace septet::server
