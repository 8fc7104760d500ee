#pragma once
/// What people answered and for how long they drove, as sections of a group's page: each part and condition by itself, where there are
/// several, for one person's answers after different drives are different answers.

#include <string>

#include "logging/report/group_report.hpp"

namespace septet::logging {

/// Kaplan and Meier's curves by group, and log-rank tests; empty where nobody has a playing time.
std::string survival_sections(const GroupReport& report);
/// Empty where nothing was answered.
std::string answers_section(const GroupReport& report);

}  // namespace septet::logging
