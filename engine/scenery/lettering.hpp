#pragma once
/// Text on signs and plates. Where the font is missing the text is left out: the scenery remains usable, and
/// Font::find's error is reported by the program that starts.

#include <optional>
#include <string_view>

#include "engine/image/font.hpp"

namespace septet::scenery {

class Lettering {
 public:
  explicit Lettering(image::FontStyle style) {
    if (auto found = image::Font::find(style)) font_.emplace(std::move(*found));
  }
  void left(image::Image& target, double x, double baseline_y, std::string_view text, double size_px,
            image::Color color) const {
    if (font_) font_->draw(target, x, baseline_y, text, size_px, color);
  }
  void centred(image::Image& target, double x, double baseline_y, std::string_view text, double size_px,
               image::Color color) const {
    if (font_) font_->draw_centred(target, x, baseline_y, text, size_px, color);
  }
  double width_px(std::string_view text, double size_px) const { return font_ ? font_->width_px(text, size_px) : 0.0; }

 private:
  std::optional<image::Font> font_;
};

}  // namespace septet::scenery
