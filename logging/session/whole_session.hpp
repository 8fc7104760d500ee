#pragma once
/// Reads everything in a session once, as all of its readers together do: a session that passes is accepted by each of
/// them.

#include <cstdint>
#include <functional>

#include "engine/core/expected.hpp"
#include "logging/session/session_reader.hpp"

namespace septet::logging {

struct WholeSession {
  bool has_digest = false;  ///< Its contents are proved to be those recorded, and not only readable.
  std::uint64_t snapshots = 0;
};

/// Checks every page, row and byte: types and text, each snapshot decoded, inputs and snapshots tick for tick, the
/// scene built from its edits, the meta rows that are JSON, and the digests if the session has them. `on_progress`
/// receives the share done, 0 to 1. Takes the time of one decoding of the drive, and the memory of its samples and
/// scene edits. Error: the first fault, with the session's path.
Expected<WholeSession> read_whole(const SessionReader& session, const std::function<void(double share)>& on_progress);

}  // namespace septet::logging
