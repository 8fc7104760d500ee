#include "engine/image/png.hpp"

#include <filesystem>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::image {
namespace {

Image noise(std::uint32_t width, std::uint32_t height) {
  Random random(7);
  Image image(width, height);
  for (auto& byte : image.rgba) byte = static_cast<std::uint8_t>(random.below(256));
  return image;
}

}  // namespace

TEST_CASE("an image comes back from PNG as it was") {
  const Image image = noise(61, 37);
  for (const PngEffort effort : {PngEffort::fast, PngEffort::small}) {
    const auto back = decode_png(encode_png(image, effort), "test");
    REQUIRE(back.has_value());
    CHECK(*back == image);
  }
}

TEST_CASE("a PNG file is written and read") {
  const TemporaryFolder folder;
  const auto path = folder / "noise.png";
  const Image image = noise(16, 9);
  REQUIRE(write_png(path, image).has_value());
  const auto back = read_png(path);
  REQUIRE(back.has_value());
  CHECK(*back == image);
}

TEST_CASE("a full disk is reported when an image is written") {
  if (!std::filesystem::exists("/dev/full")) {
    MESSAGE("no /dev/full on this system");
    return;
  }
  const auto written = write_png("/dev/full", noise(64, 64));
  REQUIRE_FALSE(written.has_value());
  CHECK(written.error().where == "/dev/full");
  CHECK(written.error().remedy == "free some space on the disk");
}

TEST_CASE("a missing folder and a missing file are reported with their path") {
  const auto written = write_png("/nonexistent/picture.png", noise(2, 2));
  REQUIRE_FALSE(written.has_value());
  CHECK(written.error().where == "/nonexistent/picture.png");
  CHECK_FALSE(read_png("/nonexistent/picture.png").has_value());
}

TEST_CASE("a picture that cannot be written whole leaves the one that stood there") {
  const TemporaryFolder folder;
  const auto path = folder / "kept.png";
  const Image first = noise(16, 9);
  REQUIRE(write_png(path, first).has_value());
  std::filesystem::create_directory(path.string() + ".part");
  const auto written = write_png(path, noise(8, 8));
  REQUIRE_FALSE(written.has_value());
  CHECK(written.error().where == path.string());
  CHECK(*read_png(path) == first);
}

TEST_CASE("a damaged PNG is refused") {
  Bytes bytes = encode_png(noise(32, 32));
  for (const std::size_t length : {std::size_t{0}, std::size_t{7}, bytes.size() / 2}) {
    const auto decoded = decode_png(std::span(bytes).first(length), "half a file");
    REQUIRE_FALSE(decoded.has_value());
    CHECK(decoded.error().where == "half a file");
  }
  bytes[bytes.size() / 2] ^= std::byte{0xff};
  CHECK_FALSE(decode_png(bytes, "flipped bits").has_value());
}

}  // namespace septet::image
