#include "sim-client/film/overlay/overlay_content.hpp"
#include "engine/math/speed_units.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/rider.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace septet::film {
namespace {

constexpr double text_share = 1.0 / 28.0, least_text_px = 9.0;
constexpr double far_outside = 4.0;  ///< Pictures' widths from the middle, beyond which a point is not drawn.

/// Lines from the upper left down, each as wide as its text.
class Column {
 public:
  Column(OverlayContent& content, const image::Font& font, const OverlaySizes& sizes, std::int64_t x, std::int64_t y)
      : content_(content), font_(font), sizes_(sizes), x_(x), left_(x), y_(y) {}

  void add(const std::string& text, image::Color color = {255, 255, 255, 255}) { put(text, color, false); }
  void add_figure(const std::string& text) { put(text, {255, 255, 255, 255}, true); }
  void next_line() { x_ = left_, y_ += sizes_.line_px; }

 private:
  void put(const std::string& text, image::Color color, bool is_figure) {
    const std::int64_t width =
        is_figure ? static_cast<std::int64_t>(text.size()) * sizes_.cell_px
                  : static_cast<std::int64_t>(std::ceil(font_.width_px(text, sizes_.text_px))) + sizes_.cell_px;
    content_.lines.push_back({text, x_, y_, width, sizes_.line_px, is_figure, color});
    x_ += width;
  }

  OverlayContent& content_;
  const image::Font& font_;
  const OverlaySizes& sizes_;
  std::int64_t x_, left_, y_;
};

/// Words of a text in lines that are no wider.
std::vector<std::string> wrapped(const image::Font& font, std::string_view text, double text_px, double width_px) {
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const std::string word(text.substr(0, text.find(' ')));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    const std::string longer = lines.back().empty() ? word : fmt::format("{} {}", lines.back(), word);
    if (!lines.back().empty() && font.width_px(longer, text_px) > width_px)
      lines.push_back(word);
    else
      lines.back() = longer;
  }
  return lines;
}

bool is_from_outside(const Shot& shot) { return shot.place_m || shot.distance_m > 0.0; }

void add_notes(const OverlayMoment& moment, const image::Font& font, const OverlaySizes& sizes,
               OverlayContent& content) {
  std::vector<std::string> lines;
  const double room_px = static_cast<double>(moment.width_px) - 2.0 * static_cast<double>(sizes.cell_px);
  for (const std::string& note : moment.script.overlay.notes)
    for (std::string& line : wrapped(font, note, sizes.text_px, room_px)) lines.push_back(std::move(line));
  auto y = static_cast<std::int64_t>(moment.height_px) - static_cast<std::int64_t>(lines.size()) * sizes.line_px;
  for (std::string& line : lines) {
    content.lines.push_back({std::move(line), 0, y, moment.width_px, sizes.line_px, false, {225, 225, 225, 255}});
    y += sizes.line_px;
  }
}

/// Outline of a participant's body on the ground, the way until now and the way to come.
void add_way(const OverlayMoment& moment, const instant::FrameView& view, std::size_t n, OverlayContent& content) {
  const image::Color color = color_of(n);
  const double thick_px = std::max(1.5, 0.006 * moment.height_px);
  const auto add = [&](const std::vector<Vec3>& places_m, double width_px, std::uint8_t alpha) {
    OverlayStroke stroke{{}, width_px, {color.red, color.green, color.blue, alpha}};
    for (const Vec3& place_m : places_m)
      if (const auto pixel = pixel_of(view, place_m)) stroke.points.push_back(*pixel);
    if (stroke.points.size() > 1) content.strokes.push_back(std::move(stroke));
  };
  if (n < moment.ways.size()) {
    std::vector<Vec3> past_m, to_come_m;
    const OverlayWay& way = moment.ways[n];
    for (std::size_t i = 0; i < way.times_s.size(); ++i)
      (way.times_s[i] <= moment.world.simulated_time_s ? past_m : to_come_m).push_back(way.places_m[i]);
    if (const Participant* now = find_person(moment.world, moment.people[n].number)) {
      past_m.push_back(now->world_from_vehicle.position_m);
      to_come_m.insert(to_come_m.begin(), now->world_from_vehicle.position_m);
    }
    add(to_come_m, 0.5 * thick_px, 150);
    add(past_m, thick_px, 235);
  }
  if (const Participant* now = find_person(moment.world, moment.people[n].number)) {
    const VehicleModel model = shape_of(*now);
    const double front = model.front_m(), rear = -model.rear_overhang_m, side = model.width_m / 2.0;
    std::vector<Vec3> outline_m;
    for (const Vec3& corner : {Vec3(front, side, 0.0), Vec3(rear, side, 0.0), Vec3(rear, -side, 0.0),
                               Vec3(front, -side, 0.0), Vec3(front, side, 0.0)})
      outline_m.push_back(now->world_from_vehicle * corner);
    add(outline_m, 0.5 * thick_px, 255);
  }
}

