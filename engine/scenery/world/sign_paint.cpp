#include "engine/scenery/world/sign_paint.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "engine/image/draw.hpp"
#include "engine/scenery/lettering.hpp"

namespace septet::scenery {
namespace {

using image::Color;
using image::Image;

constexpr Color sign_white{248, 249, 250}, sign_black{16, 16, 18}, sign_red{190, 18, 28}, sign_blue{0, 76, 156},
    sign_yellow{250, 196, 8}, sign_grey{120, 122, 124};
/// Sizes: painted at twice the size that is sent.
constexpr std::uint32_t side_px = 192, sent_px = 96;

void shape(Image& image, const std::vector<glm::vec2>& outline, double shrink, Color color, glm::vec2 middle) {
  std::vector<image::Point> corners;
  for (const glm::vec2& corner : outline) {
    const glm::vec2 p = middle + (corner - middle) * static_cast<float>(shrink);
    corners.push_back({p.x * side_px, p.y * side_px});
  }
  image::polygon(image, corners, color);
}

void circle(Image& image, double x, double y, double radius, Color color) {
  image::rounded_rectangle(image, x - radius, y - radius, 2.0 * radius, 2.0 * radius, radius, color);
}
void disc(Image& image, double share, Color color) {
  circle(image, side_px / 2.0, side_px / 2.0, share * side_px / 2.0, color);
}

/// Pen whose strokes are in the picture's pixels around (96, y0), in units of `unit` pixels.
class Pen {
 public:
  Pen(Image& image, Color color, double x, double y, double unit)
      : image_(image), color_(color), x_(x), y_(y), unit_(unit) {}

  void stroke(double x0, double y0, double x1, double y1, double width) {
    image::line(image_, x_ + x0 * unit_, y_ + y0 * unit_, x_ + x1 * unit_, y_ + y1 * unit_, width * unit_, color_);
  }
  void dot(double x, double y, double radius) {
    circle(image_, x_ + x * unit_, y_ + y * unit_, radius * unit_, color_);
  }
  void area(std::vector<image::Point> corners) {
    for (image::Point& corner : corners) corner = {x_ + corner.x * unit_, y_ + corner.y * unit_};
    image::polygon(image_, corners, color_);
  }

  void draw_walker(double x) {
    dot(x, -0.75, 0.17);
    stroke(x, -0.5, x - 0.02, 0.1, 0.2);
    stroke(x, 0.1, x - 0.3, 0.8, 0.16);
    stroke(x, 0.1, x + 0.28, 0.8, 0.16);
    stroke(x, -0.4, x - 0.3, 0.05, 0.12);
    stroke(x, -0.4, x + 0.32, -0.02, 0.12);
  }
  void car(double x) {
    area(
        {{x - 0.36, 0.45}, {x - 0.36, 0.05}, {x - 0.24, -0.35}, {x + 0.24, -0.35}, {x + 0.36, 0.05}, {x + 0.36, 0.45}});
    stroke(x - 0.26, 0.45, x - 0.26, 0.58, 0.14);
    stroke(x + 0.26, 0.45, x + 0.26, 0.58, 0.14);
  }
  void arrow(double turn_rad) {
    const double c = std::cos(turn_rad), s = std::sin(turn_rad);
    const auto at = [&](double ahead, double aside) {
      return image::Point{s * ahead + c * aside, -c * ahead + s * aside};
    };
    area(
        {at(-0.8, -0.14), at(0.1, -0.14), at(0.1, -0.45), at(0.85, 0.0), at(0.1, 0.45), at(0.1, 0.14), at(-0.8, 0.14)});
  }

