#pragma once
/// The hash of the inputs that a drive was computed with, in their order.

#include "engine/core/hash.hpp"
#include "logging/records.hpp"

namespace septet::logging {

/// The device's report is left out: what was computed with is the input.
void add_to_hash(const InputRecord& record, StateHash& hash);

}  // namespace septet::logging
