#pragma once
/// Wording of the sections of a group's page.

#include <string>
#include <vector>

namespace septet::logging {

/// A chart with its notes below.
std::string framed(const std::string& svg, const std::string& caption);
std::string name_of_group(const std::string& group);
/// "Mean ± SD; median [quartiles] (n)"; a dash for no value.
std::string spread_text(const std::vector<double>& values);

}  // namespace septet::logging