  void symbol(SignSymbol symbol) {
    using enum SignSymbol;
    switch (symbol) {
      case none:
      case text:
        break;
      case exclamation:
        stroke(0, -0.7, 0, 0.15, 0.3);
        dot(0, 0.62, 0.18);
        break;
      case crossroads:
        stroke(-0.6, -0.6, 0.6, 0.6, 0.24);
        stroke(-0.6, 0.6, 0.6, -0.6, 0.24);
        break;
      case arrow_up:
        arrow(0.0);
        break;
      case arrow_left:
        arrow(-0.5 * std::numbers::pi);
        break;
      case arrow_right:
        arrow(0.5 * std::numbers::pi);
        break;
      case bend_left:
      case bend_right: {
        const double side = symbol == bend_left ? -1.0 : 1.0;
        stroke(-0.2 * side, 0.8, -0.2 * side, 0.1, 0.22);
        stroke(-0.2 * side, 0.1, 0.25 * side, -0.4, 0.22);
        area({{0.1 * side, -0.62}, {0.55 * side, -0.75}, {0.5 * side, -0.2}});
        break;
      }
      case roundabout:
        for (int i = 0; i < 3; ++i) {
          const double from = i * 2.0 * std::numbers::pi / 3.0;
          for (int k = 0; k < 6; ++k) {
            const double a = from - k * 0.26, b = from - (k + 1) * 0.26;
            stroke(0.6 * std::cos(a), 0.6 * std::sin(a), 0.6 * std::cos(b), 0.6 * std::sin(b), 0.2);
          }
          dot(0.6 * std::cos(from - 1.6), 0.6 * std::sin(from - 1.6), 0.2);
        }
        break;
      case walker_on_stripes:
      case walker:
        draw_walker(0.0);
        break;
      case walkers:
        draw_walker(-0.35);
        draw_walker(0.35);
        break;
      case bicycle:
        for (const double x : {-0.5, 0.5})
          for (int k = 0; k < 16; ++k) {
            const double a = k * std::numbers::pi / 8, b = (k + 1) * std::numbers::pi / 8;
            stroke(x + 0.34 * std::cos(a), 0.3 + 0.34 * std::sin(a), x + 0.34 * std::cos(b), 0.3 + 0.34 * std::sin(b),
                   0.1);
          }
        stroke(-0.5, 0.3, -0.2, -0.25, 0.1);
        stroke(-0.2, -0.25, 0.3, -0.25, 0.1);
        stroke(0.3, -0.25, 0.5, 0.3, 0.1);
        stroke(0.3, -0.25, 0.0, 0.3, 0.1);
        stroke(-0.5, 0.3, 0.0, 0.3, 0.1);
        break;
      case works:
        draw_walker(-0.15);
        area({{0.25, 0.8}, {0.55, 0.35}, {0.9, 0.8}});
        stroke(0.05, 0.0, 0.5, 0.5, 0.1);
        break;
      case lights:
        area({{-0.25, -0.85}, {0.25, -0.85}, {0.25, 0.85}, {-0.25, 0.85}});
        break;
      case narrow:
        stroke(-0.45, 0.8, -0.45, 0.2, 0.16);
        stroke(-0.45, 0.2, -0.15, -0.2, 0.16);
        stroke(-0.15, -0.2, -0.15, -0.8, 0.16);
        stroke(0.45, 0.8, 0.45, 0.2, 0.16);
        stroke(0.45, 0.2, 0.15, -0.2, 0.16);
        stroke(0.15, -0.2, 0.15, -0.8, 0.16);
        break;
      case two_cars:
        car(-0.45);
        car(0.45);
        break;
      case lorry:
        area({{-0.8, -0.5}, {0.3, -0.5}, {0.3, 0.35}, {-0.8, 0.35}});
        area({{0.38, -0.2}, {0.7, -0.2}, {0.85, 0.1}, {0.85, 0.35}, {0.38, 0.35}});
        dot(-0.5, 0.42, 0.17);
        dot(0.55, 0.42, 0.17);
        break;
    }
  }

