#include "sim-client/frame/instruments.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "car-io/driving_keys.hpp"
#include "engine/world/car_warnings.hpp"
#include "engine/world/guidance.hpp"
#include "engine/world/guidance_words.hpp"
#include "sim-client/frame/cockpit_drawing.hpp"

namespace septet::frame {
namespace {

constexpr glm::vec4 white{0.95f, 0.95f, 0.95f, 1.0f}, green{0.3f, 0.95f, 0.4f, 1.0f}, amber{1.0f, 0.75f, 0.2f, 1.0f},
    red{1.0f, 0.4f, 0.35f, 1.0f}, panel{0.05f, 0.05f, 0.06f, 0.6f}, dark_panel{0.05f, 0.05f, 0.06f, 0.8f};

std::string gear_text(int gear) { return gear < 0 ? "R" : gear == 0 ? "N" : std::to_string(gear); }

instant::OverlayText line(std::string text, double x_px, double y_px, double height_px, const glm::vec4& color) {
  return {.text = std::move(text),
          .x_px = static_cast<float>(x_px),
          .y_px = static_cast<float>(y_px),
          .height_px = static_cast<float>(height_px),
          .color = color};
}

/// Height that letters are a share of: the screen's, or less on an upright screen, so that lines fit into it.
double height_for_letters_px(const rig::Screen& screen) {
  return std::min<double>(screen.height_px, 0.75 * screen.width_px);
}

/// Lines of a text, wrapped between words to the screen's width; empty for an empty text.
std::vector<std::string> lines_of(const std::string& text, const rig::Screen& screen, double first_px, double next_px) {
  constexpr double letter = 0.45;  // Mean width of a letter over the height of its line.
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::size_t until = end;
    const double height_px = lines.empty() ? first_px : next_px;
    const auto most = static_cast<std::size_t>(std::max(20.0, 0.9 * screen.width_px / (letter * height_px)));
    if (end - at > most) {
      const std::size_t space = text.rfind(' ', at + most);
      if (space != std::string::npos && space > at) until = space;
    }
    lines.push_back(text.substr(at, until - at));
    at = until + 1;
  }
  return lines;
}

/// Lit warning lamps, in words; empty if none is lit.
std::string warning_text(const CarWarnings& warnings) {
  std::string text;
  const auto add = [&](bool is_lit, const char* words) {
    if (is_lit) text += (text.empty() ? "" : "   ") + std::string(words);
  };
  add(warnings.tyre_pressure, "tyre pressure");
  add(warnings.anti_lock, "ABS off");
  add(warnings.engine, "engine fault");
  add(warnings.lamp, "lamp out");
  return text;
}

instant::OverlayText in_the_middle(const std::string& text, const rig::Screen& screen, double y_px, double height_px) {
  auto result = line(text, 0.5 * screen.width_px, y_px, height_px, white);
  result.centered = true;
  result.background = dark_panel;
  return result;
}

}  // namespace

std::vector<instant::OverlayText> instruments(const Snapshot& shown, const rig::Rig& rig, const rig::Screen& screen) {
  std::vector<instant::OverlayText> texts;
  if (!screen.instruments) return texts;
  const DriverCar& car = shown.driver_car;
  const Participant* participant = find_participant(shown, car.participant);
  const Lamps lamps = participant ? participant->lamps : Lamps{};
  const double height_px = std::max(12.0, std::round(height_for_letters_px(screen) / 17.0)),
               small_px = std::max(9.0, std::round(0.55 * height_px));
  const double half_width_px = 4.5 * height_px, width_px = screen.width_px;
  const auto ahead = rig::point_ahead(rig, screen);
  const double x = std::clamp((ahead ? ahead->x : 0.5) * width_px, std::min(half_width_px, 0.5 * width_px),
                              std::max(width_px - half_width_px, 0.5 * width_px));
  const double y = screen.height_px - 0.7 * height_px - small_px;
  const auto add = [&](std::string text, double from_middle_px, double y_px, double size_px, const glm::vec4& color) {
    texts.push_back(line(std::move(text), x + from_middle_px, y_px, size_px, color));
    texts.back().background = panel;
    texts.back().centered = true;
  };
  const double kmh = std::round(std::abs(car.speed_mps) * 3.6);
  if (!screen.show_interior) {
    add(fmt::format("{:.0f} km/h   {}", kmh, gear_text(car.gear)), 0.0, y, height_px, white);
    if (lamps.has(Lamp::indicator_left)) add("◀", -half_width_px + 0.5 * height_px, y, height_px, green);
    if (lamps.has(Lamp::indicator_right)) add("▶", half_width_px - 0.5 * height_px, y, height_px, green);
  }
  const double below_px = screen.height_px - 0.6 * small_px;
  if (is_stalled(car)) add("engine stalled", 0.0, below_px, small_px, red);
  // Above the dials' middle, as a car's own display has it.
  if (const std::string warnings = warning_text(car_warnings_of(shown)); !warnings.empty())
    add(warnings, 0.0, below_px - small_px - 6.0, small_px, amber);
  return texts;
}

