#pragma once
/// Messages between page and server: JSON, one object a message. PROTOCOL.md has every member.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/expected.hpp"
#include "sim-server/page/drive_choice.hpp"
#include "sim-server/page/drive_view.hpp"
#include "sim-server/page/road_map.hpp"

namespace septet::page {

inline constexpr int schema = 1;

/// Browser → server.
struct Take {  ///< Request for the command; `by_force` also if another browser has it.
  std::string name;
  bool by_force = false;
};
struct Release {};
struct Pause {};
/// Lets fan, shaker and wheel force run again after a fault or an emergency stop.
struct Rearm {};
struct GoOn {};  ///< Resumes, or drives without the missing screens.
struct End {
  std::string reason;
  bool participant_stops = false;  ///< A drop-out, which counts as one: the reason is the participant's.
};
struct Mark {
  std::string note;
};
/// A change of the drive, as the log keeps it (engine/simulation/operator_command.hpp).
struct Change {
  std::string command;
};
/// A change of the scene by an editor's lines, of which the map knows some (sim-server/drive/placing.hpp).
struct Edit {
  std::string lines;
};
/// Request for the things near a place, the nearest first.
struct FindNear {
  double x_m = 0.0, y_m = 0.0, within_m = 0.0;
};
/// What differs from the generated world is written to the file NAME.edits of the drive's folder.
struct SaveEdits {
  std::string name;
};
/// Answer on the drive's scale of well-being (MISC).
struct Rate {
  int value = 0;
};
/// Starts this drive; valid while there is no drive.
struct Start {
  DriveChoice choice;
};
/// Cancels the drive that is being prepared.
struct Cancel {};
/// Request for a file of a past session. Open to every browser.
struct Look {
  std::uint64_t session = 0;
  std::string file;
};
/// A driver's answers after a past drive.
struct Answer {
  std::uint64_t session = 0;
  std::string questionnaire;
  std::string as;  ///< Prefix of the answers; empty: the questionnaire's id.
  std::vector<std::pair<std::string, std::optional<int>>> answers;  ///< By item. Empty: not a whole number.
};
/// A word to the student: text on his screen, and aloud if requested and a synthesiser is installed.
struct Say {
  std::string text, language;  ///< "en", "de", "sv".
  bool aloud = false;
};
/// The instructor's brake, pressed or released. While pressed it is repeated, at least each half second.
struct Brake {
  bool held = false;
};
/// Puts the car back onto the road: to its place and speed this long ago; 0: to its last place in a lane, at rest.
struct Back {
  double seconds = 0.0;
};
/// The drive ends and begins again at the newest state that it kept until this simulated time; 0: at its start.
struct Restart {
  double at_s = 0.0;
};
/// A film or a replay of a past drive.
struct Make {
  std::uint64_t session = 0;
  std::string what;  ///< "film" or "replay".
};
/// Cancels the running film or replay of a past drive.
struct StopMaking {};
/// Subscribes to a screen's large picture, five times a second; no screen: unsubscribes. Open to every browser.
struct Watch {
  std::string screen;
};
using Wish = std::variant<Take, Release, Pause, GoOn, Rearm, End, Mark, Change, Rate, Start, Cancel, Look, Answer,
                          Watch, Say, Brake, Back, Restart, Make, StopMaking, Edit, FindNear, SaveEdits>;

struct BrowserMessage {
  std::uint64_t id = 0;  ///< Named in the reply.
  Wish wish;
};

inline constexpr std::size_t most_note_characters = 500, most_name_characters = 60, most_word_characters = 160;

/// Texts are one line, printable and not longer than these. Error: not such a message, or longer than
/// most_message_bytes.
Expected<BrowserMessage> read_browser_message(std::string_view text);

/// Answer to a message that could not be read, under the number that it bears as far as it is one; 0: it has none.
std::string refusal_text(std::string_view message, const Error& why);

/// The browser in command.
struct Commander {
  std::uint64_t browser = 0;
  std::string name;
};

/// Server → browser.
std::string hello_text(const DriveFacts& facts, const RoadMap& map, std::uint64_t browser);
std::string state_text(const DriveView& view, const DriveFacts& facts, std::uint64_t number,
                       const std::optional<Commander>& commander, std::size_t browsers);
std::string answer_text(std::uint64_t id, const std::optional<std::string>& why_not);
/// A screen's picture, in the form of an <img> source.
std::string thumbnail_text(const std::string& screen, std::string_view picture);
/// The same, large.
std::string large_picture_text(const std::string& screen, std::string_view picture);
/// An event, for the list of events.
std::string event_text(const PageEvent& event);
/// State of the lesson, and its faults so far.
std::string lesson_text(const LessonView& lesson);
/// Picture of the screen ahead at a fault.
std::string still_text(std::uint32_t fault, std::string_view picture);

}  // namespace septet::page
