#pragma once
/// Where an editor finds its drive: a folder with the server's public key, its own key, and the address.

#include <filesystem>
#include <string>

#include "engine/core/expected.hpp"
#include "engine/net/address.hpp"
#include "engine/net/keys.hpp"

namespace septet::editor {

/// File of an editor's folder with the server's address and port.
inline constexpr const char* address_file = "address";

struct EditPlace {
  net::Address server;
  net::PublicKey server_key{};
  net::Identity identity;
  std::string name;  ///< Of the key in the server's list.
};

/// `key`: name of the key file in the folder, without its ending; empty: the only one there. `server`: address and port;
/// empty: what the folder's file `address` says.
Expected<EditPlace> find_edit_place(const std::filesystem::path& folder, const std::string& key,
                                    const std::string& server);

}  // namespace septet::editor
