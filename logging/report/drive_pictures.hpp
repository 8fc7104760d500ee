#pragma once
/// The pictures that lie beside a session, and which of them its report shows. None is copied.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "logging/records.hpp"

namespace septet::logging {

struct DrivePicture {
  std::string link;  ///< From the page.
  std::string says;  ///< What it shows; plain text.
  bool is_wide = false;
};

/// The ticks of the pictures TICK.png in a folder, ascending; none where there is no such folder.
std::vector<std::int64_t> picture_ticks_in(const std::filesystem::path& folder);

/// The panorama, and of the screen ahead (or, where that kept none, of the first by name that did) the first picture, the nearest to each
/// mark and collision, not more than six of these, and the last.
std::vector<DrivePicture> find_drive_pictures(const SessionInfo& info, std::span<const Event> events,
                                              const std::filesystem::path& session_folder,
                                              const std::filesystem::path& page_folder);

/// Heading and pictures; empty without any.
std::string picture_section(std::span<const DrivePicture> pictures);

}  // namespace septet::logging
