#include "engine/scenery/vehicles/dial_faces.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "engine/image/draw.hpp"
#include "engine/scenery/lettering.hpp"
#include "engine/world/instrument_panel.hpp"

namespace septet::scenery {
namespace {

using image::Color;
using image::Image;
using image::Point;
using instrument_panel::Dial;
using instrument_panel::Sign;

constexpr Color white{235, 238, 242, 255}, grey{120, 124, 130, 255}, red{255, 60, 40, 255}, green{40, 235, 90, 255},
    blue{70, 120, 255, 255}, amber{255, 170, 20, 255}, black{4, 4, 5, 255};

constexpr double pixels_per_m = 2560.0;

Point on_face(const glm::dvec2& at_m) {
  return {(0.5 * instrument_panel::width_m + at_m.x) * pixels_per_m,
          (0.5 * instrument_panel::height_m - at_m.y) * pixels_per_m};
}

glm::dvec2 around(const Dial& dial, double share_of_radius, double angle_rad) {
  return dial.middle_m + share_of_radius * dial.radius_m * glm::dvec2(std::cos(angle_rad), std::sin(angle_rad));
}

/// Paints a dial with strokes `step` apart, of which each `long_each`-th is long and numbered; red from `red_from`.
void paint_dial(Image& image, const Dial& dial, double step, int long_each, double red_from, const char* unit) {
  const Lettering bold(image::FontStyle::bold), regular(image::FontStyle::condensed_bold);
  const auto stroke = [&](double from, double to, double angle_rad, double width_px, Color color) {
    const Point a = on_face(around(dial, from, angle_rad)), b = on_face(around(dial, to, angle_rad));
    image::line(image, a.x, a.y, b.x, b.y, width_px, color);
  };
  constexpr int facets = 96;
  for (int i = 0; i < facets; ++i) {
    const double a = 2.0 * std::numbers::pi * i / facets, b = 2.0 * std::numbers::pi * (i + 1) / facets;
    const Point from = on_face(around(dial, 0.99, a)), to = on_face(around(dial, 0.99, b));
    image::line(image, from.x, from.y, to.x, to.y, 2.5, grey);
  }
  const double size_px = 0.19 * dial.radius_m * pixels_per_m;
  const int strokes = static_cast<int>(std::lround(dial.full / step));
  for (int i = 0; i <= strokes; ++i) {
    const double reading = i * step, angle = needle_rad(dial, reading);
    const bool is_long = i % long_each == 0;
    const Color color = reading >= red_from ? red : white;
    stroke(is_long ? 0.80 : 0.86, 0.94, angle, is_long ? 5.0 : 2.5, color);
    if (!is_long) continue;
    const Point at = on_face(around(dial, 0.62, angle));
    bold.centred(image, at.x, at.y + 0.36 * size_px, std::to_string(std::lround(reading)), size_px, color);
  }
  const Point middle = on_face(dial.middle_m - glm::dvec2(0.0, 0.82 * dial.radius_m));
  regular.centred(image, middle.x, middle.y + 5.0, unit, 15.0, grey);
}

constexpr std::int32_t cell_px = 64;

/// Draws a sign in the middle of its cell. Coordinates: shares of half the cell, x to the right, y up.
class SignPen {
 public:
  SignPen(Image& image, Sign sign)
      : image_(image),
        x_((instrument_panel::cell_of(sign).x + 0.5) * cell_px),
        y_((instrument_panel::cell_of(sign).y + 0.5) * cell_px) {}
  void line(double x0, double y0, double x1, double y1, double width, Color color) const {
    const Point a = at({x0, y0}), b = at({x1, y1});
    image::line(image_, a.x, a.y, b.x, b.y, width * half_px, color);
  }
  void polygon(const std::vector<Point>& corners, Color color) const {
    std::vector<Point> points;
    points.reserve(corners.size());
    for (const Point& corner : corners) points.push_back(at(corner));
    image::polygon(image_, points, color);
  }
  void ring(double radius, double width, Color color, double from_rad = 0.0, double to_rad = 6.2832) const {
    constexpr int facets = 24;
    for (int i = 0; i < facets; ++i) {
      const double a = std::lerp(from_rad, to_rad, i / double(facets)),
                   b = std::lerp(from_rad, to_rad, (i + 1) / double(facets));
      line(radius * std::cos(a), radius * std::sin(a), radius * std::cos(b), radius * std::sin(b), width, color);
    }
  }
  void text(const std::string& text, double size_px, Color color) const {
    Lettering(image::FontStyle::bold).centred(image_, x_, y_ + 0.365 * size_px, text, size_px, color);
  }
  /// Draws a headlamp's outline whose beams fall to the left, by `drop` on their way.
  void lamp(double drop, Color color) const {
    std::vector<Point> lens{{0.05, 0.5}};
    for (int i = 0; i <= 8; ++i) {
      const double a = 0.5 * std::numbers::pi * (1.0 - i / 4.0);
      lens.push_back({0.05 + 0.6 * std::cos(a), 0.5 * std::sin(a)});
    }
    polygon(lens, color);
    for (int i = 0; i < 4; ++i) {
      const double y = 0.42 - 0.28 * i;
      line(-0.12, y, -0.7, y - drop, 0.1, color);
    }
  }

