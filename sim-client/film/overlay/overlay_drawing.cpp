#include "sim-client/film/overlay/overlay_drawing.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace septet::film {
namespace {

constexpr image::Color box_color{16, 18, 22, 255};
/// Characters of all figures.
constexpr std::string_view figure_characters = "0123456789.+- ";

void draw_cell(image::Image& picture, std::int64_t x, std::int64_t y, char character, const image::Font& font,
               const OverlaySizes& sizes, image::Color color) {
  if (character != ' ')
    font.draw(picture, static_cast<double>(x + 1), static_cast<double>(y + sizes.baseline_px),
              std::string_view(&character, 1), sizes.text_px, color);
}

}  // namespace

void draw(const OverlayContent& content, const image::Font& font, image::Image& picture) {
  const OverlaySizes sizes = overlay_sizes(font, picture.height);
  for (const OverlayStroke& stroke : content.strokes)
    for (std::size_t n = 1; n < stroke.points.size(); ++n)
      image::line(picture, stroke.points[n - 1].x, stroke.points[n - 1].y, stroke.points[n].x, stroke.points[n].y,
                  stroke.width_px, stroke.color);
  for (const OverlayLine& line : content.lines) {
    image::fill(picture, line.x, line.y, line.width, line.height, box_color);
    if (line.is_figure)
      for (std::size_t n = 0; n < line.text.size(); ++n)
        draw_cell(picture, line.x + static_cast<std::int64_t>(n) * sizes.cell_px, line.y, line.text[n], font, sizes,
                  line.color);
    else
      font.draw(picture, static_cast<double>(line.x) + 0.5 * static_cast<double>(sizes.cell_px),
                static_cast<double>(line.y + sizes.baseline_px), line.text, sizes.text_px, line.color);
  }
}

std::string read_figure(const image::Image& picture, const OverlayLine& figure, const image::Font& font) {
  const OverlaySizes sizes = overlay_sizes(font, picture.height);
  std::string text;
  for (std::int64_t x = figure.x; x + sizes.cell_px <= figure.x + figure.width; x += sizes.cell_px) {
    const auto equals = [&](char character) {
      image::Image drawn(static_cast<std::uint32_t>(3 * sizes.cell_px), static_cast<std::uint32_t>(figure.height),
                         box_color);
      draw_cell(drawn, sizes.cell_px, 0, character, font, sizes, figure.color);
      for (std::int64_t row = 0; row < figure.height; ++row)
        for (std::int64_t column = 0; column < sizes.cell_px; ++column) {
          if (!picture.contains(x + column, figure.y + row)) return false;
          if (!(drawn.at(static_cast<std::uint32_t>(sizes.cell_px + column), static_cast<std::uint32_t>(row)) ==
                picture.at(static_cast<std::uint32_t>(x + column), static_cast<std::uint32_t>(figure.y + row))))
            return false;
        }
      return true;
    };
    const auto found = std::ranges::find_if(figure_characters, equals);
    text += found == figure_characters.end() ? '?' : *found;
  }
  return text;
}

}  // namespace septet::film