std::vector<instant::OverlayText> guidance_texts(const Snapshot& shown, const rig::Rig& rig,
                                                 const rig::Screen& screen) {
  std::vector<instant::OverlayText> texts;
  if (&screen != &rig::screen_ahead(rig)) return texts;
  const auto guidance = guidance_of(shown);
  if (!guidance) return texts;
  constexpr double read_s = 6.0, ticks_ps = 120.0;
  const double height_px = std::max(12.0, std::round(height_for_letters_px(screen) / 20.0));
  const auto ahead = rig::point_ahead(rig, screen);
  const double first_px = std::round(0.18 * screen.height_px);  // As a game's standing.
  const auto add = [&](std::string text, double y_px, double size_px) {
    texts.push_back(line(std::move(text), (ahead ? ahead->x : 0.5) * screen.width_px, y_px, size_px, white));
    texts.back().background = panel;
    texts.back().centered = true;
  };
  add(guidance_arrow(*guidance), first_px, height_px);
  const bool is_fresh =
      shown.tick >= guidance->told_at && static_cast<double>(shown.tick - guidance->told_at) < read_s * ticks_ps;
  if (guidance->told_count > 0 && is_fresh)
    add(guidance_sentence(guidance->told, "en"), first_px + height_px + 6.0, std::round(0.7 * height_px));
  return texts;
}

std::vector<instant::OverlayText> game_standing(const Snapshot& shown, const rig::Rig& rig, const rig::Screen& screen) {
  std::vector<instant::OverlayText> texts;
  if (!shown.game || &screen != &rig::screen_ahead(rig)) return texts;
  const GameStanding& game = *shown.game;
  const double height_px = std::max(12.0, std::round(height_for_letters_px(screen) / 20.0));
  const auto ahead = rig::point_ahead(rig, screen);
  const auto add = [&](std::string text, double y_px, const glm::vec4& color) {
    texts.push_back(line(std::move(text), (ahead ? ahead->x : 0.5) * screen.width_px, y_px, height_px, color));
    texts.back().background = panel;
    texts.back().centered = true;
  };
  const auto seconds = static_cast<std::int64_t>(std::clamp(game.survived_s, 0.0, 1e6));
  const double first_px = std::round(0.18 * screen.height_px),  // Below the inside mirror of rigs that draw it there.
      second_px = first_px + height_px + 6.0;
  add(fmt::format("level {}   {:.0f} points   {}:{:02}", game.level, game.points, seconds / 60, seconds % 60), first_px,
      white);
  switch (game.end) {
    case GameEnd::none:
      if (game.away_s > 0.0) add("the ambulance is getting away", second_px, red);
      break;
    case GameEnd::lost:
      add("game over: the ambulance is gone", second_px, amber);
      break;
    case GameEnd::crash:
      add("game over: a crash", second_px, amber);  // Whose it was is told beside it.
      break;
    case GameEnd::time:
      add("you have come through", second_px, green);
      break;
  }
  return texts;
}

