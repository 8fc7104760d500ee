#pragma once
/// The driver of a drive, beside their code: an experiment's facts. Meta rows of the session (FORMAT.md).

#include <map>
#include <string>
#include <string_view>

#include "engine/core/expected.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

struct Subject {
  std::string participant;  ///< A pseudonym. Empty: unknown.
  std::string group, condition, order, part, note;
  std::map<std::string, std::string> columns;  ///< The experimenter's own.
};

Subject subject_of(const SessionInfo& info);
/// Meta rows of all but the participant; empty texts have no row.
std::map<std::string, std::string> meta_of(const Subject& subject);
/// Adds one "KEY=VALUE": KEY is group, condition, order, part, note or column.NAME. Error: another key; an invalid
/// order; a text that cannot stand on one line of a report.
Expected<void> add_to_subject(Subject& subject, const std::string& text);

/// True for a drive's position: a whole number from 1 on, of at most nine digits.
bool is_order(std::string_view text);

/// Keys with personal data, removed when a person is to be forgotten.
bool is_personal(const std::string& meta_key);

}  // namespace septet::logging
