#pragma once
/// Answers and playing times of people, as sections of a group's page: each part and condition by itself, where there
/// are several, since one person's answers after different drives are different answers.

#include <string>

#include "logging/study/report/group_report.hpp"

namespace septet::logging {

/// Kaplan and Meier's curves by group, and log-rank tests; empty without a playing time.
std::string survival_sections(const GroupReport& report);
/// Empty without an answer.
std::string answers_section(const GroupReport& report);

}  // namespace septet::logging
