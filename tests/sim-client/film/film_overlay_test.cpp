#include "sim-client/film/overlay/overlay_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/why_not.hpp"

namespace septet::film {
namespace {

image::Font bold() {
  auto font = image::Font::find(image::FontStyle::bold);
  REQUIRE_MESSAGE(font.has_value(), why_not(font));
  return std::move(*font);
}

Snapshot world_of_two(double time_s, double first_mps, double second_mps) {
  Snapshot world;
  world.simulated_time_s = time_s;
  for (const auto& [id, speed_mps] : {std::pair{4u, first_mps}, std::pair{7u, second_mps}}) {
    Participant participant;
    participant.id = id;
    participant.world_from_vehicle.position_m = {3.0 * id, 2.0, 0.0};
    participant.velocity_mps = {0.6 * speed_mps, -0.8 * speed_mps, 0.0};
    world.participants.push_back(participant);
  }
  return world;
}

std::vector<std::string> figures_of(const OverlayContent& content) {
  std::vector<std::string> figures;
  for (const OverlayLine& line : content.lines)
    if (line.is_figure) figures.push_back(line.text);
  return figures;
}

}  // namespace

TEST_CASE("the figures of an overlay are read back from its pixels at any instant and speed in any size of picture") {
  const image::Font font = bold();
  const std::vector<OverlayPerson> people{{4, "ego"}, {7, "crosser"}, {9, "who is gone"}};
  const Script script{.shots = {},
                      .overlay = {.contact_s = 6.48, .participants = {"4", "7", "9"}, .notes = {"assumed: all"}}};
  Shot shot{.from_s = 0.0, .to_s = 10.0, .speed = 0.25};
  shot.title = "from above";
  for (const std::uint32_t height_px : {240u, 360u, 720u, 1080u})
    for (int n = 0; n < 40; ++n) {
      const double time_s = 0.37 * n, first_mps = 1.713 * n, second_mps = 12.0 + 0.091 * n;
      const Snapshot world = world_of_two(time_s, first_mps, second_mps);
      const std::vector<instant::FrameView> views(1);
      const OverlayMoment moment{script, shot, world, people, {}, views, height_px * 16 / 9, height_px};
      const OverlayContent content = overlay_content(moment, font);
      image::Image picture(moment.width_px, moment.height_px);
      for (std::uint32_t y = 0; y < picture.height; ++y)
        for (std::uint32_t x = 0; x < picture.width; ++x)
          picture.set(x, y, {static_cast<std::uint8_t>(x * 7 + y * 3), static_cast<std::uint8_t>(x ^ y), 90, 255});
      draw(content, font, picture);
      std::vector<std::string> read;
      for (const OverlayLine& line : content.lines)
        if (line.is_figure) read.push_back(read_figure(picture, line, font));
      CHECK(read == figures_of(content));
      REQUIRE(read.size() == 6);
      CHECK(std::stod(read[0]) == doctest::Approx(time_s).epsilon(1e-9).scale(1.0));
      CHECK(std::abs(std::stod(read[1]) - (time_s - 6.48)) <= 0.00501);
      CHECK(read[2] == "0.25");
      CHECK(std::abs(std::stod(read[3]) - 3.6 * first_mps) <= 0.0501);
      CHECK(std::abs(std::stod(read[4]) - 3.6 * second_mps) <= 0.0501);
      CHECK(read[5] == " --.-");
    }
}

TEST_CASE("a figure with an altered pixel is not read as another") {
  const image::Font font = bold();
  const std::vector<OverlayPerson> people;
  const Script script;
  const Shot shot{.from_s = 0.0, .to_s = 10.0};
  const Snapshot world = world_of_two(8.88, 0.0, 0.0);
  const std::vector<instant::FrameView> views(1);
  const OverlayContent content = overlay_content({script, shot, world, people, {}, views, 640, 360}, font);
  image::Image picture(640, 360);
  draw(content, font, picture);
  const OverlayLine& clock = content.lines.front();
  REQUIRE(clock.is_figure);
  CHECK(read_figure(picture, clock, font) == "   8.88");
  const auto x = static_cast<std::uint32_t>(clock.x + clock.width - 5), y = static_cast<std::uint32_t>(clock.y + 8);
  picture.set(x, y, {255, 0, 0, 255});
  CHECK(read_figure(picture, clock, font) == "   8.8?");
}

TEST_CASE("a point's pixel is where the view's projection puts it and none behind the eye") {
  instant::FrameView view;
  view.projection = instant::symmetric_view({0, 0, 2}, 0.0, 0.0, std::numbers::pi / 2.0, std::numbers::pi / 3.0);
  view.world_from_car = {{100.0, 50.0, 0.0}, orientation_from_angles(std::numbers::pi / 2.0, 0, 0)};
  view.viewport = {320, 0, 320, 240};
  const auto ahead = pixel_of(view, {100.0, 60.0, 2.0});
  REQUIRE(ahead.has_value());
  CHECK(ahead->x == doctest::Approx(480.0));
  CHECK(ahead->y == doctest::Approx(120.0));
  const auto right = pixel_of(view, {105.0, 60.0, 2.0});  // Half of the slope to the edge, to the right.
  REQUIRE(right.has_value());
  CHECK(right->x == doctest::Approx(560.0));
  const auto above = pixel_of(view, {100.0, 60.0, 3.0});
  REQUIRE(above.has_value());
  CHECK(above->y < 120.0);
  CHECK_FALSE(pixel_of(view, {100.0, 40.0, 2.0}).has_value());
}

TEST_CASE("names and ways lie over pictures from outside and never over what somebody's eyes see") {
  const image::Font font = bold();
  const std::vector<OverlayPerson> people{{4, "ego"}, {7, "crosser"}};
  const std::vector<OverlayWay> ways{{{0.0, 1.0, 2.0}, {{0, 2, 0}, {12, 2, 0}, {20, 2, 0}}}, {{}, {}}};
  const Script script{.shots = {}, .overlay = {.contact_s = {}, .participants = {"4", "7"}, .notes = {}}};
  const Snapshot world = world_of_two(1.0, 10.0, 5.0);
  std::vector<instant::FrameView> views(1);
  views[0].projection = instant::symmetric_view({16, 2, 60}, std::numbers::pi / 2.0, -std::numbers::pi / 2.0, 0.9, 0.6);
  views[0].viewport = {0, 0, 640, 360};
  Shot above{.from_s = 0.0, .to_s = 2.0};
  above.place_m = Vec3(16, 2, 60);
  above.overlay = above.paths = true;
  const auto count = [&](const Shot& shot) {
    const OverlayContent content = overlay_content({script, shot, world, people, ways, views, 640, 360}, font);
    const auto names = std::ranges::count_if(content.lines, [&](const OverlayLine& line) {
      return (line.text == "ego" || line.text == "crosser") && line.y > 100;
    });
    return std::pair(names, content.strokes.size());
  };
  const auto outside = count(above);
  CHECK(outside.first == 2);
  CHECK(outside.second == 6);  // Two outlines, two lines to names, a way behind and a way to come.
  Shot eyes = above;
  eyes.place_m.reset();
  const auto through_eyes = count(eyes);
  CHECK(through_eyes.first == 0);
  CHECK(through_eyes.second == 0);
}

TEST_CASE("the contact's place is marked in views from outside, where it is in the picture, and nowhere else") {
  const image::Font font = bold();
  Script script;
  script.overlay.contact_m = Vec3(20.0, 4.0, 0.5);
  const Snapshot world = world_of_two(1.0, 10.0, 5.0);
  std::vector<instant::FrameView> views(1);
  views[0].projection = instant::symmetric_view({16, 2, 60}, std::numbers::pi / 2.0, -std::numbers::pi / 2.0, 0.9, 0.6);
  views[0].viewport = {0, 0, 640, 360};
  Shot above{.from_s = 0.0, .to_s = 2.0};
  above.place_m = Vec3(16, 2, 60);
  above.overlay = true;
  const auto marked = [&](const Shot& shot) {
    return overlay_content({script, shot, world, {}, {}, views, 640, 360}, font).strokes;
  };
  const auto strokes = marked(above);
  REQUIRE(strokes.size() == 6);
  const auto at = pixel_of(views[0], *script.overlay.contact_m);
  REQUIRE(at.has_value());
  for (const OverlayStroke& stroke : strokes)
    for (const image::Point& point : stroke.points) CHECK(std::hypot(point.x - at->x, point.y - at->y) < 7.0);
  Shot eyes = above;
  eyes.place_m.reset();
  CHECK(marked(eyes).empty());
  script.overlay.contact_m = Vec3(500.0, 4.0, 0.5);
  CHECK(marked(above).empty());
}

}  // namespace septet::film
