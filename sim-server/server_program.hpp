#pragma once
/// `septet-server` from reading its files to writing its results.

#include "engine/core/expected.hpp"
#include "logging/session/drive_end.hpp"
#include "sim-server/drive/server_options.hpp"

namespace septet::server {

/// Prints "ready PORT" to standard output once screens may connect, and at the end "ended NAME TEXT"
/// (logging/session/drive_end.hpp), before it "begin_at SECONDS" if the operator wants the drive to begin again: at the
/// newest state that it kept until then (simulated; 0: at its start). Progress and messages go to standard error.
/// Error: nothing was driven, and nothing is left behind. Once the drive has begun, any end closes the log and writes
/// summary and report, and is returned.
///
/// A signal ends the program at once while it still reads its files, and the drive in order afterwards.
Expected<logging::DriveEnd> run_server(ServerOptions options);

}  // namespace septet::server
