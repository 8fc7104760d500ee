#pragma once
/// What is said to browsers while no drive goes on: see PROTOCOL.md.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "sim-server/page/messages.hpp"
#include "sim-server/page/start_page.hpp"

namespace septet::page {

std::string start_hello_text(const Choices& choices, std::uint64_t browser);
std::string start_state_text(const StartView& view, const std::optional<Commander>& commander, std::size_t browsers);
/// The answer to a look: where it can be read.
std::string look_text(std::uint64_t id, const std::string& path);
/// Somebody else serves the page from now on, at the same address.
std::string moved_text();

}  // namespace septet::page
