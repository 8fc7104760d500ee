#pragma once
/// Text on images, rasterised by FreeType from Debian's DejaVu Sans.
///
/// A Font is not safe to share between threads: FreeType keeps the last requested size in the face.

#include <memory>
#include <string_view>

#include "engine/core/expected.hpp"
#include "engine/image/image.hpp"

namespace septet::image {

enum class FontStyle { regular, bold, condensed_bold };

class Font {
 public:
  /// Looks for DejaVu in SEPTET_FONT_DIR, then in the usual folders of a Linux system.
  static Expected<Font> find(FontStyle style = FontStyle::regular);

  Font(Font&&) noexcept;
  Font& operator=(Font&&) noexcept;
  ~Font();

  /// Width of `text` (UTF-8) at `size_px` pixels an em. Broken UTF-8 is drawn as U+FFFD.
  double width_px(std::string_view text, double size_px) const;

  /// Height of a capital H at `size_px`.
  double capital_height_px(double size_px) const;

  /// Draws with the left end of the baseline at (x, baseline_y).
  void draw(Image& image, double x, double baseline_y, std::string_view text, double size_px, Color color) const;

  void draw_centred(Image& image, double centre_x, double baseline_y, std::string_view text, double size_px,
                    Color color) const {
    draw(image, centre_x - width_px(text, size_px) / 2.0, baseline_y, text, size_px, color);
  }

 private:
  struct Face;
  explicit Font(std::unique_ptr<Face> face);
  std::unique_ptr<Face> face_;
};

}  // namespace septet::image
