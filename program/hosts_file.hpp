#pragma once
/// The host file for mpirun: one machine a line, in Open MPI's words.

#include <filesystem>

#include "engine/core/expected.hpp"

namespace septet::program {

/// Checks that mpirun would accept it: on each line the name or address of a machine (also USER@NAME) and optionally
/// `slots=N` and `max_slots=N`; empty lines and comments after # are skipped. Only mpirun can tell whether a machine is
/// there. Error: the first invalid line, as FILE:LINE; a file without a machine.
Expected<void> check_hosts_file(const std::filesystem::path& file);

}  // namespace septet::program