std::vector<instant::OverlayText> eyes_caption(const std::string& name, EyesSeen seen, const rig::Rig& rig,
                                               const rig::Screen& screen) {
  std::vector<instant::OverlayText> texts;
  if (&screen != &rig::screen_ahead(rig)) return texts;
  const char* known = seen == EyesSeen::drivers  ? "head and gaze as logged"
                      : seen == EyesSeen::others ? "straight on: their gaze is not logged"
                                                 : "not there at this instant";
  const double height_px = std::max(9.0, std::round(height_for_letters_px(screen) / 28.0));
  // The driver's inside mirror hangs in the middle.
  const double share = seen == EyesSeen::drivers ? 0.13 : 0.02;
  double y_px = std::round(share * screen.height_px) + 0.5 * height_px;
  for (const std::string& words :
       lines_of(fmt::format("eyes of {}{}{}", name, seen == EyesSeen::drivers ? ": " : "\n", known), screen, height_px,
                height_px)) {
    texts.push_back(in_the_middle(words, screen, y_px, height_px));
    y_px += height_px + 4.0;
  }
  return texts;
}

std::vector<instant::OverlayText> notice(const std::string& text, const rig::Screen& screen) {
  std::vector<instant::OverlayText> texts;
  const double letters_px = height_for_letters_px(screen);
  const double large_px = std::max(12.0, letters_px / 22.0), small_px = std::max(9.0, letters_px / 32.0);
  double y_px = 0.5 * screen.height_px;
  for (const std::string& words : lines_of(text, screen, large_px, small_px)) {
    const double height_px = texts.empty() ? large_px : small_px;
    if (!texts.empty()) y_px += 0.5 * (texts.back().height_px + height_px) + 4.0;
    texts.push_back(in_the_middle(words, screen, y_px, height_px));
  }
  return texts;
}

std::vector<instant::OverlayText> key_table(const std::string& headline, const rig::Screen& screen) {
  std::vector<instant::OverlayText> texts;
  const double letters_px = height_for_letters_px(screen), next_px = std::max(8.0, letters_px / 32.0);
  const std::vector<std::string> above = lines_of(headline, screen, 1.5 * next_px, next_px);
  const double rows = static_cast<double>(car_io::driving_keys().size() + above.size()) + (above.empty() ? 0.0 : 0.5);
  constexpr double box_px = 4.0;  // Difference between a box's height and its line's.
  const double fits_px = 0.72 * screen.height_px / rows - box_px;
  const double row_px = std::clamp(std::floor(std::min(letters_px / 32.0, fits_px)), 8.0, 30.0),
               step_px = row_px + box_px;
  double y_px = std::max(0.0, std::round(0.45 * screen.height_px - 0.5 * rows * step_px));
  // Two columns, whose boxes touch: one panel.
  const double names_rows = 7.5, does_rows = row_px < 12.0 ? 26.0 : 24.5;  // Small letters are wide for their height.
  const double left_px = std::max(0.0, std::round(0.5 * screen.width_px - 0.5 * (names_rows + does_rows) * row_px)),
               names_px = std::round(names_rows * row_px), does_px = std::round(does_rows * row_px);
  for (const std::string& words : above) {
    const bool is_first = texts.empty();
    texts.push_back(in_the_middle(words, screen, y_px + 0.5 * row_px, (is_first ? 1.5 : 1.0) * row_px));
    y_px += std::round((is_first ? 1.5 : 1.0) * step_px);
  }
  const auto add = [&](std::string text, double x_px, double width_px) {
    texts.push_back(line(std::move(text), x_px, y_px, row_px, white));
    texts.back().background = dark_panel;
    texts.back().least_box_px = static_cast<float>(width_px);
  };
  for (const car_io::DrivingKey& key : car_io::driving_keys()) {
    add(car_io::names_of_keys(key), left_px, names_px);
    add(key.does, left_px + names_px, does_px);
    y_px += step_px;
  }
  return texts;
}

instant::OverlayText low_line(std::string text, const rig::Screen& screen) {
  const double height_px = std::clamp(height_for_letters_px(screen) / 36.0, 8.0, 22.0);
  auto result = line(std::move(text), 0.01 * screen.width_px, screen.height_px - 4.0 * height_px, height_px, amber);
  result.background = dark_panel;
  return result;
}

}  // namespace septet::frame
