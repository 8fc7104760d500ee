#include "engine/scenery/vehicles/finish.hpp"

#include <array>
#include <string>
#include <string_view>

#include "engine/image/draw.hpp"
#include "engine/scenery/lettering.hpp"

namespace septet::scenery {
namespace {

using image::Color;
using image::Image;

struct Look {
  const char* name;
  glm::vec3 color;  ///< Linear Rec. 709.
  float roughness;
  float metallic = 0.0f;
  glm::vec3 emission{0.0f};
  float opacity = 1.0f;
  float clear_coat = 0.0f;
  float ambient_share = 1.0f;  ///< As of CockpitFinish: of the sky's light, what comes in through the windows.
};

/// Share of clear coat on car paint, whose base is rough.
constexpr float lacquer = 1.0f;

/// Looks in the order of Finish.
constexpr std::array<Look, 36> looks{{
    {"paint", {0.85f, 0.85f, 0.85f}, 0.7f, 0.0f, {}, 1.0f, lacquer},
    {"glass", {0.012f, 0.016f, 0.018f}, 0.06f},
    {"trim", {0.022f, 0.022f, 0.024f}, 0.55f},
    {"underbody", {0.012f, 0.012f, 0.012f}, 0.95f},
    {"tyre", {0.018f, 0.018f, 0.018f}, 0.9f},
    {"rim", {0.52f, 0.53f, 0.55f}, 0.35f, 0.8f},
    {"chrome", {0.75f, 0.75f, 0.76f}, 0.15f, 1.0f},
    {"plate", {0.9f, 0.9f, 0.9f}, 0.6f},
    {"cabin", {0.035f, 0.034f, 0.033f}, 0.8f},
    {"white panel", {0.78f, 0.78f, 0.77f}, 0.45f},
    {"livery yellow", {0.82f, 0.66f, 0.03f}, 0.35f},
    {"livery blue", {0.01f, 0.07f, 0.32f}, 0.35f},
    {"chequers", {1.0f, 1.0f, 1.0f}, 0.4f},
    {"lettering", {1.0f, 1.0f, 1.0f}, 0.4f},
    {"lettering mirrored", {1.0f, 1.0f, 1.0f}, 0.4f},
    {"lens head", {0.62f, 0.64f, 0.66f}, 0.08f, 0.0f, {9.0f, 8.6f, 7.6f}},
    {"lens tail", {0.10f, 0.004f, 0.004f}, 0.12f, 0.0f, {0.55f, 0.02f, 0.012f}},
    {"lens brake", {0.11f, 0.004f, 0.004f}, 0.12f, 0.0f, {6.0f, 0.05f, 0.03f}},
    {"lens reverse", {0.60f, 0.60f, 0.60f}, 0.12f, 0.0f, {3.0f, 3.0f, 2.9f}},
    {"lens indicator", {0.62f, 0.24f, 0.02f}, 0.12f, 0.0f, {5.5f, 2.1f, 0.08f}},
    {"lens beacon", {0.02f, 0.08f, 0.45f}, 0.10f, 0.0f, {0.7f, 3.0f, 16.0f}},
    {"skin", {0.50f, 0.30f, 0.21f}, 0.6f},
    {"cloth dark", {0.035f, 0.05f, 0.09f}, 0.9f},
    {"cloth bright", {0.42f, 0.12f, 0.07f}, 0.9f},
    {"leather", {0.03f, 0.02f, 0.016f}, 0.6f},
    {"tarpaulin", {0.60f, 0.61f, 0.62f}, 0.6f},
    {"fire red", {0.55f, 0.012f, 0.012f}, 0.7f, 0.0f, {}, 1.0f, lacquer},
    {"police lettering", {1.0f, 1.0f, 1.0f}, 0.4f},
    {"taxi sign", {1.0f, 1.0f, 1.0f}, 0.4f, 0.0f, {0.5f, 0.5f, 0.5f}},
    {"timber", {0.23f, 0.14f, 0.075f}, 0.9f},
    {"clear glass", {0.012f, 0.016f, 0.018f}, 0.06f, 0.0f, {0.0f, 0.0f, 0.0f}, 0.42f},
    {"mirror", {0.9f, 0.9f, 0.9f}, 0.02f, 1.0f},
    {"cloth", {0.75f, 0.75f, 0.75f}, 0.9f},
    {"hair", {0.035f, 0.02f, 0.012f}, 0.7f},
    {"lining", {0.30f, 0.28f, 0.25f}, 0.95f, 0.0f, {}, 1.0f, 0.0f, 0.55f},
    {"dashboard", {0.075f, 0.075f, 0.078f}, 0.95f, 0.0f, {}, 1.0f, 0.0f, 0.55f},
}};

constexpr std::uint32_t plate_columns = 4, plate_rows = 8, plate_width_px = 128, plate_height_px = 28;

/// Plate of three letters and three digits for each number.
std::string plate_text(std::uint32_t number) {
  constexpr std::string_view letters = "ABCDEFGHJKLMNOPRSTUWXYZ";  // Letters of Swedish plates.
  const auto letter = [&](std::uint32_t step) { return letters[(number * step + step / 2) % letters.size()]; };
  return {letter(5),
          letter(7),
          letter(11),
          ' ',
          static_cast<char>('0' + number * 7 % 10),
          static_cast<char>('0' + number * 3 / 10 % 10),
          static_cast<char>('0' + (number * 9 + 4) % 10)};
}

/// Picture of all plates, with a border that is visible on white paint.
Image plate_image() {
  Image plates(plate_columns * plate_width_px, plate_rows * plate_height_px, {20, 20, 22});
  const Lettering bold(image::FontStyle::bold);
  for (std::uint32_t number = 0; number < plate_columns * plate_rows; ++number) {
    const std::uint32_t x = number % plate_columns * plate_width_px, y = number / plate_columns * plate_height_px;
    image::fill(plates, x + 2, y + 2, plate_width_px - 4, plate_height_px - 4, {236, 238, 236});
    image::fill(plates, x + 2, y + 2, 12, plate_height_px - 4, {18, 60, 150});
    bold.centred(plates, x + 8, y + 22, "S", 9, {240, 240, 240});
    bold.centred(plates, x + 70, y + 22, plate_text(number), 22, {16, 16, 18});
  }
  return plates;
}

/// Picture of two rows of chequers, as on Swedish ambulances: blue and yellow in turn.
Image chequer_image() {
  const Color yellow{246, 212, 30}, blue{14, 60, 140};
  Image chequers(128, 32, yellow);
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 8; ++column)
      if ((row + column) % 2 == 0) image::fill(chequers, column * 16, row * 16, 16, 16, blue);
  return chequers;
}

/// Picture of one word on a ground, centred.
Image word_image(const char* word, Color ground, Color ink) {
  Image text(128, 40, ground);
  Lettering(image::FontStyle::bold).centred(text, 64, 33, word, 34, ink);
  return text;
}

Image lettering_image(bool mirrored) {
  Image text(256, 48, {246, 212, 30});
  Lettering(image::FontStyle::bold).centred(text, 128, 39, "AMBULANS", 42, {14, 60, 140});
  if (!mirrored) return text;
  Image turned(text.width, text.height);
  for (std::uint32_t y = 0; y < text.height; ++y)
    for (std::uint32_t x = 0; x < text.width; ++x) turned.set(x, y, text.at(text.width - 1 - x, y));
  return turned;
}

}  // namespace

