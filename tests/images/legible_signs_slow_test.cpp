/// Reading distance of a sign on a screen, from its pixels.
///
/// An eye of full acuity resolves strokes of one minute of arc: letters of five strokes from 6.9 m per cm of their
/// height; 6 m per cm is the usual rule. A pixel of a screen of 1080 lines over 40 degrees is 2.3 minutes, and edges
/// fall anywhere between pixels: here signs that differ by a digit are distinguished from 2.5 m per cm, where the
/// digits are six pixels high. Reading from further off needs more lines in the same angle. The screen's picture,
/// smoothed and in its codes, is compared with the faces of all possible limits.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/image/font.hpp"
#include "engine/image/image.hpp"
#include "engine/image/srgb.hpp"
#include "engine/render/renderer.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "engine/scenery/world/sign_paint.hpp"
#include "tests/engine/road/road_files.hpp"

namespace septet {
namespace {

constexpr std::uint32_t sign_view_px = 96;
constexpr double sign_pixel_rad = 1.0 / 1484.0, sign_m = 0.9, sign_s_m = 300.0, sign_t_m = -5.0, sign_bottom_m = 2.1;
constexpr std::array limits{"30", "50", "60", "70", "80", "90", "100", "110", "120", "130"};

double light_of_code(std::uint8_t code) { return image::light_of_srgb(code / 255.0); }

/// Pixels within the red ring, row by row; others are left out.
struct Inside {
  std::vector<double> light;
  double middle = 0.0;
  void center() {
    for (const double each : light) middle += each / static_cast<double>(light.size());
    for (double& each : light) each -= middle;
  }
};

double correlation(const Inside& a, const Inside& b) {
  REQUIRE(a.light.size() == b.light.size());
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.light.size(); ++i)
    ab += a.light[i] * b.light[i], aa += a.light[i] * a.light[i], bb += b.light[i] * b.light[i];
  return ab / std::sqrt(std::max(aa * bb, 1e-30));
}

/// The sign's own coordinates, 0 to 1 from its upper left, of a place of the picture that shows it square on in its
/// middle.
glm::dvec2 on_sign(double x_px, double y_px, double distance_m) {
  const double side_px = sign_m / (distance_m * sign_pixel_rad);
  return {(x_px - 0.5 * sign_view_px) / side_px + 0.5, (y_px - 0.5 * sign_view_px) / side_px + 0.5};
}
bool is_inside(double x_px, double y_px, double distance_m) {
  const glm::dvec2 at = on_sign(x_px, y_px, distance_m) - 0.5;
  return std::hypot(at.x, at.y) < 0.36;
}

Inside of_picture(const image::Image& picture, double distance_m) {
  Inside inside;
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x)
      if (is_inside(x + 0.5, y + 0.5, distance_m)) inside.light.push_back(light_of_code(picture.at(x, y).green));
  inside.center();
  return inside;
}

/// Value of a pixel that averages the face over its square.
Inside of_face(const image::Image& face, double distance_m) {
  constexpr int steps = 8;
  Inside inside;
  for (std::uint32_t y = 0; y < sign_view_px; ++y)
    for (std::uint32_t x = 0; x < sign_view_px; ++x) {
      if (!is_inside(x + 0.5, y + 0.5, distance_m)) continue;
      double sum = 0.0;
      for (int i = 0; i < steps * steps; ++i) {
        const glm::dvec2 at = on_sign(x + (i % steps + 0.5) / steps, y + (i / steps + 0.5) / steps, distance_m);
        const auto texel = [](double share, std::uint32_t count) {
          return static_cast<std::uint32_t>(std::clamp(share * count, 0.0, count - 1.0));
        };
        sum += light_of_code(face.at(texel(at.x, face.width), texel(at.y, face.height)).green);
      }
      inside.light.push_back(sum / (steps * steps));
    }
  inside.center();
  return inside;
}

scenery::SignFace limit_face(const std::string& limit) {
  return {scenery::SignStyle::prohibition, scenery::SignSymbol::text, limit};
}

