#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "sim-client/ice/ice_viewer.hpp"
#include "tests/benchmarks/figures/ice_figures.hpp"
#include "tests/engine/instant/ray_through.hpp"

namespace septet::figures {
namespace {

using ice_viewer::IceOptions;

IceOptions options_of(const char* object, ice::Mode mode) {
  IceOptions options;
  options.object = object;
  options.look.mode = mode;
  options.look.seen_beyond = true;
  options.width_px = 400;
  options.height_px = 300;
  // A ball around the teapot is emptier than one around the cube.
  options.share_of_picture = options.object == "teapot" ? 1.1 : 0.5;
  options.turn_deg = 30.0;
  options.software = true;
  return options;
}

IceOptions clear(IceOptions options) {
  options.cracks = options.air_planes = 0;
  return options;
}

double turn_rad(const IceOptions& options) { return options.turn_deg * 3.14159265358979 / 180.0; }

class Studio {
 public:
  explicit Studio(render::Renderer renderer) : renderer_(std::move(renderer)) {}

  Expected<image::Image> draw(const IceOptions& options) {
    const auto surface = ice::object(options.object);
    if (!surface) return tl::unexpected(surface.error());
    if (const auto drawn = renderer_.draw(frame_of(*surface, options, turn_rad(options))); !drawn)
      return tl::unexpected(drawn.error());
    return renderer_.read_back();
  }

 private:
  render::Renderer renderer_;
};

Expected<Studio> open_studio() {
  auto renderer = render::Renderer::create(
      {400, 300, render::DevicePreference::software, false, render::Antialiasing::smoothing, nullptr});
  if (!renderer) return tl::unexpected(renderer.error());
  if (const auto uploaded = renderer->upload(scene_around(ice_viewer::Surroundings::outdoors)); !uploaded)
    return tl::unexpected(uploaded.error());
  return Studio(std::move(*renderer));
}

/// Pictures of one size side by side, `columns` a row.
image::Image sheet(const std::vector<image::Image>& pictures, std::uint32_t columns) {
  constexpr std::uint32_t gap = 4;
  const std::uint32_t width = pictures.front().width, height = pictures.front().height;
  const auto rows = static_cast<std::uint32_t>((pictures.size() + columns - 1) / columns);
  image::Image result(columns * (width + gap) - gap, rows * (height + gap) - gap, {255, 255, 255, 255});
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const auto column = static_cast<std::uint32_t>(i % columns), row = static_cast<std::uint32_t>(i / columns);
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x)
        result.set(column * (width + gap) + x, row * (height + gap) + y, pictures[i].at(x, y));
  }
  return result;
}

/// |cos| between the ray and the face that it meets first; nothing: −1.
double met(const std::vector<ice::IceVertex>& triangles, const Vec3& from, const Vec3& ray) {
  double nearest = INFINITY, cosine = -1.0;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const Vec3 a(triangles[i].position_m), ab = Vec3(triangles[i + 1].position_m) - a,
                                           ac = Vec3(triangles[i + 2].position_m) - a;
    const Vec3 p = glm::cross(ray, ac), off = from - a, q = glm::cross(off, ab);
    const double det = glm::dot(ab, p);
    if (std::abs(det) < 1e-14) continue;
    const double u = glm::dot(off, p) / det, v = glm::dot(ray, q) / det, at = glm::dot(ac, q) / det;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || at <= 0.0 || at >= nearest) continue;
    nearest = at;
    cosine = std::abs(glm::dot(glm::normalize(glm::cross(ab, ac)), glm::normalize(ray)));
  }
  return cosine;
}

/// Figure 5 c: cracks as they are, over the picture.
void draw_unclipped(image::Image& picture, const IceOptions& options) {
  const instant::FrameInput input = frame_of(*ice::object(options.object), options, turn_rad(options));
  const Vec3 from = world_eye(input.views[0]);
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x)
      if (const double cosine = met(input.ice[0].inside, from, ray_through(input.views[0], x + 0.5, y + 0.5));
          cosine >= 0.0)
        picture.set(x, y, {static_cast<std::uint8_t>(std::clamp(120.0 + 135.0 * cosine, 0.0, 255.0)), 20, 20, 255});
}

}  // namespace

Expected<void> draw_ice_pictures(const std::filesystem::path& folder) {
  auto studio = open_studio();
  if (!studio) return tl::unexpected(studio.error());
  const auto write = [&](const char* name, const std::vector<image::Image>& pictures, std::uint32_t columns,
                         const char* says) -> Expected<void> {
    const auto path = folder / (std::string(name) + ".png");
    if (auto written = image::write_png(path, sheet(pictures, columns)); !written) return written;
    fmt::print("{}\n  {}\n", path.string(), says);
    return {};
  };
  std::vector<image::Image> pictures;
  Expected<void> failed;
  const auto add = [&](const IceOptions& options) {
    auto picture = studio->draw(options);
    if (picture)
      pictures.push_back(std::move(*picture));
    else
      failed = tl::unexpected(picture.error());
  };
  const auto finish = [&](const char* name, std::uint32_t columns, const char* says) {
    if (failed) failed = write(name, pictures, columns, says);
    pictures.clear();
    return failed.has_value();
  };
  for (const ice::Mode mode : {ice::Mode::paper, ice::Mode::quality}) add(options_of("cube", mode));
  if (!finish("ice-1-cube", 2,
              "figure 1: ice with multiple specular reflections and refraction; beside it the quality mode"))
    return failed;
  for (const bool two_sided : {true, false}) {
    IceOptions teapot = clear(options_of("teapot", ice::Mode::paper));
    teapot.look.two_sided = two_sided;
    add(teapot);
  }
  if (!finish("ice-4-teapot", 2, "figure 4: the teapot with (a) two-sided and (b) one-sided refraction")) return failed;
  IceOptions cracked = options_of("cube", ice::Mode::paper);
  cracked.air_planes = 0;
  cracked.mark_cracks = true;
  IceOptions depth = clear(cracked);
  for (const ice::Shown shown : {ice::Shown::front_depth, ice::Shown::back_depth, ice::Shown::all}) {
    depth.look.shown = shown;
    add(depth);
  }
  if (failed) draw_unclipped(pictures.back(), cracked);
  add(cracked);
  if (!finish("ice-5-cracks", 2,
              "figure 5: depth of (a) front and (b) back faces, (c) cracks without and (d) with clipping"))
    return failed;
  for (const ice::Mode mode : {ice::Mode::paper, ice::Mode::quality})
    for (const char* object : {"sphere", "cube", "teapot"}) add(options_of(object, mode));
  finish("ice-objects", 3, "section 4: sphere, cube and teapot; below in the quality mode");
  return failed;
}

}  // namespace septet::figures
