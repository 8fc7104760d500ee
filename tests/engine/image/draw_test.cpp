#include "engine/image/draw.hpp"

#include <doctest/doctest.h>

#include "engine/image/font.hpp"
#include "tests/relative.hpp"

namespace septet::image {
namespace {
constexpr Color black{0, 0, 0}, white{255, 255, 255}, red{255, 0, 0};
}

TEST_CASE("blending half of white over black gives grey and keeps it opaque") {
  CHECK(blend(black, white, 0.5f) == Color{128, 128, 128, 255});
  CHECK(blend({9, 9, 9, 0}, red, 1.0f) == red);
}

TEST_CASE("filling is cut off at the edges of the image") {
  Image image(4, 4, black);
  fill(image, -2, 2, 4, 10, red);
  CHECK(image.at(0, 2) == red);
  CHECK(image.at(1, 3) == red);
  CHECK(image.at(2, 2) == black);
  CHECK(image.at(0, 1) == black);
}

TEST_CASE("the box filter keeps the mean of an image") {
  Image image(6, 4, black);
  fill(image, 0, 0, 3, 4, white);
  const Image half = resize(image, 4, 2);
  double sum = 0.0;
  for (std::uint32_t y = 0; y < 2; ++y)
    for (std::uint32_t x = 0; x < 4; ++x) sum += half.at(x, y).red;
  CHECK(sum / 8.0 == relative(127.5, 0.005));
  CHECK(half.at(0, 0) == white);
  CHECK(half.at(3, 1) == black);
}

TEST_CASE("a pixel that lies half within another counts half") {
  Image image(3, 1, black);
  image.set(0, 0, white);
  const Image two = resize(image, 2, 1);
  CHECK(two.at(0, 0).red == 170);  // One of the pixel and a half that it covers.
  CHECK(two.at(1, 0).red == 0);
}

TEST_CASE("a line is as wide as it was asked for wherever it lies") {
  for (const double y : {5.5, 5.25, 5.0})
    for (const double width_px : {1.0, 2.0, 3.5}) {
      Image image(11, 11, black);
      line(image, -5.0, y, 20.0, y, width_px, white);
      double sum = 0.0;
      for (std::uint32_t row = 0; row < 11; ++row) sum += image.at(5, row).red / 255.0;
      CHECK(sum == relative(width_px, 0.02));
    }
}

TEST_CASE("a transparent pixel lends no colour to a smaller image") {
  Image image(2, 1, {0, 255, 0, 0});
  image.set(0, 0, red);
  CHECK(resize(image, 1, 1) == Image(1, 1, {255, 0, 0, 128}));
}

TEST_CASE("a line covers its middle and leaves the rest") {
  Image image(11, 11, black);
  line(image, 1.5, 5.5, 9.5, 5.5, 3.0, white);
  CHECK(image.at(5, 5) == white);
  CHECK(image.at(5, 4) == white);
  CHECK(image.at(5, 2) == black);
}

TEST_CASE("a polygon covers the area that it encloses") {
  Image image(20, 20, black);
  polygon(image, {{2.5, 2.5}, {17.5, 2.5}, {2.5, 17.5}}, white);
  double sum = 0.0;
  for (std::uint32_t y = 0; y < 20; ++y)
    for (std::uint32_t x = 0; x < 20; ++x) sum += image.at(x, y).red / 255.0;
  CHECK(sum == relative(112.5, 0.02));
}

TEST_CASE("text leaves ink within the width that was promised") {
  const auto font = Font::find(FontStyle::bold);
  REQUIRE(font.has_value());
  const double width = font->width_px("Malmö 18", 40.0);
  CHECK(width > 100.0);
  CHECK(width < 300.0);
  Image image(320, 60, black);
  font->draw(image, 4.0, 45.0, "Malmö 18", 40.0, white);
  std::uint32_t leftmost = 320, rightmost = 0;
  for (std::uint32_t y = 0; y < 60; ++y)
    for (std::uint32_t x = 0; x < 320; ++x)
      if (image.at(x, y).red > 128) {
        leftmost = std::min(leftmost, x);
        rightmost = std::max(rightmost, x);
      }
  CHECK(leftmost >= 4);
  CHECK(rightmost > 0.9 * width);
  CHECK(rightmost < width + 5.0);
}

TEST_CASE("broken UTF-8 is drawn and does not end the text") {
  const auto font = Font::find();
  REQUIRE(font.has_value());
  CHECK(font->width_px("a\xc3", 20.0) > font->width_px("a", 20.0));
  CHECK(font->width_px("\xff"
                       "b",
                       20.0) > font->width_px("b", 20.0));
}

}  // namespace septet::image