/// A ring and a cross where the contact is, dark beneath and white above, so that they show on any ground.
void add_contact(const OverlayMoment& moment, const instant::FrameView& view, OverlayContent& content) {
  if (!moment.script.overlay.contact_m) return;
  const auto pixel = pixel_of(view, *moment.script.overlay.contact_m);
  const instant::PixelRectangle& box = view.viewport;
  const double radius_px = std::max(5.0, 0.018 * moment.height_px), thick_px = std::max(1.5, 0.004 * moment.height_px);
  if (!pixel || pixel->x < box.x + radius_px || pixel->x > box.x + box.width - radius_px ||
      pixel->y < box.y + radius_px || pixel->y > box.y + box.height - radius_px)
    return;
  constexpr int ring_corners = 24;
  const auto at = [&](double x, double y) { return image::Point{pixel->x + radius_px * x, pixel->y + radius_px * y}; };
  std::vector<image::Point> ring;
  for (int n = 0; n <= ring_corners; ++n) {
    const double angle_rad = 2.0 * std::numbers::pi * n / ring_corners;
    ring.push_back(at(std::cos(angle_rad), std::sin(angle_rad)));
  }
  const std::array<std::vector<image::Point>, 3> lines{
      ring, {at(-0.6, -0.6), at(0.6, 0.6)}, {at(-0.6, 0.6), at(0.6, -0.6)}};
  for (const auto& [width, color] : {std::pair(2.2 * thick_px, image::Color{16, 18, 22, 255}),
                                     std::pair(thick_px, image::Color{255, 255, 255, 255})})
    for (const std::vector<image::Point>& line : lines) content.strokes.push_back({line, width, color});
}

void add_label(const OverlayMoment& moment, const instant::FrameView& view, std::size_t n, const image::Font& font,
               const OverlaySizes& sizes, OverlayContent& content) {
  const Participant* now = find_person(moment.world, moment.people[n].number);
  if (!now) return;
  const VehicleModel model = shape_of(*now);
  const auto pixel = pixel_of(view, now->world_from_vehicle * Vec3(model.centre_x_m(), 0.0, model.height_m + 0.3));
  if (!pixel) return;
  const auto width =
      static_cast<std::int64_t>(std::ceil(font.width_px(moment.people[n].name, sizes.text_px))) + sizes.cell_px;
  const instant::PixelRectangle& box = view.viewport;
  const std::int64_t x = std::lround(pixel->x) + sizes.line_px;
  std::int64_t y = std::lround(pixel->y) - 2 * sizes.line_px;
  const auto covers = [&](const OverlayLine& other) {
    return x < other.x + other.width && other.x < x + width && y < other.y + other.height &&
           other.y < y + sizes.line_px;
  };
  for (std::size_t tries = 0; tries < moment.people.size() && std::ranges::any_of(content.lines, covers); ++tries)
    y -= sizes.line_px;
  if (x < box.x || y < box.y || x + width > box.x + std::int64_t{box.width} || y + sizes.line_px > box.height) return;
  content.strokes.push_back(
      {{*pixel, {static_cast<double>(x), static_cast<double>(y + sizes.line_px)}}, 1.0, color_of(n)});
  content.lines.push_back({moment.people[n].name, x, y, width, sizes.line_px, false, color_of(n)});
}

}  // namespace

