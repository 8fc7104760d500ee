#pragma once
/// The keys of a rig of several machines: one folder for each, ready to be carried there.
///
///     out/server/    server.key, server.public, allowed-clients, and the keys of screens on the server's own machine
///     out/MACHINE/   server.public, and NAME.key for each screen that runs there, car.key for the car
///
/// A key that exists is never made anew, and one that the list names exists: its file may have been carried away. After the rig has got a
/// screen, the same command adds that screen's and leaves the others as they are; a name that was taken off the list gets a new key.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/rig/rig.hpp"

namespace septet::server {

/// What one machine needs: the names of its clients, which are those of its key files.
struct MachineKeys {
  std::string machine;  ///< As the rig calls it; "server" for the server's own.
  std::vector<std::string> clients;
};

/// The server's machine first, then the others as the rig names them.
std::vector<MachineKeys> machines_of(const rig::Rig& rig);

/// Writes what is missing; returns one line for each machine of what is new there, and for each key that took another's place in the list.
Expected<std::vector<std::string>> write_rig_keys(const rig::Rig& rig, const std::filesystem::path& out);

}  // namespace septet::server
