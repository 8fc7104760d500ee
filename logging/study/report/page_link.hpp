#pragma once
/// Address of a file, from a page that lies in a folder.

#include <filesystem>
#include <string>

namespace septet::logging {

/// Relative, so that both can be moved together; every byte outside of an address's characters is written as %XX.
std::string page_link(const std::filesystem::path& file, const std::filesystem::path& page_folder);

}  // namespace septet::logging
