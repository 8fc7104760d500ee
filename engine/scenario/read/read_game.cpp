#include <charconv>
#include <sstream>
#include <string>
#include <string_view>

#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {
namespace {

/// The number in a text that holds nothing else, within these bounds.
template <class Number>
bool read_bounded(std::string_view text, Number least, Number most, Number& number) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= least && value <= most)) return false;
  number = value;
  return true;
}

bool read_lanes(std::string_view text, GameSettings& game) {
  const auto dots = text.find("..");
  return dots != std::string_view::npos && read_bounded(text.substr(0, dots), -40, 40, game.first_lane) &&
         read_bounded(text.substr(dots + 2), -40, 40, game.last_lane) && game.first_lane <= game.last_lane &&
         game.first_lane * game.last_lane > 0;
}

/// "leader=ambulance": true where the name is known and its value is valid.
bool take_setting(const Scenario& scenario, std::string_view name, std::string_view value, GameSettings& game) {
  if (name == "leader") {
    const auto found = find_entity(scenario, value);
    if (found) game.leader = *found;
    return found.has_value();
  }
  if (name == "lanes") return read_lanes(value, game);
  if (name == "near") return read_bounded(value, 5.0, 1e4, game.near_m);
  if (name == "lost") return read_bounded(value, 5.0, 1e4, game.lost_m);
  if (name == "lost_s") return read_bounded(value, 0.1, 1e4, game.lost_s);
  if (name == "level_s") return read_bounded(value, 1.0, 1e4, game.level_s);
  if (name == "seconds") return read_bounded(value, 1.0, 1e5, game.seconds);
  if (name == "move_s") return read_bounded(value, 1.0, 1e4, game.move_s);
  if (name == "more_vehicles") return read_bounded(value, std::uint32_t{0}, std::uint32_t{1000}, game.more_vehicles);
  return false;
}

}  // namespace

void read_game(Reading& reading, const Element& command) {
  GameSettings game;
  std::istringstream words(command.content());
  for (std::string word; words >> word;) {
    const auto equals = word.find('=');
    if (equals == std::string::npos || !take_setting(reading.scenario, std::string_view(word).substr(0, equals),
                                                     std::string_view(word).substr(equals + 1), game))
      return command.error(
          "the game has no such setting, or not with that value: " + word.substr(0, 60),
          "write leader=ENTITY lanes=FIRST..LAST and what engine/scenario/model/game_settings.hpp names");
  }
  if (game.leader == no_entity || game.first_lane == 0 || game.lost_m < game.near_m)
    return command.error("leader or lanes are missing, or lost is below near",
                         "write leader=ENTITY lanes=FIRST..LAST, and lost=METRES not below near=METRES");
  reading.scenario.game = game;
}

}  // namespace septet::scenario
