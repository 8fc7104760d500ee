#include "engine/rig/sight_reader.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>

#include <fmt/core.h>
#include <toml++/toml.h>

#include "engine/core/printable.hpp"
#include "engine/rig/network_reader.hpp"

namespace septet::rig {

using document::TableReader;

void read_window(TableReader& reader, Window& window) {
  window.lower_left_m = reader.get_point("lower_left_m");
  window.lower_right_m = reader.get_point("lower_right_m");
  window.upper_left_m = reader.get_point("upper_left_m");
  const Vec3 right = window.lower_right_m - window.lower_left_m, up = window.upper_left_m - window.lower_left_m;
  const double width = glm::length(right), height = glm::length(up);
  if (width < 0.01 || height < 0.01)
    reader.report("lower_left_m", "the corners of a screen lie on each other", "give its corners at least 1 cm apart");
  else if (std::abs(glm::dot(right, up)) > 1e-4 * width * height)
    reader.report("upper_left_m", "the corners of a screen are not those of a rectangle",
                  "make the edge lower_left to lower_right perpendicular to the edge lower_left to upper_left");
}

Mirror read_mirror(const toml::table& table, const Vec3& eye_point_m, std::string_view file, Error& error) {
  TableReader reader(table, file, "mirror", error);
  Mirror mirror;
  mirror.name = reader.get_string("name", "");
  constexpr std::size_t longest_name = 40;
  if (mirror.name.empty() || mirror.name.size() > longest_name ||
      mirror.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789- ") != std::string::npos)
    reader.report("name", fmt::format("mirror.name is \"{}\"", printable(mirror.name)),
                  "use up to 40 small letters, digits, hyphens and spaces");
  read_window(reader, mirror.glass);
  mirror.radius_m = reader.get_double("radius_m", 0.0, 0.0, 1000.0);
  if (mirror.radius_m > 0.0 && mirror.radius_m < 0.1)
    reader.report("radius_m", "a glass of that curvature is a ball", "give its radius in metres, or leave it out");
  constexpr double degree = std::numbers::pi / 180.0, beside = 15.0 * degree;
  const Vec3 middle = 0.5 * (mirror.glass.lower_right_m + mirror.glass.upper_left_m) - eye_point_m;
  const double heading = std::atan2(middle.y, middle.x);
  mirror.from_rad = degree * reader.get_double("zone_from_deg", (heading - beside) / degree, -200.0, 200.0);
  mirror.to_rad = degree * reader.get_double("zone_to_deg", (heading + beside) / degree, -200.0, 200.0);
  if (mirror.from_rad >= mirror.to_rad)
    reader.report("zone_to_deg", "a mirror's zone ends where it begins, or before",
                  "give zone_from_deg and zone_to_deg in degrees to the left, the lesser first");
  reader.finish(documented_in);
  return mirror;
}

namespace {

HeadAxis read_head_axis(TableReader& reader, std::string_view key, const HeadAxis& fallback) {
  constexpr std::string_view names[] = {"x", "y", "z", "yaw", "pitch", "roll"};
  const std::string_view usual = names[static_cast<std::size_t>(fallback.of)];
  const std::string text = reader.get_string(key, (fallback.inverted ? "-" : "") + std::string(usual));
  HeadAxis axis{.of = {}, .inverted = text.starts_with('-')};
  const auto found = std::ranges::find(names, std::string_view(text).substr(axis.inverted ? 1 : 0));
  if (found == std::end(names))
    reader.report(key, fmt::format("head.{} is \"{}\"", key, printable(text)),
                  "write x, y, z, yaw, pitch or roll, with a - before it where the tracker counts the other way");
  else
    axis.of = static_cast<HeadAxis::Of>(found - std::begin(names));
  return axis;
}

}  // namespace

HeadTracking read_head(const toml::table& table, std::string_view file, Error& error) {
  TableReader reader(table, file, "head", error);
  HeadTracking head;
  head.listen = reader.get_string("listen", head.listen);
  check_address(reader, "head.listen", head.listen);
  head.port = static_cast<std::uint16_t>(reader.get_integer("port", head.port, 1, 65535));
  head.forward = read_head_axis(reader, "forward", head.forward);
  head.left = read_head_axis(reader, "left", head.left);
  head.up = read_head_axis(reader, "up", head.up);
  head.turn_left = read_head_axis(reader, "turn_left", head.turn_left);
  if (table.contains("reach_m")) head.reach_m = reader.get_point("reach_m");
  for (int i = 0; i < 3; ++i)
    if (!(head.reach_m[i] >= 0.0 && head.reach_m[i] <= 1.0))
      reader.report("reach_m", "head.reach_m is not from 0 to 1 m to each side",
                    "give how far the eyes may be forward, left and up of the eye point");
  reader.finish(documented_in);
  return head;
}

void check_sight(const Rig& rig, TableReader& reader) {
  const Vec3 reach_m = rig.head ? rig.head->reach_m : Vec3(0.0);
  const auto is_seen = [&](const Window& window, const Vec3& eye_m) {
    const Vec3 back = glm::cross(window.lower_right_m - window.lower_left_m, window.upper_left_m - window.lower_left_m);
    return glm::dot(eye_m - window.lower_left_m, back) > 0.01 * glm::length(back);
  };
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 side((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0, (corner & 4) != 0 ? 1.0 : -1.0);
    const Vec3 eye_m = rig.eye_point_m + side * reach_m;
    for (const Screen& screen : rig.screens)
      for (const View& view : screen.views)
        if (rig.head && !view.mirror && !is_seen(view.window, eye_m))
          return reader.report("head",
                               fmt::format("within head.reach_m the eyes come to or behind the screen {}", screen.name),
                               "make head.reach_m smaller");
    for (const Mirror& mirror : rig.mirrors)
      if (!is_seen(mirror.glass, eye_m))
        return reader.report("mirror", fmt::format("the glass of {} is not seen from its front", mirror.name),
                             rig.head ? "order its corners as the driver sees them, or make head.reach_m smaller"
                                      : "order its corners as the driver sees them");
  }
}

}  // namespace septet::rig
