#pragma once
/// Many variants of a session, on all processors, and on all machines of mpirun.

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "program/machines.hpp"
#include "sim-server/drive/what_if/variant.hpp"

namespace septet::server {

/// Runs variant i. Called from several threads at once.
using RunVariant = std::function<Expected<VariantOutcome>(std::size_t i)>;

/// Outcomes of these variants, in their order, `jobs` (at least 1) at once. `go_on` is called after each batch with the
/// number that are done; false stops with an error. Error: the first one of a variant.
Expected<std::vector<VariantOutcome>> run_variants(const WhatIf& what_if, const RunVariant& run,
                                                   const std::vector<std::size_t>& variants, unsigned jobs,
                                                   const std::function<bool(std::size_t done)>& go_on);

/// The same for all `count` variants, shared out over the programs of mpirun: each runs every n-th and sends its
/// outcomes to the first. That one never waits: when its own are done it runs those that have not come, so that a lost,
/// slow or different program costs time and no variant. Empty in all programs but the first.
Expected<std::optional<std::vector<VariantOutcome>>> run_variants_on(
    program::Machines& machines, const WhatIf& what_if, const RunVariant& run, std::size_t count, unsigned jobs,
    const std::function<bool(std::size_t done)>& go_on);

/// An outcome on its way between two programs.
void put_outcome(const VariantOutcome& outcome, Bytes& bytes);
/// The reader fails on other bytes.
VariantOutcome get_outcome(ByteReader& reader);

}  // namespace septet::server
