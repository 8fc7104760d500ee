#pragma once
/// Pictures beside a session, and the selection that its report shows. They are linked, not copied.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "logging/session/records.hpp"

namespace septet::logging {

struct DrivePicture {
  std::string link;  ///< From the page.
  std::string says;  ///< Caption; plain text.
  bool is_wide = false;
};

/// Ticks of the pictures TICK.png in a folder, ascending; empty if the folder does not exist.
std::vector<std::int64_t> picture_ticks_in(const std::filesystem::path& folder);

/// The panorama, and from the screen ahead (or, if that kept none, the first by name that did) the first picture, the
/// nearest to each mark and collision, at most six of these, and the last.
std::vector<DrivePicture> find_drive_pictures(const SessionInfo& info, std::span<const Event> events,
                                              const std::filesystem::path& session_folder,
                                              const std::filesystem::path& page_folder);

/// Heading and pictures; empty without any.
std::string picture_section(std::span<const DrivePicture> pictures);

}  // namespace septet::logging
