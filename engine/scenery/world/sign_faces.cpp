#include "engine/scenery/world/sign_faces.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/image/draw.hpp"
#include "engine/scenery/lettering.hpp"

namespace septet::scenery {
namespace {

using image::Color;
using image::Image;

constexpr Color blue{16, 72, 158}, white{250, 251, 252}, black{14, 15, 18};
/// Signs are painted at twice the size that is sent.
constexpr std::uint32_t width = 512, height = 208, sign_width_px = 256, sign_height_px = 104;

Image blue_board() {
  Image board(width, height, {150, 152, 154});
  image::rounded_rectangle(board, 2, 2, width - 4.0, height - 4.0, 18, white);
  image::rounded_rectangle(board, 8, 8, width - 16.0, height - 16.0, 14, blue);
  return board;
}

}  // namespace

Image direction_sign(std::string_view route, const std::vector<SignLine>& lines) {
  Image board = blue_board();
  const Lettering bold(image::FontStyle::bold);
  const double size = lines.size() > 2 ? 46.0 : 56.0, step = (height - 30.0) / static_cast<double>(lines.size());
  double baseline = 15.0 + step / 2 + size * 0.36;
  for (const SignLine& line : lines) {
    // Long names are set smaller, so that they keep apart from their distance.
    constexpr double from = 106.0, to = width - 28.0;
    const std::string distance = std::to_string(line.distance_km);
    const double needed = bold.width_px(line.place + "n" + distance, size);
    const double fitting = size * std::min(1.0, (to - from) / std::max(needed, 1.0));
    bold.left(board, from, baseline, line.place, fitting, white);
    bold.left(board, to - bold.width_px(distance, fitting), baseline, distance, fitting, white);
    baseline += step;
  }
  image::rounded_rectangle(board, 20, 24, 70, 46, 8, white);
  image::rounded_rectangle(board, 23, 27, 64, 40, 6, {14, 120, 66});
  bold.centred(board, 55, 58, route, 30, white);
  return image::resize(board, sign_width_px, sign_height_px);
}

Image rest_area_sign(int distance_m) {
  Image board = blue_board();
  const Lettering bold(image::FontStyle::bold);
  image::rounded_rectangle(board, 30, 44, 120, 120, 12, white);
  image::rounded_rectangle(board, 37, 51, 106, 106, 8, blue);
  bold.centred(board, 90, 140, "P", 100, white);
  bold.left(board, 180, 92, "Ekbacken", 54, white);
  bold.left(board, 180, 162,
            distance_m >= 1000 ? fmt::format("{} {:03} m", distance_m / 1000, distance_m % 1000)
                               : fmt::format("{} m", distance_m),
            54, white);
  return image::resize(board, sign_width_px, sign_height_px);
}

Image speed_display(int limit_kmh) {
  constexpr std::uint32_t side = 64;
  Image display(side, side, black);
  for (int i = 0; i < 36; ++i) {
    const double angle = i * 10.0 * 3.14159265358979 / 180.0;
    for (const double radius : {27.0, 23.5})
      image::line(display, 32 + radius * std::cos(angle), 32 + radius * std::sin(angle), 32 + radius * std::cos(angle),
                  32 + radius * std::sin(angle), 3.2, {255, 40, 30});
  }
  const std::string text = std::to_string(limit_kmh);
  Lettering(image::FontStyle::condensed_bold)
      .centred(display, 32, 32 + (text.size() > 2 ? 8.0 : 10.0), text, text.size() > 2 ? 21 : 27, white);
  return display;
}

}  // namespace septet::scenery
