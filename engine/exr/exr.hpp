#pragma once
/// Pictures of any channels as OpenEXR files: light without a display's limits, and further data of each pixel. Wraps
/// OpenEXR 3. Scan lines, compressed without loss (ZIP); the same picture gives the same bytes.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/math/rigid_transform.hpp"

namespace septet::exr {

enum class ChannelType : std::uint8_t {
  half_precision,    ///< 16 bits: 11 binary digits, up to 65504; larger values are clamped to that.
  single_precision,  ///< 32 bits.
  number,            ///< Unsigned, 32 bits.
};

/// One value a pixel, rows from the top.
struct Channel {
  std::string name;  ///< "R", "G", "B", "Z"; of a layer "LAYER.NAME".
  ChannelType type = ChannelType::half_precision;
  std::variant<std::vector<float>, std::vector<std::uint32_t>> values;  ///< Integers for `number`.
};

using Attribute = std::variant<std::string, double, Vec3>;

struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<Channel> channels;  ///< Colours are linear Rec. 709.
  double frames_per_second = 25.0;
  float white_luminance_cdpm2 = 1.0f;  ///< Luminance of R = G = B = 1.
  glm::vec2 screen_middle{0.0f};       ///< Middle of the picture, on a screen at distance 1.
  float screen_width = 1.0f;
  glm::dmat4 camera_from_world{1.0};  ///< x to the right, y up, z ahead: left-handed, by OpenEXR's convention.
  std::map<std::string, Attribute> attributes;  ///< Further attributes of the header.
};

/// Each channel has a value for each pixel (checked).
Bytes encode(const Picture& picture);

/// Whole or not at all: beside its place, then renamed. Error: it cannot be written there.
Expected<void> write(const std::filesystem::path& path, const Picture& picture);

/// True where the file can be read to its end and holds a picture of this size.
bool is_whole(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height);

}  // namespace septet::exr
