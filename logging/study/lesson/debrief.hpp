#pragma once
/// debrief.html: a lesson's marks, the place and time of each one's worst moment, and the driver's view at that moment.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "logging/session/session_reader.hpp"
#include "logging/study/lesson/lesson.hpp"
#include "logging/study/report/drive_pictures.hpp"

namespace septet::logging {

/// Content of the page beside the marks. It never identifies the driver: it may be printed and left lying.
struct DebriefPlace {
  std::string picture_folder;               ///< The screen ahead's, relative to the page, with pictures TICK.png.
  std::vector<std::int64_t> picture_ticks;  ///< Ticks with a picture, ascending: about one a second.
  double ticks_per_second = 120.0;
  std::string what_if{};  ///< What would have followed from another act; empty: nothing is offered.
};

std::string debrief_page(const Lesson& lesson, const LessonMarks& marks, std::span<const Sample> samples,
                         const DebriefPlace& place);

/// Writes debrief.html into the folder, if the session holds a lesson; returns its marks in a line. `what_if`: DebriefPlace::what_if.
/// Error: the session or the folder.
Expected<std::optional<std::string>> write_debrief(const SessionReader& session, const std::filesystem::path& folder,
                                                   const std::string& picture_folder, const std::string& what_if = {});

/// Marks in a line: "mark 7.3 of 10, passed; worst: look into a mirror …", or "too short to be marked; worst: …".
std::string marks_in_a_line(const Lesson& lesson, const LessonMarks& marks);

}  // namespace septet::logging
