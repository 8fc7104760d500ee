#include "sim-client/ice/reference_files.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <vector>

#include <fmt/format.h>

namespace septet::ice_viewer {
namespace {

Expected<void> write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (file.flush()) return {};
  return failure("it cannot be written", path.string(), "look at the folder's rights and the disk's space");
}

std::string object_text(const ice::Surface& surface, bool pair) {
  std::string text;
  std::size_t corners = 0;
  for (const glm::vec3& place : {glm::vec3(0.0f), second_place_m}) {
    for (const ice::IceVertex& v : surface) {
      const glm::vec3 at = v.position_m + place;
      text += fmt::format("v {} {} {}\n", at.x, at.y, at.z);
      text += fmt::format("vn {} {} {}\n", v.normal.x, v.normal.y, v.normal.z);
    }
    corners += surface.size();
    if (!pair) break;
  }
  for (std::size_t i = 1; i + 2 <= corners; i += 3)
    text += fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", i, i + 1, i + 2);
  return text;
}

/// Rows from the bottom, as the format requires.
std::string panorama_bytes() {
  constexpr int width = 2048, height = 1024;
  std::vector<float> texels;
  for (int y = height - 1; y >= 0; --y)
    for (int x = 0; x < width; ++x) {
      glm::vec3 sum(0.0f);
      for (const float dx : {0.25f, 0.75f})
        for (const float dy : {0.25f, 0.75f}) {
          const float around = 2.0f * std::numbers::pi_v<float> * (static_cast<float>(x) + dx) / width;
          const float down = std::numbers::pi_v<float> * (static_cast<float>(y) + dy) / height;
          sum +=
              0.25f * panorama({std::sin(down) * std::sin(around), std::sin(down) * std::cos(around), std::cos(down)});
        }
      texels.insert(texels.end(), {sum.r, sum.g, sum.b});
    }
  std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", width, height);
  bytes.append(reinterpret_cast<const char*>(texels.data()), texels.size() * sizeof(float));
  return bytes;
}

}  // namespace

Seat seat_of(const IceOptions& options) {
  Seat seat;
  seat.horizontal_rad = 0.8;
  const double slope = std::tan(0.5 * seat.horizontal_rad);
  const double aspect = static_cast<double>(options.height_px) / options.width_px;
  seat.vertical_rad = 2.0 * std::atan(slope * aspect);
  // A ball of half a metre covers π r² / (4 s² a) of the picture, r its radius over the distance.
  const double radius =
      std::sqrt(std::clamp(options.share_of_picture, 0.01, 4.0) * 4.0 * slope * slope * aspect / std::numbers::pi);
  const double distance_m = std::max(0.62, 0.5 / radius), pitch = 0.3;
  seat.eye_m = distance_m * Vec3(-std::cos(pitch), 0.0, std::sin(pitch));
  seat.pitch_rad = -pitch;
  return seat;
}

Expected<void> write_reference_files(const ice::Surface& surface, const IceOptions& options) {
  std::error_code problem;
  std::filesystem::create_directories(options.reference, problem);
  if (problem) return failure(problem.message(), options.reference.string(), "name a folder that can be made");
  const Seat seat = seat_of(options);
  const std::string camera = fmt::format(
      "{{\"eye_m\": [{}, {}, {}], \"horizontal_deg\": {}, \"width_px\": {}, \"height_px\": {}, \"radiance\": {}}}\n",
      seat.eye_m.x, seat.eye_m.y, seat.eye_m.z, seat.horizontal_rad * 180.0 / std::numbers::pi, options.width_px,
      options.height_px, room_radiance);
  if (auto done = write(options.reference / "camera.json", camera); !done) return done;
  if (auto done = write(options.reference / "panorama.pfm", panorama_bytes()); !done) return done;
  return write(options.reference / "object.obj", object_text(surface, options.pair));
}

}  // namespace septet::ice_viewer
