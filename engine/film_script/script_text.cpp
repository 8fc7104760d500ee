#include "engine/film_script/script_text.hpp"

#include <string_view>

#include <fmt/core.h>

namespace septet::film {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

/// A basic string of TOML. Control characters other than these two have no use in a script and become blanks.
std::string quoted_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  quoted += '"';
  return quoted;
}

/// TOML tells a float by its point.
std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string degrees_text(double angle_rad) {
  std::string text = fmt::format("{:.6f}", angle_rad * degrees);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text += '0';
  return text == "-0.0" ? "0.0" : text;
}

std::string place_text(std::string_view key, const Vec3& place_m) {
  return fmt::format("{} = {{ x_m = {}, y_m = {}, z_m = {} }}\n", key, number_text(place_m.x), number_text(place_m.y),
                     number_text(place_m.z));
}

template <class Camera>
std::string camera_text(const Camera& camera) {
  const Camera usual;
  std::string text;
  if (!camera.title.empty()) text += fmt::format("title = {}\n", quoted_text(camera.title));
  if (camera.place_m)
    text += place_text("place", *camera.place_m);
  else
    text += fmt::format("participant = {}\n", quoted_text(camera.participant));
  if (camera.distance_m != usual.distance_m) text += fmt::format("distance_m = {}\n", number_text(camera.distance_m));
  if (camera.bearings == Bearings::gaze) text += "bearings = \"gaze\"\n";
  if (camera.bearings == Bearings::world && !camera.place_m) text += "bearings = \"world\"\n";
  if (camera.heading_rad != usual.heading_rad)
    text += fmt::format("heading_deg = {}\n", degrees_text(camera.heading_rad));
  if (camera.pitch_rad != usual.pitch_rad) text += fmt::format("pitch_deg = {}\n", degrees_text(camera.pitch_rad));
  if (camera.field_of_view_rad != usual.field_of_view_rad)
    text += fmt::format("field_of_view_deg = {}\n", degrees_text(camera.field_of_view_rad));
  if (camera.interior) text += "interior = true\n";
  return text;
}

std::string shot_text(const Shot& shot) {
  const Shot usual;
  std::string text =
      fmt::format("\n[[shot]]\nfrom_s = {}\nto_s = {}\n", number_text(shot.from_s), number_text(shot.to_s));
  if (shot.speed != usual.speed) text += fmt::format("speed = {}\n", number_text(shot.speed));
  text += camera_text(shot);
  if (shot.f_number > 0.0)
    text += fmt::format("f_number = {}\nfocus_m = {}\n", number_text(shot.f_number), number_text(shot.focus_m));
  if (shot.shutter_rad > 0.0) text += fmt::format("shutter_deg = {}\n", degrees_text(shot.shutter_rad));
  if (shot.overlay) text += "overlay = true\n";
  if (shot.paths) text += "paths = true\n";
  for (const Turn& turn : shot.turns)
    text += fmt::format("[[shot.turn]]\nuntil_s = {}\nheading_deg = {}\npitch_deg = {}\nsigma = {}\n",
                        number_text(turn.until_s), degrees_text(turn.heading_rad), degrees_text(turn.pitch_rad),
                        number_text(turn.sigma));
  if (shot.beside) text += "[shot.beside]\n" + camera_text(*shot.beside);
  return text;
}

std::string list_text(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) {
    if (!list.empty()) list += ", ";
    list += quoted_text(text);
  }
  return list;
}

}  // namespace

std::string text_of(const Script& script) {
  std::string text;
  const Overlay& overlay = script.overlay;
  if (overlay.contact_s || overlay.contact_m || !overlay.participants.empty() || !overlay.notes.empty())
    text += "[overlay]\n";
  if (overlay.contact_s) text += fmt::format("contact_s = {}\n", number_text(*overlay.contact_s));
  if (overlay.contact != Overlay{}.contact) text += fmt::format("contact = {}\n", quoted_text(overlay.contact));
  if (overlay.contact_m) text += place_text("contact_place", *overlay.contact_m);
  if (!overlay.participants.empty()) text += fmt::format("participants = [{}]\n", list_text(overlay.participants));
  if (!overlay.notes.empty()) text += fmt::format("notes = [{}]\n", list_text(overlay.notes));
  for (const Shot& shot : script.shots) text += shot_text(shot);
  return text;
}

}  // namespace septet::film
