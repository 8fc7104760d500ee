#include "engine/exr/exr.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <system_error>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfFramesPerSecond.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>

#include "engine/core/check.hpp"
#include "engine/core/whole_file.hpp"

namespace septet::exr {
namespace {

constexpr float largest_half = 65504.0f;

/// Seekable: OpenEXR goes back to write the offsets of its parts.
class BytesStream : public Imf::OStream {
 public:
  explicit BytesStream(Bytes& bytes) : Imf::OStream("memory"), bytes_(bytes) {}
  void write(const char text[], int count) override {
    const auto size = static_cast<std::size_t>(std::max(count, 0));
    if (place_ + size > bytes_.size()) bytes_.resize(place_ + size);
    std::memcpy(bytes_.data() + place_, text, size);
    place_ += size;
  }
  std::uint64_t tellp() override { return place_; }
  void seekp(std::uint64_t place) override { place_ = place; }

 private:
  Bytes& bytes_;
  std::size_t place_ = 0;
};

Imf::PixelType type_of(const Channel& channel) {
  if (channel.type == ChannelType::number) return Imf::UINT;
  return channel.type == ChannelType::half_precision ? Imf::HALF : Imf::FLOAT;
}

std::size_t count_of(const Channel& channel) {
  return std::visit([](const auto& values) { return values.size(); }, channel.values);
}

Imf::Header header_of(const Picture& picture) {
  const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
  Imf::Header header(width, height, 1.0f, {picture.screen_middle.x, picture.screen_middle.y}, picture.screen_width,
                     Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
  Imf::addChromaticities(header, Imf::Chromaticities());  // Rec. 709.
  Imf::addWhiteLuminance(header, picture.white_luminance_cdpm2);
  Imf::addFramesPerSecond(header, Imf::guessExactFps(picture.frames_per_second));
  // A point is a row vector there, before the matrix: a column of ours is a row of theirs.
  Imath::M44f camera;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) camera[column][row] = static_cast<float>(picture.camera_from_world[column][row]);
  Imf::addWorldToCamera(header, camera);
  for (const auto& [name, attribute] : picture.attributes) {
    if (const auto* text = std::get_if<std::string>(&attribute))
      header.insert(name, Imf::StringAttribute(*text));
    else if (const auto* number = std::get_if<double>(&attribute))
      header.insert(name, Imf::DoubleAttribute(*number));
    else if (const auto* place = std::get_if<Vec3>(&attribute))
      header.insert(name, Imf::V3dAttribute({place->x, place->y, place->z}));
  }
  return header;
}

/// Clamped to the range of halves.
std::vector<half> halves_of(const std::vector<float>& values) {
  std::vector<half> halves(values.size());
  std::transform(values.begin(), values.end(), halves.begin(), [](float value) {
    return half(std::isinf(value) ? value : std::clamp(value, -largest_half, largest_half));
  });
  return halves;
}

}  // namespace

Bytes encode(const Picture& picture) {
  SEPTET_CHECK(picture.width > 0 && picture.height > 0, "{} × {}", picture.width, picture.height);
  Imf::Header header = header_of(picture);
  Imf::FrameBuffer buffer;
  std::vector<std::vector<half>> halves(picture.channels.size());
  for (std::size_t n = 0; n < picture.channels.size(); ++n) {
    const Channel& channel = picture.channels[n];
    SEPTET_CHECK(count_of(channel) == std::size_t{picture.width} * picture.height, "{} values of {}", count_of(channel),
                 channel.name);
    const auto* numbers = std::get_if<std::vector<std::uint32_t>>(&channel.values);
    SEPTET_CHECK((channel.type == ChannelType::number) == (numbers != nullptr), "channel {}", channel.name);
    header.channels().insert(channel.name, Imf::Channel(type_of(channel)));
    const void* first = numbers;
    std::size_t bytes = sizeof(float);
    if (numbers) {
      first = numbers->data();
    } else if (const auto& values = std::get<std::vector<float>>(channel.values); type_of(channel) == Imf::HALF) {
      halves[n] = halves_of(values);
      first = halves[n].data(), bytes = sizeof(half);
    } else {
      first = values.data();
    }
    // OpenEXR only reads the data of this slice.
    buffer.insert(channel.name, Imf::Slice(type_of(channel), static_cast<char*>(const_cast<void*>(first)), bytes,
                                           bytes * picture.width));
  }
  Bytes bytes;
  BytesStream stream(bytes);
  {
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(buffer);
    file.writePixels(static_cast<int>(picture.height));
  }
  return bytes;
}

Expected<void> write(const std::filesystem::path& path, const Picture& picture) {
  return write_whole_file(path, "image", encode(picture));
}

bool is_whole(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  try {
    Imf::InputFile file(path.c_str(), 0);
    const Imath::Box2i window = file.header().dataWindow();
    if (window.min != Imath::V2i(0) || window.max.x + 1ll != width || window.max.y + 1ll != height) return false;
    std::vector<float> line(width);
    Imf::FrameBuffer buffer;
    buffer.insert("R", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(line.data()), sizeof(float), 0));
    file.setFrameBuffer(buffer);
    file.readPixels(0, window.max.y);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace septet::exr
