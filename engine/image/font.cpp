#include "engine/image/font.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include "engine/image/draw.hpp"

namespace septet::image {

struct Font::Face {
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  Face() = default;
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;
  ~Face() {
    if (face) FT_Done_Face(face);
    if (library) FT_Done_FreeType(library);
  }

  void set_size(double size_px) const { FT_Set_Char_Size(face, 0, std::lround(size_px * 64.0), 72, 72); }
  double kerning_px(FT_UInt left, FT_UInt right) const {
    FT_Vector kerning{};
    if (left != 0 && FT_HAS_KERNING(face)) FT_Get_Kerning(face, left, right, FT_KERNING_UNFITTED, &kerning);
    return static_cast<double>(kerning.x) / 64.0;
  }
};

namespace {

constexpr char32_t replacement_character = 0xfffd;

const char* file_name(FontStyle style) {
  switch (style) {
    case FontStyle::regular:
      return "DejaVuSans.ttf";
    case FontStyle::bold:
      return "DejaVuSans-Bold.ttf";
    case FontStyle::condensed_bold:
      return "DejaVuSansCondensed-Bold.ttf";
  }
  return "DejaVuSans.ttf";
}

std::filesystem::path find_file(FontStyle style) {
  std::vector<std::filesystem::path> folders;
  if (const char* folder = std::getenv("SEPTET_FONT_DIR")) folders.emplace_back(folder);
  folders.insert(folders.end(), {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu", "/usr/share/fonts/TTF",
                                 "/usr/local/share/fonts/truetype/dejavu"});
  // The condensed faces are in a package of their own, so the wide one stands in for them.
  const std::array<const char*, 2> names{file_name(style),
                                         style == FontStyle::regular ? "DejaVuSans.ttf" : "DejaVuSans-Bold.ttf"};
  for (const char* name : names)
    for (const auto& folder : folders) {
      std::error_code ignored;
      if (std::filesystem::is_regular_file(folder / name, ignored)) return folder / name;
    }
  return {};
}

/// Takes one code point off the front of `text`.
char32_t take_code_point(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  const std::size_t length = lead < 0x80 ? 1 : lead >> 5 == 0x6 ? 2 : lead >> 4 == 0xe ? 3 : lead >> 3 == 0x1e ? 4 : 0;
  bool valid = length != 0 && length <= text.size();
  char32_t code = length == 1 ? lead : lead & (0x7f >> length);
  for (std::size_t i = 1; valid && i < length; ++i) {
    valid = byte(i) >> 6 == 0x2;
    code = code << 6 | (byte(i) & 0x3f);
  }
  text.remove_prefix(valid ? length : 1);
  return valid ? code : replacement_character;
}

}  // namespace

Font::Font(std::unique_ptr<Face> face) : face_(std::move(face)) {}
Font::Font(Font&&) noexcept = default;
Font& Font::operator=(Font&&) noexcept = default;
Font::~Font() = default;

Expected<Font> Font::find(FontStyle style) {
  const std::filesystem::path path = find_file(style);
  if (path.empty())
    return failure(std::string("the font ") + file_name(style) + " is missing", "/usr/share/fonts",
                   "install Debian's fonts-dejavu-core, or set SEPTET_FONT_DIR to its folder");
  auto face = std::make_unique<Face>();
  if (FT_Init_FreeType(&face->library) != 0 || FT_New_Face(face->library, path.c_str(), 0, &face->face) != 0)
    return failure("FreeType cannot read the font", path.string(), "install fonts-dejavu-core again");
  return Font(std::move(face));
}

double Font::width_px(std::string_view text, double size_px) const {
  face_->set_size(size_px);
  double width = 0.0;
  FT_UInt previous = 0;
  while (!text.empty()) {
    const FT_UInt glyph = FT_Get_Char_Index(face_->face, take_code_point(text));
    if (FT_Load_Glyph(face_->face, glyph, FT_LOAD_NO_HINTING) != 0) continue;
    width += face_->kerning_px(previous, glyph);
    width += static_cast<double>(face_->face->glyph->linearHoriAdvance) / 65536.0;
    previous = glyph;
  }
  return width;
}

double Font::capital_height_px(double size_px) const {
  face_->set_size(size_px);
  if (FT_Load_Char(face_->face, 'H', FT_LOAD_NO_HINTING) != 0) return 0.7 * size_px;
  return static_cast<double>(face_->face->glyph->metrics.height) / 64.0;
}

void Font::draw(Image& image, double x, double baseline_y, std::string_view text, double size_px, Color color) const {
  face_->set_size(size_px);
  FT_UInt previous = 0;
  while (!text.empty()) {
    const FT_UInt glyph = FT_Get_Char_Index(face_->face, take_code_point(text));
    if (FT_Load_Glyph(face_->face, glyph, FT_LOAD_NO_HINTING) != 0) continue;
    x += face_->kerning_px(previous, glyph);
    FT_GlyphSlot slot = face_->face->glyph;
    // Glyphs stand at fractions of a pixel, so that spacing is even at small sizes.
    FT_Outline_Translate(&slot->outline, std::lround((x - std::floor(x)) * 64.0),
                         -std::lround((baseline_y - std::floor(baseline_y)) * 64.0));
    if (FT_Render_Glyph(slot, FT_RENDER_MODE_NORMAL) == 0) {
      const auto left = static_cast<std::int64_t>(std::floor(x)) + slot->bitmap_left;
      const auto top = static_cast<std::int64_t>(std::floor(baseline_y)) - slot->bitmap_top;
      for (unsigned row = 0; row < slot->bitmap.rows; ++row)
        for (unsigned column = 0; column < slot->bitmap.width; ++column) {
          const std::int64_t px = left + column, py = top + row;
          if (!image.contains(px, py)) continue;
          const unsigned char* line = slot->bitmap.buffer + std::ptrdiff_t{slot->bitmap.pitch} * row;
          const auto ix = static_cast<std::uint32_t>(px), iy = static_cast<std::uint32_t>(py);
          image.set(ix, iy, blend(image.at(ix, iy), color, line[column] / 255.0f));
        }
    }
    x += static_cast<double>(slot->linearHoriAdvance) / 65536.0;
    previous = glyph;
  }
}

}  // namespace septet::image