 private:
  Image& image_;
  Color color_;
  double x_, y_, unit_;
};

void lettered(Image& image, const std::string& text, double widest_px, double baseline_y, double size_px, Color color) {
  const Lettering bold(image::FontStyle::condensed_bold);
  const double needed = bold.width_px(text, size_px),
               size = needed > widest_px ? size_px * widest_px / needed : size_px;
  bold.centred(image, side_px / 2.0, baseline_y - 0.36 * (size_px - size), text, size, color);
}

}  // namespace

std::vector<glm::vec2> sign_outline(SignStyle style) {
  using enum SignStyle;
  const auto ring = [](int count, float first_rad) {
    std::vector<glm::vec2> corners;
    for (int i = 0; i < count; ++i) {
      const float angle =
          first_rad + 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(count);
      corners.emplace_back(0.5f + 0.5f * std::cos(angle), 0.5f + 0.5f * std::sin(angle));
    }
    return corners;
  };
  switch (style) {
    case prohibition:
    case prohibition_end:
    case no_entry:
    case no_stopping:
    case mandatory:
      return ring(24, 0.0f);
    case stop: {
      auto corners = ring(8, std::numbers::pi_v<float> / 8.0f);
      // Reaches the edges with its flat sides.
      for (glm::vec2& corner : corners) corner = 0.5f + (corner - 0.5f) * 1.08f;
      return corners;
    }
    case warning:  // Triangle with its tips cut off.
      return {{0.54f, 0.03f}, {1.0f, 0.86f}, {0.96f, 0.93f}, {0.04f, 0.93f}, {0.0f, 0.86f}, {0.46f, 0.03f}};
    case yield:
      return {{0.96f, 0.07f}, {1.0f, 0.14f}, {0.54f, 0.97f}, {0.46f, 0.97f}, {0.0f, 0.14f}, {0.04f, 0.07f}};
    case priority:
    case priority_end:
      return {{0.5f, 0.0f}, {1.0f, 0.5f}, {0.5f, 1.0f}, {0.0f, 0.5f}};
    default:
      return {{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}};
  }
}

Image paint_sign(const SignFace& face) {
  using enum SignStyle;
  Image image(side_px, side_px, sign_white);
  const std::vector<glm::vec2> outline = sign_outline(face.style);
  constexpr double middle = side_px / 2.0;
  const Color field = face.yellow ? sign_yellow : sign_white;
  const auto symbol = [&](Color color, double y, double unit) {
    Pen(image, color, middle, y, unit).symbol(face.symbol);
  };
  const auto bars = [&](Color color) {
    for (const double shift : {-18.0, 0.0, 18.0})
      image::line(image, 34 + shift, 158 + shift, 158 + shift, 34 + shift, 7, color);
  };
  switch (face.style) {
    case prohibition:
    case no_stopping:
      disc(image, 1.05, sign_red);
      disc(image, 0.76, face.style == no_stopping ? sign_blue : field);
      if (face.style == no_stopping) {
        image::line(image, 42, 42, 150, 150, 18, sign_red);
        if (face.symbol != SignSymbol::none) image::line(image, 150, 42, 42, 150, 18, sign_red);
        break;
      }
      if (face.symbol == SignSymbol::two_cars) {
        Pen(image, sign_red, middle, middle, 56).car(-0.45);
        Pen(image, sign_black, middle, middle, 56).car(0.45);
        break;
      }
      symbol(sign_black, middle, 58);
      if (!face.text.empty()) lettered(image, face.text, 124, middle + 33, 92, sign_black);
      break;
    case prohibition_end:
      disc(image, 1.05, sign_black);
      disc(image, 0.95, field);
      symbol(sign_grey, middle, 58);
      if (!face.text.empty()) lettered(image, face.text, 124, middle + 33, 92, sign_grey);
      bars(sign_black);
      break;
    case no_entry:
      disc(image, 1.05, sign_red);
      image::fill(image, 28, 78, 136, 36, face.yellow ? sign_yellow : sign_white);
      break;
    case mandatory:
      disc(image, 1.05, sign_blue);
      symbol(sign_white, middle, 62);
      if (!face.text.empty()) lettered(image, face.text, 124, middle + 33, 92, sign_white);
      break;
    case warning:
      shape(image, outline, 1.1, sign_red, {0.5f, 0.64f});
      shape(image, outline, 0.74, field, {0.5f, 0.64f});
      symbol(sign_black, 120, 40);
      break;
    case yield:
      shape(image, outline, 1.1, sign_red, {0.5f, 0.36f});
      shape(image, outline, 0.66, field, {0.5f, 0.36f});
      break;
    case stop:
      shape(image, outline, 1.1, sign_white, glm::vec2(0.5f));
      shape(image, outline, 0.94, sign_red, glm::vec2(0.5f));
      lettered(image, "STOP", 152, middle + 23, 66, sign_white);
      break;
    case priority:
    case priority_end:
      shape(image, outline, 1.1, sign_white, glm::vec2(0.5f));
      shape(image, outline, 0.93, sign_black, glm::vec2(0.5f));
      shape(image, outline, 0.88, sign_white, glm::vec2(0.5f));
      shape(image, outline, 0.62, sign_yellow, glm::vec2(0.5f));
      if (face.style == priority_end) bars(sign_black);
      break;
    case information:
      shape(image, outline, 1.0, sign_white, glm::vec2(0.5f));
      shape(image, outline, 0.95, sign_blue, glm::vec2(0.5f));
      if (face.symbol == SignSymbol::walker_on_stripes) {
        image::polygon(image, {{96, 22}, {172, 166}, {20, 166}}, sign_white);
        Pen(image, sign_black, middle, 112, 40).draw_walker(0.0);
        for (int i = 0; i < 4; ++i) image::fill(image, 48 + i * 26, 148, 14, 14, sign_black);
        break;
      }
      symbol(sign_white, middle, 66);
      if (!face.text.empty()) lettered(image, face.text, 150, middle + 46, 128, sign_white);
      break;
    case place:
      shape(image, outline, 1.0, sign_black, glm::vec2(0.5f));
      shape(image, outline, 0.95, sign_yellow, glm::vec2(0.5f));
      if (!face.text.empty()) lettered(image, face.text, 168, middle + 24, 66, sign_black);
      break;
    case white_board:
    case blank:
      shape(image, outline, 1.0, sign_black, glm::vec2(0.5f));
      shape(image, outline, 0.96, sign_white, glm::vec2(0.5f));
      symbol(sign_black, middle, 60);
      if (!face.text.empty()) lettered(image, face.text, 150, middle + 33, 92, sign_black);
      break;
    case rail_cross:
      shape(image, outline, 1.0, {150, 152, 154}, glm::vec2(0.5f));
      for (const double side : {-1.0, 1.0}) {
        image::line(image, middle - 74 * side, 22, middle + 74 * side, 170, 34, sign_white);
        image::line(image, middle - 74 * side, 22, middle - 40 * side, 56, 30, sign_red);
        image::line(image, middle + 74 * side, 170, middle + 40 * side, 136, 30, sign_red);
      }
      break;
  }
  return image::resize(image, sent_px, sent_px);
}

}  // namespace septet::scenery
