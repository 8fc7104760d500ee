#pragma once
/// How the sections of a group's page say things.

#include <string>
#include <vector>

namespace septet::logging {

/// A chart with what is to be known of it below.
std::string framed(const std::string& svg, const std::string& caption);
std::string name_of_group(const std::string& group);
/// "Mean ± SD; median [quartiles] (n)"; a dash of nothing.
std::string spread_text(const std::vector<double>& values);

}  // namespace septet::logging
