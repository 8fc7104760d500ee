#pragma once
/// The keys of a rig of several machines: one folder for each, ready to be carried there.
///
///     out/server/    server.key, server.public, allowed-clients, and the keys of screens on the server's own machine
///     out/MACHINE/   server.public, and NAME.key for each screen that runs there, car.key for the car
///     out/EDITOR/    server.public, EDITOR.key, and address: all that `septet edit --keys` needs
///
/// An existing key is never replaced, and a key in the list counts as existing, since its file may have been moved to
/// its machine. After a screen is added to the rig, the same command adds its key and leaves the others; a name removed
/// from the list gets a new key.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/rig/rig.hpp"

namespace septet::server {

/// Keys of one machine: the names of its clients, which are those of its key files.
struct MachineKeys {
  std::string machine;  ///< Name in the rig; "server" for the server's own.
  std::vector<std::string> clients;
};

/// Returns the server's machine first, then the others in the order of the rig.
std::vector<MachineKeys> machines_of(const rig::Rig& rig);

/// A client that edits, or only looks.
struct EditorKey {
  std::string name;
  std::string words = "edit";  ///< Its rights (engine/net/rights.hpp).
};
/// From "NAME" or "NAME=WORDS". Error: a name that cannot be one of a file and of the list, a word that is no right.
Expected<EditorKey> parse_editor_key(std::string_view text);

/// Writes the missing files; returns one line for each machine with its new keys, and one for each key that replaced
/// another in the list. The rights of an editor that is on the list already become those given.
Expected<std::vector<std::string>> write_rig_keys(const rig::Rig& rig, const std::filesystem::path& out,
                                                  const std::vector<EditorKey>& editors = {});

}  // namespace septet::server
