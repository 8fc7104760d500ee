#pragma once
/// Who drove, beside their code: what an experiment knows of a drive. Meta rows of the session (FORMAT.md).

#include <map>
#include <string>
#include <string_view>

#include "engine/core/expected.hpp"
#include "logging/records.hpp"

namespace septet::logging {

struct Subject {
  std::string participant;  ///< A pseudonym. Empty: nobody's.
  std::string group, condition, order, part, note;
  std::map<std::string, std::string> columns;  ///< The experimenter's own.
};

Subject subject_of(const SessionInfo& info);
/// The meta rows of all but the participant; empty texts have none.
std::map<std::string, std::string> meta_of(const Subject& subject);
/// Adds one "KEY=VALUE": KEY is group, condition, order, part, note or column.NAME.
/// Error: another key; an order that is none; a text that cannot stand on one line of a report.
Expected<void> add_to_subject(Subject& subject, const std::string& text);

/// Which of a driver's drives it is: a whole number from 1 on, of at most nine digits.
bool is_order(std::string_view text);

/// Keys that tell something of a person, and are to go when they are to be forgotten.
bool is_personal(const std::string& meta_key);

}  // namespace septet::logging
