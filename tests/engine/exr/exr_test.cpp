#include "engine/exr/exr.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <doctest/doctest.h>

#include "tests/temporary_folder.hpp"

namespace septet::exr {
namespace {
namespace fs = std::filesystem;

constexpr std::uint32_t width = 37, height = 19;

/// Values that a display does not hold, and numbers that a float does not.
Picture gradient() {
  Picture picture{.width = width, .height = height};
  std::vector<float> light, depth;
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t n = 0; n < width * height; ++n) {
    light.push_back(1e-6f * static_cast<float>(n * n * n));
    depth.push_back(n == 0 ? std::numeric_limits<float>::infinity() : 1.0f / static_cast<float>(n));
    numbers.push_back(0xffffffffu - n);
  }
  picture.channels = {{"R", ChannelType::half_precision, light},
                      {"G", ChannelType::half_precision, std::vector<float>(light.size(), 1e6f)},
                      {"Z", ChannelType::single_precision, depth},
                      {"object", ChannelType::number, numbers}};
  return picture;
}

template <class Value>
std::vector<Value> read(Imf::InputFile& file, const char* name, Imf::PixelType type) {
  std::vector<Value> values(std::size_t{width} * height);
  Imf::FrameBuffer buffer;
  buffer.insert(name, Imf::Slice(type, reinterpret_cast<char*>(values.data()), sizeof(Value),
                                 sizeof(Value) * std::size_t{width}));
  file.setFrameBuffer(buffer);
  file.readPixels(0, static_cast<int>(height) - 1);
  return values;
}

}  // namespace

TEST_CASE("OpenEXR reads what was written: halves as near as halves are and the rest bit for bit") {
  const TemporaryFolder folder;
  const Picture picture = gradient();
  REQUIRE(write(folder / "a.exr", picture).has_value());
  Imf::InputFile file((folder / "a.exr").c_str());
  CHECK(file.header().channels().findChannel("R")->type == Imf::HALF);
  CHECK(file.header().channels().findChannel("Z")->type == Imf::FLOAT);
  CHECK(file.header().channels().findChannel("object")->type == Imf::UINT);
  const auto& light = std::get<std::vector<float>>(picture.channels[0].values);
  const auto half_light = read<float>(file, "R", Imf::FLOAT);
  bool near = true;
  for (std::size_t n = 0; n < light.size(); ++n)
    near = near && std::abs(half_light[n] - light[n]) <= light[n] / 2048.0f + 3e-8f;
  CHECK(near);
  CHECK(read<float>(file, "G", Imf::FLOAT) == std::vector<float>(light.size(), 65504.0f));
  CHECK(read<float>(file, "Z", Imf::FLOAT) == std::get<std::vector<float>>(picture.channels[2].values));
  CHECK(read<std::uint32_t>(file, "object", Imf::UINT) ==
        std::get<std::vector<std::uint32_t>>(picture.channels[3].values));
  CHECK(encode(picture) == encode(picture));
}

TEST_CASE("OpenEXR reads the header: light and camera in its own words and the rest by name") {
  const TemporaryFolder folder;
  Picture picture = gradient();
  picture.frames_per_second = 29.97;
  picture.white_luminance_cdpm2 = 123.0f;
  picture.screen_middle = {0.25f, -0.5f};
  picture.screen_width = 1.5f;
  picture.camera_from_world[3] = {1.0, 2.0, 3.0, 1.0};
  picture.camera_from_world[1] = {0.5, 0.6, 0.7, 0.0};
  picture.attributes = {{"text", std::string("Årsta €")}, {"tick", 1e15 + 0.5}, {"eye", Vec3(1e7 + 0.125, -2.0, 3.0)}};
  REQUIRE(write(folder / "a.exr", picture).has_value());
  const Imf::InputFile file((folder / "a.exr").c_str());
  const Imf::Header& header = file.header();
  CHECK(header.screenWindowWidth() == 1.5f);
  CHECK(header.screenWindowCenter() == Imath::V2f(0.25f, -0.5f));
  CHECK(Imf::whiteLuminance(header) == 123.0f);
  CHECK(Imf::framesPerSecond(header) == Imf::Rational(30000, 1001));
  // Where the world's y = 1 lies for the camera.
  Imath::V3f seen;
  Imf::worldToCamera(header).multVecMatrix(Imath::V3f(0, 1, 0), seen);
  CHECK(seen == Imath::V3f(1.5f, 2.6f, 3.7f));
  CHECK(header.typedAttribute<Imf::StringAttribute>("text").value() == "Årsta €");
  CHECK(header.typedAttribute<Imf::DoubleAttribute>("tick").value() == 1e15 + 0.5);
  CHECK(header.typedAttribute<Imf::V3dAttribute>("eye").value() == Imath::V3d(1e7 + 0.125, -2.0, 3.0));
}

TEST_CASE("a picture that cannot be written leaves nothing behind and what was there stays") {
  const TemporaryFolder folder;
  REQUIRE(write(folder / "a.exr", gradient()).has_value());
  if (fs::exists("/dev/full")) {
    fs::create_symlink("/dev/full", folder / "a.exr.part");
    const auto written = write(folder / "a.exr", gradient());
    REQUIRE_FALSE(written.has_value());
    CHECK(describe(written.error()).find("free some space") != std::string::npos);
    CHECK(describe(written.error()).find("a.exr") != std::string::npos);
  }
  CHECK(is_whole(folder / "a.exr", width, height));
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
  CHECK_FALSE(write(folder / "nowhere" / "a.exr", gradient()).has_value());
}

TEST_CASE("a file that is cut or of another size or no picture is not whole") {
  const TemporaryFolder folder;
  const fs::path file = folder / "a.exr";
  CHECK_FALSE(is_whole(file, width, height));
  REQUIRE(write(file, gradient()).has_value());
  CHECK(is_whole(file, width, height));
  CHECK_FALSE(is_whole(file, width + 1, height));
  CHECK_FALSE(is_whole(file, width, height - 1));
  const auto size = fs::file_size(file);
  for (const auto cut : {size - 1, size - 1000, size / 2, std::uintmax_t{300}, std::uintmax_t{3}, std::uintmax_t{0}}) {
    CAPTURE(cut);
    fs::resize_file(file, cut);
    CHECK_FALSE(is_whole(file, width, height));
  }
  std::ofstream(file, std::ios::binary) << "\x76\x2f\x31\x01 and then no header";
  CHECK_FALSE(is_whole(file, width, height));
  CHECK_FALSE(is_whole(folder.path(), width, height));
}

}  // namespace septet::exr
