#pragma once
/// `septet-server` from reading its files to writing its results.

#include "engine/core/expected.hpp"
#include "sim-server/server_options.hpp"

namespace septet::server {

/// Prints "ready PORT" to standard output once screens may connect, progress and messages to standard error.
Expected<void> run_server(const ServerOptions& options);

}  // namespace septet::server
