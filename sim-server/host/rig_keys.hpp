#pragma once
/// The keys of a rig of several machines: one folder for each, ready to be carried there.
///
///     out/server/    server.key, server.public, allowed-clients, and the keys of screens on the server's own machine
///     out/MACHINE/   server.public, and NAME.key for each screen that runs there, car.key for the car
///
/// An existing key is never replaced, and a key in the list counts as existing, since its file may have been moved to
/// its machine. After a screen is added to the rig, the same command adds its key and leaves the others; a name removed
/// from the list gets a new key.

#include <filesystem>
#include <string>
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

/// Writes the missing files; returns one line for each machine with its new keys, and one for each key that replaced
/// another in the list.
Expected<std::vector<std::string>> write_rig_keys(const rig::Rig& rig, const std::filesystem::path& out);

}  // namespace septet::server
