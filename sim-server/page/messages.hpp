#pragma once
/// What the page and the server say to each other: JSON, one object a message. PROTOCOL.md has every member.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "engine/core/expected.hpp"
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
};
struct Mark {
  std::string note;
};
/// A change of the drive, as the log keeps it (engine/simulation/operator_command.hpp).
struct Change {
  std::string command;
};
using Wish = std::variant<Take, Release, Pause, GoOn, Rearm, End, Mark, Change>;

struct BrowserMessage {
  std::uint64_t id = 0;  ///< Which the answer names.
  Wish wish;
};

inline constexpr std::size_t most_note_characters = 500, most_name_characters = 60;

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
/// Something has happened, for the list of events.
std::string event_text(double simulated_s, const std::string& text);

}  // namespace septet::page
