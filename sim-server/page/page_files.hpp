#pragma once
/// The page itself: its files, which are part of the program.

#include <vector>

#include "sim-server/page/web_server.hpp"

namespace septet::page {

std::vector<Resource> page_files();

}  // namespace septet::page
