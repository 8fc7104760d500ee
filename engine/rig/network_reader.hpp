#pragma once
/// The network in a rig file, and addresses of a rig's machines.

#include <string>
#include <string_view>

#include "engine/document/table_reader.hpp"
#include "engine/rig/rig.hpp"

namespace septet::rig {

/// `network.server_address` is only told to people, and may be a machine's name; the others are IPv4 addresses.
Network read_network(const toml::table& table, std::string_view file, Error& error);

/// Reports an `address` that is not four numbers of 0 to 255. `full_key`: the key with its table, "head.listen".
void check_address(document::TableReader& reader, std::string_view full_key, const std::string& address);

}  // namespace septet::rig
