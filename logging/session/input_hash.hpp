#pragma once
/// Hash of a drive's inputs, in their order.

#include "engine/core/hash.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

/// Excludes the device's report: the input is the value that the simulation used.
void add_to_hash(const InputRecord& record, StateHash& hash);

}  // namespace septet::logging