Palette add_finishes(scene::SceneBuilder& builder) {
  Palette palette;
  for (std::uint32_t i = 0; i < looks.size(); ++i) {
    const Look& look = looks[i];
    scene::MaterialParameters material;
    material.base_color = look.color;
    material.roughness = look.roughness;
    material.metallic = look.metallic;
    material.emission = look.emission;
    material.opacity = look.opacity;
    material.clear_coat = look.clear_coat;
    material.ambient_share = look.ambient_share;
    material.takes_paint = i == index_of(Finish::paint) || i == index_of(Finish::cloth);
    const std::string name = std::string("vehicle/") + look.name;
    const auto with_image = [&](const Image& picture) {
      material.base_color_bitmap = builder.add_bitmap(name, picture.width, picture.height, picture.rgba);
    };
    if (i == index_of(Finish::plate)) {
      with_image(plate_image());
      material.picture_columns = plate_columns;
      material.picture_rows = plate_rows;
      material.retroreflection = 50.0f;  // ISO 7591: 70 to 50 cd per lx and m².
    }
    if (i == index_of(Finish::chequers)) with_image(chequer_image());
    if (i == index_of(Finish::lettering)) with_image(lettering_image(false));
    if (i == index_of(Finish::lettering_mirrored)) with_image(lettering_image(true));
    if (i == index_of(Finish::police_lettering)) with_image(word_image("POLIS", {236, 238, 236}, {14, 60, 140}));
    if (i == index_of(Finish::taxi_sign))
      with_image(word_image("TAXI", {246, 212, 30}, {16, 16, 18})), scene::shine_by_picture(material);
    palette.push_back(builder.add_material(name, material));
  }
  return palette;
}

}  // namespace septet::scenery