image::Color color_of(std::size_t n) {
  static constexpr std::array<image::Color, 6> colors{image::Color{230, 159, 0, 255},
                                                      {86, 180, 233, 255},
                                                      {0, 158, 115, 255},
                                                      {240, 228, 66, 255},
                                                      {213, 94, 0, 255},
                                                      {204, 121, 167, 255}};
  return colors[n % colors.size()];
}

std::string clock_text(double time_s) { return fmt::format("{:7.2f}", time_s); }

std::string contact_clock_text(double time_s, double contact_s) {
  const double rounded_s = std::round(100.0 * (time_s - contact_s)) / 100.0;
  return fmt::format("{:+7.2f}", rounded_s == 0.0 ? 0.0 : rounded_s);
}

std::string speed_text(const Participant* participant) {
  if (!participant) return " --.-";
  return fmt::format("{:5.1f}", kmh_per_mps * glm::length(Vec2(participant->velocity_mps)));
}

std::string slow_motion_text(double speed) { return fmt::format("{:.2f}", speed); }

OverlaySizes overlay_sizes(const image::Font& font, std::uint32_t height_px) {
  OverlaySizes sizes;
  sizes.text_px = std::max(least_text_px, std::round(text_share * height_px));
  double widest_px = 0.0;
  for (const char* character : {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"})
    widest_px = std::max(widest_px, font.width_px(character, sizes.text_px));
  sizes.cell_px = static_cast<std::int64_t>(std::ceil(widest_px)) + 2;
  sizes.line_px = static_cast<std::int64_t>(std::ceil(1.35 * sizes.text_px));
  sizes.baseline_px = static_cast<std::int64_t>(std::lround(1.02 * sizes.text_px));
  return sizes;
}

std::optional<image::Point> pixel_of(const instant::FrameView& view, const Vec3& point_m) {
  const Vec3 from_eye_m = inverse(view.world_from_car) * point_m - view.projection.eye_m;
  const glm::dvec4 clip = view.projection.clip_from_eye_relative * glm::dvec4(from_eye_m, 1.0);
  if (!(clip.w > 0.1)) return std::nullopt;
  const double x = clip.x / clip.w, y = clip.y / clip.w;
  if (!(std::abs(x) < far_outside && std::abs(y) < far_outside)) return std::nullopt;
  return image::Point{view.viewport.x + 0.5 * (x + 1.0) * view.viewport.width,
                      view.viewport.y + 0.5 * (y + 1.0) * view.viewport.height};
}

OverlayContent overlay_content(const OverlayMoment& moment, const image::Font& font) {
  OverlayContent content;
  const OverlaySizes sizes = overlay_sizes(font, moment.height_px);
  const std::optional<double> contact_s = moment.script.overlay.contact_s;
  for (std::size_t v = 0; v < moment.views.size(); ++v) {
    const Shot& seen_by = moment.shot;
    const bool outside = is_from_outside(v == 0 ? seen_by : shot_beside(seen_by));
    for (std::size_t n = 0; outside && n < moment.people.size(); ++n) {
      if (moment.shot.paths) add_way(moment, moment.views[v], n, content);
      add_label(moment, moment.views[v], n, font, sizes, content);
    }
    if (outside) add_contact(moment, moment.views[v], content);
    const std::string& title = v == 0 ? moment.shot.title : moment.shot.beside->title;
    Column column(content, font, sizes, moment.views[v].viewport.x, 0);
    if (!title.empty()) column.add(title);
    if (v > 0) continue;
    column.next_line();
    column.add_figure(clock_text(moment.world.simulated_time_s));
    column.add("s");
    if (contact_s) {
      column.next_line();
      column.add_figure(contact_clock_text(moment.world.simulated_time_s, *contact_s));
      column.add(fmt::format("s from {}", moment.script.overlay.contact));
    }
    if (moment.shot.speed != 1.0) {
      column.next_line();
      column.add("slow motion");
      column.add_figure(slow_motion_text(moment.shot.speed));
    }
    for (std::size_t n = 0; n < moment.people.size(); ++n) {
      column.next_line();
      column.add_figure(speed_text(find_person(moment.world, moment.people[n].number)));
      column.add("km/h");
      column.add(moment.people[n].name, color_of(n));
    }
  }
  add_notes(moment, font, sizes, content);
  return content;
}

}  // namespace septet::film
