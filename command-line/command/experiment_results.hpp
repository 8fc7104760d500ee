#pragma once
/// What an experiment leaves beside its drives: everybody pooled, and how to drive each of them again.

#include "command-line/command/experiment_study.hpp"
#include "engine/core/expected.hpp"

namespace septet::server {

/// For how long somebody played of their own will, noted in the last session of it; what is noted stays.
Expected<void> note_playing_time(const Study& study, const logging::PlannedSubject& subject);

/// Writes subjects.csv, subjects.json, report.html and experiment.json from the drives that are whole.
Expected<void> write_study(const Study& study);

}  // namespace septet::server
