#pragma once
/// `septet road sample` and `septet road locate`: forward and inverse map of a road file as tables.

#include <iosfwd>
#include <string>

#include "engine/core/expected.hpp"

namespace septet::server {

Expected<int> run_road_sample(const std::string& file, std::istream& in, std::ostream& out);
Expected<int> run_road_locate(const std::string& file, std::istream& in, std::ostream& out);

}  // namespace septet::server
