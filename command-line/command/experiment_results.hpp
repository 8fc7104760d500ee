#pragma once
/// Results of an experiment beside its drives: all subjects pooled, and the commands to repeat each drive.

#include "command-line/command/experiment_study.hpp"
#include "engine/core/expected.hpp"

namespace septet::server {

/// Notes the time of a subject's free play in the last session of it; an existing note stays.
Expected<void> note_playing_time(const Study& study, const logging::PlannedSubject& subject);

/// Writes subjects.csv, subjects.json, report.html and experiment.json from the drives that are whole.
Expected<void> write_study(const Study& study);

}  // namespace septet::server
