#pragma once
/// `septet session participants`: who takes part in a session.

#include <filesystem>
#include <iosfwd>

#include "engine/core/expected.hpp"

namespace septet::server {

struct ParticipantsOptions {
  std::filesystem::path session;
  bool json = false;  ///< An array of objects instead of lines.
};

/// Lists number, name in the scenario, kind, model, first and last instant (simulated seconds) of everybody, by number;
/// films and `replay --eyes` take names and numbers. Error: damage, or a session without snapshots.
Expected<int> run_session_participants(const ParticipantsOptions& options, std::ostream& out);

}  // namespace septet::server
