#include "sim-client/ice/ice_viewer.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include "engine/core/regular_file.hpp"
#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "program/console.hpp"
#include "sim-client/ice/ice_window.hpp"
#include "sim-client/ice/reference_files.hpp"

namespace septet::ice_viewer {

Expected<ice::Surface> read_surface(const std::string& object, const std::function<void(const std::string&)>& say) {
  Expected<ice::Surface> surface = tl::unexpected(Error{});
  if (object.find('.') == std::string::npos && object.find('/') == std::string::npos) {
    surface = ice::object(object);
  } else {
    // Two million triangles.
    constexpr std::size_t largest_bytes = std::size_t{1} << 28;
    const Expected<std::string> text = read_regular_file(object, largest_bytes);
    if (!text) return tl::unexpected(text.error());
    surface = ice::read_object(*text, object);
  }
  if (surface)
    if (const std::string faults = told(ice::faults(*surface)); !faults.empty()) say(object + ": " + faults);
  return surface;
}

ice::IceBody body_of(const ice::Surface& surface, const IceOptions& options, double turn_rad) {
  ice::IceBody body;
  body.look = options.look;
  body.vertices = surface;
  const ice::Box box = bounds(surface);
  const ice::InsideKind kind = options.mark_cracks ? ice::InsideKind::mark : ice::InsideKind::crack;
  // With very many cracks their flatness is invisible.
  const std::uint32_t cells = options.cracks > 200 ? 1 : 6;
  for (const ice::Crack& crack : generic_cracks(box, options.cracks, options.seed))
    append_crack(body.inside, crack, kind, cells);
  append_air(body.inside, box, options.air_planes, options.seed);
  const glm::quat turn = glm::angleAxis(static_cast<float>(turn_rad), glm::vec3(0, 0, 1));
  for (std::vector<ice::IceVertex>* vertices : {&body.vertices, &body.inside})
    for (ice::IceVertex& vertex : *vertices) {
      vertex.position_m = turn * vertex.position_m;
      vertex.normal = turn * vertex.normal;
    }
  return body;
}

instant::FrameInput frame_of(const ice::Surface& surface, const IceOptions& options, double turn_rad) {
  instant::FrameInput input;
  input.environment.visibility_m = 200e3;
  input.environment.sun_elevation_rad = 0.7;
  input.environment.sun_azimuth_rad = 2.2;
  input.environment.cloud_cover = options.surroundings == Surroundings::outdoors ? 0.3 : 0.0;
  instant::FrameView view;
  const Seat seat = seat_of(options);
  view.projection =
      instant::symmetric_view(Vec3(0.0), 0.0, seat.pitch_rad, seat.horizontal_rad, seat.vertical_rad, 0.05);
  view.world_from_car.position_m = seat.eye_m;
  view.viewport = {0, 0, options.width_px, options.height_px};
  input.views = {view};
  input.ice = {body_of(surface, options, turn_rad)};
  if (options.pair) {
    input.ice.push_back(body_of(surface, options, 0.0));
    input.ice.back().origin_m = Vec3(second_place_m);
  }
  input.ice_surroundings_px = options.surroundings_px;
  input.ice_surroundings_kept = options.surroundings_kept;
  return input;
}

Expected<int> run_ice(const IceOptions& options) {
  const Expected<ice::Surface> surface = read_surface(options.object, program::say);
  if (!surface) return tl::unexpected(surface.error());
  if (!options.reference.empty()) {
    if (const auto written = write_reference_files(*surface, options); !written) return tl::unexpected(written.error());
  }
  if (options.window) return show_in_window(*surface, options);
  std::error_code problem;
  std::filesystem::create_directories(options.out, problem);
  if (problem) return failure(problem.message(), options.out.string(), "name a folder that can be made");
  auto renderer =
      render::Renderer::create({options.width_px, options.height_px,
                                options.software ? render::DevicePreference::software : render::DevicePreference::any,
                                false, render::Antialiasing::automatic, nullptr});
  if (!renderer) return tl::unexpected(renderer.error());
  if (const auto uploaded = renderer->upload(scene_around(options.surroundings)); !uploaded)
    return tl::unexpected(uploaded.error());
  for (std::uint32_t i = 0; i < options.pictures; ++i) {
    const double turn = std::numbers::pi * (2.0 * i / options.pictures + options.turn_deg / 180.0);
    if (const auto drawn = renderer->draw(frame_of(*surface, options, turn)); !drawn)
      return tl::unexpected(drawn.error());
    const auto picture = renderer->read_back();
    if (!picture) return tl::unexpected(picture.error());
    if (const auto written = image::write_png(options.out / fmt::format("{:03}.png", i), *picture); !written)
      return tl::unexpected(written.error());
  }
  program::announce(fmt::format("{}: {} pictures of {} ({} triangles), drawn by {}", options.out.string(),
                                options.pictures, options.object, surface->size() / 3, renderer->device_name()));
  return 0;
}

}  // namespace septet::ice_viewer