 private:
  Point at(const Point& p) const { return {x_ + p.x * half_px, y_ - p.y * half_px}; }
  static constexpr double half_px = 0.5 * cell_px;
  Image& image_;
  double x_, y_;
};

}  // namespace

Image dial_faces_image() {
  Image image(static_cast<std::uint32_t>(std::lround(instrument_panel::width_m * pixels_per_m)),
              static_cast<std::uint32_t>(std::lround(instrument_panel::height_m * pixels_per_m)), black);
  paint_dial(image, instrument_panel::revolutions, 0.5, 2, 6.5, "1000/min");
  paint_dial(image, instrument_panel::speed, 10.0, 4, 1e9, "km/h");
  return image;
}

Image signs_image() {
  Image image(instrument_panel::columns * cell_px, instrument_panel::rows * cell_px, black);
  for (int digit = 0; digit < 10; ++digit)
    SignPen(image, static_cast<Sign>(digit)).text(std::to_string(digit), 58.0, white);
  SignPen(image, Sign::reverse).text("R", 58.0, white);
  SignPen(image, Sign::neutral).text("N", 58.0, white);
  const std::vector<Point> arrow{{-0.8, 0},    {-0.05, 0.7},  {-0.05, 0.3}, {0.75, 0.3},
                                 {0.75, -0.3}, {-0.05, -0.3}, {-0.05, -0.7}};
  SignPen(image, Sign::indicator_left).polygon(arrow, green);
  std::vector<Point> other = arrow;
  for (Point& point : other) point.x = -point.x;
  SignPen(image, Sign::indicator_right).polygon(other, green);
  const SignPen hazard(image, Sign::hazard);
  hazard.polygon({{-0.85, -0.65}, {0.85, -0.65}, {0.0, 0.85}}, red);
  hazard.polygon({{-0.55, -0.47}, {0.55, -0.47}, {0.0, 0.5}}, black);
  hazard.polygon({{-0.25, -0.28}, {0.25, -0.28}, {0.0, 0.16}}, red);
  SignPen(image, Sign::low_beam).lamp(0.18, green);
  SignPen(image, Sign::high_beam).lamp(0.0, blue);
  const SignPen fog(image, Sign::rear_fog);
  fog.lamp(0.0, amber);
  fog.line(-0.4, 0.7, -0.4, -0.75, 0.1, amber);
  const SignPen brake(image, Sign::parking_brake);
  brake.ring(0.52, 0.14, red);
  brake.ring(0.82, 0.12, red, -0.7, 0.7);
  brake.ring(0.82, 0.12, red, 2.44, 3.84);
  brake.text("P", 34.0, red);
  const SignPen engine(image, Sign::engine);
  engine.polygon({{-0.55, -0.45}, {0.5, -0.45}, {0.65, -0.15}, {0.65, 0.2}, {0.35, 0.35}, {-0.35, 0.35}, {-0.55, 0.1}},
                 amber);
  engine.line(-0.85, 0.25, -0.85, -0.4, 0.14, amber);
  engine.line(-0.85, -0.08, -0.5, -0.08, 0.14, amber);
  engine.line(-0.2, 0.35, -0.2, 0.62, 0.16, amber);
  engine.line(-0.4, 0.62, 0.1, 0.62, 0.14, amber);
  engine.line(0.85, 0.3, 0.85, -0.35, 0.14, amber);
  SignPen(image, Sign::needle).polygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {255, 84, 40, 255});
  SignPen(image, Sign::hub).polygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {22, 22, 24, 255});
  return image;
}

}  // namespace septet::scenery
