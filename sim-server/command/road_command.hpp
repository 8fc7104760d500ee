#pragma once
/// `septet road sample` and `septet road locate`: forward and inverse map of a road file as tables.

#include <iosfwd>
#include <string>

namespace septet::server {

int run_road_sample(const std::string& file, std::istream& in, std::ostream& out);
int run_road_locate(const std::string& file, std::istream& in, std::ostream& out);

}  // namespace septet::server
