#pragma once
/// What the page and the server say to each other: JSON, one object a message. PROTOCOL.md has every member.

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
struct Take {  ///< To be the one who commands; `by_force` also where somebody else does.
  std::string name;
  bool by_force = false;
};
struct Release {};
struct Pause {};
/// Fan, shaker and wheel force may run again after a fault or an emergency stop.
struct Rearm {};
struct GoOn {};  ///< Also: drive without the screens that are missing.
struct End {
  std::string reason;
  bool participant_stops = false;  ///< A drop-out, which counts as such: the reason is the participant's.
};
struct Mark {
  std::string note;
};
/// A change of the drive, as the log keeps it (engine/simulation/operator_command.hpp).
struct Change {
  std::string command;
};
/// How the driver feels on the scale of the questionnaire that the drive has for it (MISC).
struct Rate {
  int value = 0;
};
/// Where there is no drive: this one, to be started.
struct Start {
  DriveChoice choice;
};
/// The drive that is being made ready is not wanted any more.
struct Cancel {};
/// A file of a past session. Anybody may look.
struct Look {
  std::uint64_t session = 0;
  std::string file;
};
/// What a driver has answered after a drive of the past.
struct Answer {
  std::uint64_t session = 0;
  std::string questionnaire;
  std::string as;  ///< What its answers are called; empty: as the questionnaire is.
  std::vector<std::pair<std::string, std::optional<int>>> answers;  ///< By item. Nothing: it was no whole number.
};
/// A word to the student: text on his screen, and aloud where that is asked for and a synthesiser is installed.
struct Say {
  std::string text, language;  ///< "en", "de", "sv".
  bool aloud = false;
};
/// The instructor's brake, held or let go. Who holds it says so again, at least each half second.
struct Brake {
  bool held = false;
};
/// The car back onto the road: where it was so long ago, as fast as then; 0: where it last was in a lane, at rest.
struct Back {
  double seconds = 0.0;
};
/// A film or a replay of a past drive.
struct Make {
  std::uint64_t session = 0;
  std::string what;  ///< "film" or "replay".
};
/// What is being made of a past drive is not wanted any more.
struct StopMaking {};
/// To see what a screen shows large, five times a second; no screen: no more. Anybody may.
struct Watch {
  std::string screen;
};
using Wish = std::variant<Take, Release, Pause, GoOn, Rearm, End, Mark, Change, Rate, Start, Cancel, Look, Answer,
                          Watch, Say, Brake, Back, Make, StopMaking>;

struct BrowserMessage {
  std::uint64_t id = 0;  ///< Which the answer names.
  Wish wish;
};

inline constexpr std::size_t most_note_characters = 500, most_name_characters = 60, most_word_characters = 160;

/// Texts are one line, printable and not longer than these. Error: it is no such message.
Expected<BrowserMessage> read_browser_message(std::string_view text);

/// Who commands.
struct Commander {
  std::uint64_t browser = 0;
  std::string name;
};

/// Server → browser.
std::string hello_text(const DriveFacts& facts, const RoadMap& map, std::uint64_t browser);
std::string state_text(const DriveView& view, const DriveFacts& facts, std::uint64_t number,
                       const std::optional<Commander>& commander, std::size_t browsers);
std::string answer_text(std::uint64_t id, const std::optional<std::string>& why_not);
/// What a screen shows, as a picture that an <img> takes.
std::string thumbnail_text(const std::string& screen, std::string_view picture);
/// The same, large.
std::string large_picture_text(const std::string& screen, std::string_view picture);
/// Something has happened, for the list of events.
std::string event_text(const PageEvent& event);
/// How the lesson stands, and its faults so far.
std::string lesson_text(const LessonView& lesson);
/// What the screen ahead showed at a fault.
std::string still_text(std::uint32_t fault, std::string_view picture);

}  // namespace septet::page
