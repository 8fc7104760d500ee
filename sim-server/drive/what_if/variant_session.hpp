#pragma once
/// A variant as a session of its own, which replay, film and check read as any other.

#include <filesystem>
#include <span>
#include <string>

#include "engine/core/expected.hpp"
#include "logging/session/session_reader.hpp"
#include "sim-server/drive/what_if/variant.hpp"

namespace septet::server {

inline constexpr const char* variant_session_name = "what-if.sqlite";
/// Meta row of a variant's session: its changes. Rows beside it: FORMAT.md.
inline constexpr const char* variant_changes_row = "what_if_changes";

/// Runs a variant from the kept state to the end, on through collisions, and writes it to what-if.sqlite in a folder,
/// which is created; an earlier variant there is replaced, since it can be made again. The driver's code, notes and
/// columns stay out, so that nothing of a person has to be forgotten in it. Returns its path. Error: the folder cannot
/// be written, or what-if.sqlite there is no variant.
Expected<std::filesystem::path> write_variant_session(const logging::SessionReader& source, const WhatIf& what_if,
                                                      std::span<const InputChange> changes,
                                                      const std::filesystem::path& folder);

/// The same of one run of a drive by a table, from its start, with the table departing within its ±; written to `name`
/// in the folder. The drive has a table.
Expected<std::filesystem::path> write_run_session(const logging::SessionReader& source, const WhatIf& what_if,
                                                  const simulation::MotionDeviation& deviation,
                                                  const std::filesystem::path& folder, const std::string& name);

}  // namespace septet::server
