#pragma once
/// Messages to browsers while there is no drive: see PROTOCOL.md.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "sim-server/page/messages.hpp"
#include "sim-server/page/start_page.hpp"

namespace septet::page {

std::string start_hello_text(const Choices& choices, std::uint64_t browser);
std::string start_state_text(const StartView& view, const std::optional<Commander>& commander, std::size_t browsers);
/// Reply to a look: the file's address.
std::string look_text(std::uint64_t id, const std::string& path);
/// Another program serves the page from now on, at the same address.
std::string moved_text();

}  // namespace septet::page
