#pragma once
/// The file of machines that mpirun is given: one a line, in Open MPI's words.

#include <filesystem>

#include "engine/core/expected.hpp"

namespace septet::program {

/// Whether mpirun would understand it: on each line the name or address of a machine (also USER@NAME) and, where wanted, `slots=N` and
/// `max_slots=N`; empty lines and what follows a # do not count. Whether a machine is there only mpirun can tell. Error: the first line
/// that is none of that, as FILE:LINE; a file without a machine.
Expected<void> check_hosts_file(const std::filesystem::path& file);

}  // namespace septet::program
