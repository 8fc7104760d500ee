#include "engine/film_script/film_script.hpp"

#include <cmath>

#include <fmt/core.h>
#include <toml++/toml.h>

#include "engine/document/table_reader.hpp"
#include "engine/document/toml_table.hpp"

namespace septet::film {
namespace {

constexpr double longest_s = 1e6;
constexpr double radians = std::numbers::pi / 180.0;
constexpr const char* documented_in = "sim-client/film/FILM.md";

using document::TableReader;

double get_angle(TableReader& reader, std::string_view key, double fallback_rad, double most_deg) {
  return radians * reader.get_double(key, fallback_rad / radians, -most_deg, most_deg);
}

double get_required(TableReader& reader, const toml::table& table, std::string_view key, double low, double high) {
  if (!table.contains(key))
    reader.report(key, fmt::format("a table lacks the key \"{}\"", key), fmt::format("add {}, a number", key));
  return reader.get_double(key, low, low, high);
}

Turn read_turn(const toml::table& table, const Turn& before, double to_s, std::string_view file, Error& error) {
  TableReader reader(table, file, "shot.turn", error);
  Turn turn;
  turn.until_s = reader.get_double("until_s", to_s, 0.0, longest_s);
  turn.heading_rad = get_angle(reader, "heading_deg", before.heading_rad, 360.0);
  turn.pitch_rad = get_angle(reader, "pitch_deg", before.pitch_rad, 90.0);
  turn.sigma = reader.get_double("sigma", 0.0, -1.0, 1.0);
  if (turn.until_s <= before.until_s)
    reader.report("until_s", "a turn ends before it begins",
                  "let until_s be later than the shot's from_s and the turn's before it");
  if (turn.until_s > to_s)
    reader.report("until_s", "a turn ends after its shot", "let until_s be at most the shot's to_s");
  reader.finish(documented_in);
  return turn;
}

Vec3 read_place(const toml::table& table, std::string_view file, std::string_view name, Error& error) {
  TableReader reader(table, file, std::string(name), error);
  Vec3 place_m;
  place_m.x = get_required(reader, table, "x_m", -5e5, 5e5);
  place_m.y = get_required(reader, table, "y_m", -5e5, 5e5);
  place_m.z = get_required(reader, table, "z_m", -1e4, 1e4);
  reader.finish(documented_in);
  return place_m;
}

/// Members that a shot and its second camera have in common.
template <class Camera>
void read_camera(Camera& camera, TableReader& reader, const toml::table& table, std::string_view file, Error& error) {
  camera.participant = reader.get_string("participant", camera.participant);
  if (const toml::table* place = reader.get_table("place"))
    camera.place_m = read_place(*place, file, "shot.place", error);
  else if (table.contains("place"))
    reader.report("place", "shot.place is not a table", "write { x_m = 1.0, y_m = 2.0, z_m = 3.0 }");
  if (camera.place_m && table.contains("participant"))
    reader.report("participant", "a shot hangs on a participant or on a place, not on both", "leave one of them out");
  camera.distance_m = reader.get_double("distance_m", 0.0, 0.0, 1000.0);
  camera.bearings =
      static_cast<Bearings>(reader.get_choice("bearings", camera.place_m ? 1 : 0, {"vehicle", "world", "gaze"}));
  if (camera.distance_m > 0.0 && camera.bearings == Bearings::gaze)
    reader.report("bearings", "a camera that looks at a participant from outside has no gaze of theirs",
                  "leave distance_m out, or write \"vehicle\"");
  if (camera.place_m && camera.bearings != Bearings::world)
    reader.report("bearings", "a place has no heading that others could be counted from",
                  "leave bearings out, or write \"world\"");
  camera.heading_rad = get_angle(reader, "heading_deg", 0.0, 360.0);
  camera.pitch_rad = get_angle(reader, "pitch_deg", 0.0, 90.0);
  camera.field_of_view_rad =
      radians * reader.get_double("field_of_view_deg", camera.field_of_view_rad / radians, 1.0, 150.0);
  camera.interior = reader.get_bool("interior", camera.interior);
  camera.title = reader.get_string("title", camera.title);
}

Shot read_shot(const toml::table& table, std::string_view file, Error& error) {
  TableReader reader(table, file, "shot", error);
  Shot shot;
  shot.from_s = get_required(reader, table, "from_s", 0.0, longest_s);
  shot.to_s = get_required(reader, table, "to_s", 0.0, longest_s);
  if (shot.to_s <= shot.from_s)
    reader.report("to_s", fmt::format("the shot lasts from {} to {} s", shot.from_s, shot.to_s),
                  "let to_s be later than from_s");
  shot.speed = reader.get_double("speed", 1.0, 0.01, 100.0);
  read_camera(shot, reader, table, file, error);
  shot.f_number = reader.get_double("f_number", 0.0, 0.5, 128.0);
  shot.focus_m = reader.get_double("focus_m", shot.distance_m > 0.0 ? shot.distance_m : shot.focus_m, 0.1, 1e5);
  if (table.contains("focus_m") && !table.contains("f_number"))
    reader.report("focus_m", "a pinhole is sharp everywhere", "add f_number, or leave focus_m out");
  shot.shutter_rad = radians * reader.get_double("shutter_deg", 0.0, 0.0, 360.0);
  shot.overlay = reader.get_bool("overlay", shot.overlay);
  shot.paths = reader.get_bool("paths", shot.paths);
  if (shot.paths && !shot.overlay)
    reader.report("paths", "ways are a part of the overlay", "add overlay = true, or leave paths out");
  if (const toml::table* beside = reader.get_table("beside")) {
    TableReader of_second(*beside, file, "shot.beside", error);
    read_camera(shot.beside.emplace(), of_second, *beside, file, error);
    of_second.finish(documented_in);
  } else if (table.contains("beside")) {
    reader.report("beside", "shot.beside is not a table", "write [shot.beside] with the keys of its camera");
  }
  Turn before{shot.from_s, shot.heading_rad, shot.pitch_rad, 0.0};
  const auto turns = reader.get_tables("turn");
  if (turns.size() > most_turns)
    reader.report("turn", fmt::format("a shot has more than {} turns", most_turns), "split it");
  for (const toml::table* turn : turns) {
    if (!error.what.empty()) break;
    shot.turns.push_back(before = read_turn(*turn, before, shot.to_s, file, error));
  }
  reader.finish(documented_in);
  return shot;
}

std::vector<std::string> read_texts(TableReader& reader, std::string_view key) {
  std::vector<std::string> texts;
  const toml::array* list = reader.get_array(key);
  if (!list) return texts;
  if (list->size() > most_overlay_texts)
    reader.report(key, fmt::format("there are more than {} of them", most_overlay_texts), "leave some out");
  for (const toml::node& node : *list) {
    const auto text = node.value<std::string>();
    if (!text) reader.report(key, "it is not a list of texts", "write [\"one\", \"two\"]");
    if (!text || texts.size() == most_overlay_texts) break;
    texts.push_back(*text);
  }
  return texts;
}

Overlay read_overlay(const toml::table& table, std::string_view file, Error& error) {
  TableReader reader(table, file, "overlay", error);
  Overlay overlay;
  if (table.contains("contact_s")) overlay.contact_s = reader.get_double("contact_s", 0.0, 0.0, longest_s);
  overlay.contact = reader.get_string("contact", overlay.contact);
  if (const toml::table* place = reader.get_table("contact_place"))
    overlay.contact_m = read_place(*place, file, "overlay.contact_place", error);
  else if (table.contains("contact_place"))
    reader.report("contact_place", "overlay.contact_place is not a table", "write { x_m = 1.0, y_m = 2.0, z_m = 3.0 }");
  overlay.participants = read_texts(reader, "participants");
  overlay.notes = read_texts(reader, "notes");
  reader.finish(documented_in);
  return overlay;
}

}  // namespace

Shot shot_beside(const Shot& shot) {
  Shot second = shot;
  const SecondCamera& camera = shot.beside.value();
  second.participant = camera.participant;
  second.place_m = camera.place_m;
  second.distance_m = camera.distance_m;
  second.bearings = camera.bearings;
  second.heading_rad = camera.heading_rad;
  second.pitch_rad = camera.pitch_rad;
  second.field_of_view_rad = camera.field_of_view_rad;
  second.interior = camera.interior;
  second.title = camera.title;
  second.turns.clear();
  second.beside.reset();
  return second;
}

Expected<Script> read_script(std::string_view text, std::string_view name) {
  const auto document = document::parse_toml(text, name);
  if (!document) return tl::unexpected(document.error());
  Error error;
  TableReader reader(*document, name, "film", error);
  Script script;
  const auto shots = reader.get_tables("shot");
  if (shots.empty()) reader.report("shot", "the film has no shot", "add a [[shot]]");
  if (shots.size() > most_shots)
    reader.report("shot", fmt::format("the film has more than {} shots", most_shots), "split it");
  if (const toml::table* overlay = reader.get_table("overlay"))
    script.overlay = read_overlay(*overlay, name, error);
  else if (document->contains("overlay"))
    reader.report("overlay", "overlay is not a table", "write [overlay] with its keys");
  for (const toml::table* table : shots) {
    if (!error.what.empty()) break;
    script.shots.push_back(read_shot(*table, name, error));
    script.shots.back().where = fmt::format("{}, shot {}", name, script.shots.size());
  }
  reader.finish(documented_in);
  if (!error.what.empty()) return tl::unexpected(error);
  return script;
}

Script default_script(double from_s, double to_s, double frames_per_second) {
  constexpr double least_frames = 20.0;
  const double frames = (to_s - from_s) * frames_per_second;
  // Shots meet at frames, so that time goes on evenly.
  const auto at = [&](double share) { return from_s + std::round(share * frames) / frames_per_second; };
  const std::string where = "film without a script";
  Shot eyes{.from_s = from_s, .to_s = frames < least_frames ? to_s : at(0.3), .where = where};
  if (frames < least_frames) return {{eyes}};
  Shot around{.from_s = eyes.to_s, .to_s = at(0.75), .distance_m = 8.0, .where = where};
  around.heading_rad = 150.0 * radians, around.pitch_rad = -14.0 * radians;
  // The even part turns by 160° in half of the shot; speeding up to that rate takes 40° in a quarter of it, and so does
  // slowing down.
  around.turns = {{at(0.4125), 110.0 * radians, -13.0 * radians, 1.0},
                  {at(0.6375), -50.0 * radians, -9.0 * radians, 0.0},
                  {at(0.75), -90.0 * radians, -8.0 * radians, -1.0}};
  Shot nearest{.from_s = around.to_s, .to_s = to_s, .participant = "nearest", .where = where};
  return {{eyes, around, nearest}};
}

double lens_radius_m(const Shot& shot) {
  constexpr double half_film_m = 0.018;
  return shot.f_number > 0.0 ? half_film_m / std::tan(0.5 * shot.field_of_view_rad) / (2.0 * shot.f_number) : 0.0;
}

}  // namespace septet::film