/// Share of the sign's height that its digits have.
double digit_share(const image::Image& face) {
  std::uint32_t low = face.height, high = 0;
  for (std::uint32_t y = face.height / 4; y < face.height * 3 / 4; ++y)
    for (std::uint32_t x = face.width / 4; x < face.width * 3 / 4; ++x)
      if (light_of_code(face.at(x, y).green) < 0.3) low = std::min(low, y), high = std::max(high, y + 1);
  return double(high - low) / face.height;
}

/// A road with this limit at its side.
scene::ResolvedScene road_with_limit(const std::string& limit) {
  const std::string signal = "<signals><signal id=\"1\" type=\"274\" subtype=\"" + limit +
                             "\" country=\"DE\" value=\"" + limit + "\" s=\"" + std::to_string(sign_s_m) + "\" t=\"" +
                             std::to_string(sign_t_m) + "\" zOffset=\"" + std::to_string(sign_bottom_m) +
                             "\" width=\"0.9\" height=\"0.9\" orientation=\"+\" dynamic=\"no\"/></signals>";
  scene::Store store;
  scene::SceneBuilder builder(store);
  scenery::build_road_world(
      builder,
      road::read_or_fail(road::replaced(road::SmallRoad{.length_m = 400.0}.xml(), "</lanes>", "</lanes>" + signal)), 3,
      {.vegetation = false, .buildings = false, .overrun_m = 0.0});
  return scene::resolve(store);
}

}  // namespace

TEST_CASE("a speed limit is told from all others on a screen from where its digits are six pixels high") {
  if (!image::Font::find(image::FontStyle::bold)) return;
  std::vector<image::Image> faces;
  for (const std::string limit : limits) faces.push_back(scenery::paint_sign(limit_face(limit)));
  for (std::size_t shown = 0; shown < limits.size(); ++shown) {
    render::Renderer renderer =
        *render::Renderer::create({sign_view_px, sign_view_px, render::DevicePreference::software, true,
                                   render::Antialiasing::automatic, nullptr});
    REQUIRE(renderer.upload(road_with_limit(limits[shown])).has_value());
    const double digit_m = digit_share(faces[shown]) * sign_m;
    for (const double digit_px : {6.0, 8.0, 12.0}) {
      const double distance_m = digit_m / (digit_px * sign_pixel_rad);
      instant::FrameInput input;
      input.environment.cloud_cover = 1.0;
      instant::FrameView view;
      const double across_rad = 2.0 * std::atan(0.5 * sign_view_px * sign_pixel_rad);
      view.projection = instant::symmetric_view({sign_s_m - 0.07 - distance_m, sign_t_m, sign_bottom_m + 0.5 * sign_m},
                                                0.0, 0.0, across_rad, across_rad);
      view.viewport = {0, 0, sign_view_px, sign_view_px};
      input.views = {view};
      REQUIRE(renderer.draw(input).has_value());
      CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
      const Inside seen = of_picture(*renderer.read_back(), distance_m);
      const auto [darkest, brightest] = std::ranges::minmax(seen.light);
      const double contrast = (brightest - darkest) / (brightest + darkest + 2.0 * seen.middle);
      double right = 0.0, wrong = -1.0;
      for (std::size_t other = 0; other < limits.size(); ++other) {
        const double alike = correlation(seen, of_face(faces[other], distance_m));
        (other == shown ? right : wrong) = other == shown ? alike : std::max(wrong, alike);
      }
      CAPTURE(limits[shown]);
      CAPTURE(distance_m);
      CAPTURE(digit_px);
      CAPTURE(right);
      CAPTURE(wrong);
      const bool large = digit_px >= 8.0;
      CHECK(right > (large ? 0.92 : 0.86));
      CHECK(right > wrong + (large ? 0.02 : 0.003));
      CHECK(contrast > (large ? 0.9 : 0.7));
    }
  }
}

}  // namespace septet
