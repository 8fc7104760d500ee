#include "sim-client/frame/client_frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "engine/core/check.hpp"
#include "engine/instant/mirror_view.hpp"
#include "engine/scene/motion.hpp"
#include "engine/scene/participant_root.hpp"
#include "engine/scene/world_bounds.hpp"
#include "engine/scenery/vehicles/cockpit.hpp"
#include "engine/world/instrument_panel.hpp"
#include "engine/world/paint.hpp"
#include "engine/world/solid.hpp"
#include "engine/world/traffic_light.hpp"
#include "sim-client/frame/cockpit_drawing.hpp"
#include "sim-client/frame/prototype_of.hpp"
#include "sim-client/frame/windscreen_drawing.hpp"

namespace septet::frame {
namespace {

/// Hand wheel's angle over that of the front wheels, of a vehicle whose hand wheel is not logged.
constexpr double steering_ratio = 16.0;

/// Viewport of at least one pixel of the screen, however small its window is.
instant::PixelRectangle viewport(const rig::View& view, const rig::Screen& screen) {
  const auto span = [](double from, double length, std::uint32_t size) {
    const auto begin = std::clamp<std::int64_t>(std::lround(from * size), 0, std::int64_t{size} - 1);
    const auto end = std::clamp<std::int64_t>(std::lround((from + length) * size), begin + 1, std::int64_t{size});
    return std::pair(static_cast<std::int32_t>(begin), static_cast<std::uint32_t>(end - begin));
  };
  const auto across = span(view.left, view.width, screen.width_px),
             down = span(view.top, view.height, screen.height_px);
  return {.x = across.first, .y = down.first, .width = across.second, .height = down.second};
}

/// View of the panel of instruments from its front, in the middle of the screen, from so far that needles do not shift
/// against their faces.
ScreenViews panel_views(const rig::Screen& screen) {
  namespace panel = instrument_panel;
  const double shape = double(screen.width_px) / screen.height_px;
  const double width_m = std::max(panel::width_m, panel::height_m * shape), height_m = width_m / shape;
  const auto corner = [&](double across, double upward) {
    return panel::middle_m + 0.5 * (across * width_m * panel::right + upward * height_m * panel::up);
  };
  constexpr double eye_m = 3.0, near_m = 0.5;
  const auto projection = instant::off_axis_view({corner(-1, -1), corner(1, -1), corner(-1, 1)},
                                                 panel::middle_m + eye_m * panel::normal, near_m);
  SEPTET_CHECK(projection.has_value(), "the panel is seen from its front");
  ScreenViews result;
  result.only_instruments = true;
  result.views.push_back({.projection = *projection, .viewport = {0, 0, screen.width_px, screen.height_px}});
  return result;
}

/// Rectangle of the interior's dials in a view; empty if they are not before the eyes.
std::optional<instant::PixelRectangle> dials_in(const instant::FrameView& view) {
  namespace panel = instrument_panel;
  glm::dvec2 low(1e6), high(-1e6);
  // One end of them may be behind the eyes while the other is visible.
  for (const double across : {-0.5, -0.4, -0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3, 0.4, 0.5})
    for (const double upward : {-0.5, 0.5}) {
      const Vec3 at = panel::middle_m + across * panel::width_m * panel::right + upward * panel::height_m * panel::up;
      const glm::dvec4 clip = view.projection.clip_from_eye_relative * glm::dvec4(at - view.projection.eye_m, 1.0);
      if (clip.w < 1e-3) continue;
      const glm::dvec2 share(0.5 + 0.5 * clip.x / clip.w, 0.5 + 0.5 * clip.y / clip.w);
      low = glm::min(low, share);
      high = glm::max(high, share);
    }
  if (high.x < 0.0 || low.x > 1.0 || high.y < 0.0 || low.y > 1.0) return std::nullopt;
  low = glm::max(low, 0.0);
  high = glm::min(high, 1.0);
  const glm::dvec2 size(view.viewport.width, view.viewport.height);
  const glm::ivec2 from(glm::floor(low * size)), to(glm::ceil(high * size));
  return instant::PixelRectangle{view.viewport.x + from.x, view.viewport.y + from.y,
                                 static_cast<std::uint32_t>(to.x - from.x), static_cast<std::uint32_t>(to.y - from.y)};
}

bool overlap(const instant::PixelRectangle& a, const instant::PixelRectangle& b) {
  const auto meet = [](std::int64_t from, std::int64_t size, std::int64_t other_from, std::int64_t other_size) {
    return from < other_from + other_size && other_from < from + size;
  };
  return meet(a.x, a.width, b.x, b.width) && meet(a.y, a.height, b.y, b.height);
}

/// A cluster's display does not depend on the weather, but it is dimmed at night.
Environment light_at_cluster(const Environment& outside) {
  Environment light;
  light.sun_azimuth_rad = outside.sun_azimuth_rad;
  light.sun_elevation_rad = outside.sun_elevation_rad;
  light.sun_illuminance_lux = outside.sun_illuminance_lux;
  light.cloud_cover = 1.0;
  return light;
}

instant::FrameInput panel_frame(const Snapshot& shown, const ScreenViews& views, const Viewpoint& viewpoint,
                                const scene::ResolvedScene& scene) {
  instant::FrameInput frame;
  frame.simulated_time_s = shown.simulated_time_s;
  frame.environment = light_at_cluster(shown.environment);
  frame.views = views.views;
  for (auto& view : frame.views) view.world_from_car = viewpoint.world_from_views;
  const Participant* car = viewpoint.inside ? find_participant(shown, *viewpoint.inside) : nullptr;
  const auto faces = prototype_of(scene, "cockpit/instruments");
  if (!car || !faces) return frame;
  auto drawn = instant::drawn_participant(*car, *faces);
  drawn.lamps = {};  // Its headlights are not those of the panel.
  frame.participants.push_back(drawn);
  add_instruments(frame, readings_of(shown, *car), *car, scene);
  return frame;
}

}  // namespace

Expected<ScreenViews> screen_views(const rig::Rig& rig, const rig::Screen& screen, const Head& head) {
  if (screen.only_instruments) return panel_views(screen);
  const Vec3 eye_m = rig.eye_point_m + head.from_rest_m;
  const Quat turn = orientation_from_angles(head.turn_rad, 0.0, 0.0);
  const auto turned = [&](const rig::Window& window) -> instant::ScreenCorners {
    const auto corner = [&](const Vec3& corner_m) { return eye_m + turn * (corner_m - eye_m); };
    return {corner(window.lower_left_m), corner(window.lower_right_m), corner(window.upper_left_m)};
  };
  ScreenViews result;
  result.show_interior = screen.show_interior;
  const auto is_in_place = [&](const rig::Mirror& mirror) {
    return std::ranges::find(result.mirrors, mirror.name, [](const SeenMirror& seen) { return seen.mirror.name; }) !=
           result.mirrors.end();
  };
  for (const rig::View& view : screen.views) {
    const instant::ScreenCorners corners{view.window.lower_left_m, view.window.lower_right_m, view.window.upper_left_m};
    const bool is_whole = &view == &screen.views.front();
    if (view.mirror && is_in_place(rig.mirrors[*view.mirror])) continue;
    const auto projection = view.mirror ? instant::mirror_view(corners, eye_m, rig.mirrors[*view.mirror].radius_m)
                                        : instant::off_axis_view(is_whole ? turned(view.window) : corners, eye_m);
    if (!projection) {
      Error error = projection.error();
      error.where = fmt::format("rig {}, screen {}: {}", rig.name, screen.name, error.where);
      return tl::unexpected(error);
    }
    instant::FrameView frame_view;
    frame_view.projection = *projection;
    frame_view.viewport = viewport(view, screen);
    frame_view.mirrored = view.mirrored;
    frame_view.housed = view.mirror.has_value();
    // An inset that would lie on the dials, which move when the head turns, lies above them.
    if (view.mirror && screen.show_interior)
      if (const auto dials = dials_in(result.views.front()); dials && overlap(*dials, frame_view.viewport))
        frame_view.viewport.y = std::max(0, dials->y - static_cast<std::int32_t>(frame_view.viewport.height) - 2);
    result.views.push_back(frame_view);
    if (is_whole && screen.show_interior)
      result.mirrors = seen_mirrors(rig, screen, frame_view.projection, frame_view.viewport);
  }
  return result;
}

namespace {

/// What editors have hung on participants, by their numbers. Mostly nothing.
std::vector<std::pair<ParticipantId, std::uint32_t>> hung_things(const scene::ResolvedScene& scene) {
  std::vector<std::pair<ParticipantId, std::uint32_t>> hung;
  for (std::uint32_t i = 0; i < scene.prototypes.size(); ++i)
    if (const auto number = scene::number_of_participant(scene.prototypes[i].name)) hung.emplace_back(*number, i);
  return hung;
}

/// Its own, or that which an editor gave it.
glm::vec3 paint_of(const Participant& participant, const scene::ResolvedScene& scene,
                   const std::vector<std::pair<ParticipantId, std::uint32_t>>& hung) {
  for (const auto& [number, prototype] : hung)
    if (number == participant.id && scene.prototypes[prototype].paint) return *scene.prototypes[prototype].paint;
  return body_color(participant.paint);
}

/// True for one whose root an editor has hidden.
bool is_hidden(const Participant& participant, const scene::ResolvedScene& scene,
               const std::vector<std::pair<ParticipantId, std::uint32_t>>& hung) {
  return std::ranges::any_of(hung, [&](const auto& entry) {
    return entry.first == participant.id && scene.prototypes[entry.second].is_hidden;
  });
}

/// Added with the vehicle's motion, without its lamps and its spray.
void add_hung_things(instant::FrameInput& frame, const Participant& participant,
                     const std::vector<std::pair<ParticipantId, std::uint32_t>>& hung) {
  for (const auto& [number, prototype] : hung) {
    if (number != participant.id) continue;
    auto drawn = instant::drawn_participant(participant, prototype);
    drawn.lamps = {};
    drawn.raises_spray = false;
    frame.participants.push_back(drawn);
  }
}

/// Where a thing that moves by itself is now, or where pushes have moved its box.
scene::MovingPose pose_now(const scene::Prototype& prototype, const Snapshot& shown) {
  const Participant* box = prototype.box ? find_participant(shown, prototype.box->participant) : nullptr;
  if (!box || !is_free_solid(*box)) return scene::pose_at(prototype.motion, shown.simulated_time_s);
  return {scene::pose_by_box(*prototype.box, box->world_from_vehicle, prototype.motion.rotation, prototype.motion),
          box->velocity_mps, box->angular_velocity_radps};
}

/// Objects that move by themselves or can be pushed.
void add_moving_things(instant::FrameInput& frame, const Snapshot& shown, const scene::ResolvedScene& scene) {
  for (std::uint32_t i = 0; i < scene.prototypes.size(); ++i) {
    const scene::Prototype& prototype = scene.prototypes[i];
    if (prototype.motion.legs.empty() && !prototype.box) continue;
    const scene::MovingPose now = pose_now(prototype, shown);
    if (!scene::is_in_world(now.world_from_object.position_m)) continue;
    instant::DrawnParticipant drawn;
    drawn.prototype = i;
    drawn.number = prototype.number;
    drawn.world_from_vehicle = now.world_from_object;
    drawn.velocity_mps = now.velocity_mps;
    frame.participants.push_back(drawn);
  }
}

}  // namespace

instant::FrameInput client_frame(const Snapshot& shown, const ScreenViews& views, const Viewpoint& viewpoint,
                                 const scene::ResolvedScene& scene) {
  if (views.only_instruments) return panel_frame(shown, views, viewpoint, scene);
  instant::FrameInput frame;
  frame.simulated_time_s = shown.simulated_time_s;
  frame.environment = shown.environment;
  frame.views = views.views;
  for (auto& view : frame.views) view.world_from_car = viewpoint.world_from_views;

  const auto hung = hung_things(scene);
  for (const Participant& participant : shown.participants) {
    if (is_solid(participant.id)) continue;  // The scene draws it.
    // Around the eyes is the cabin, whatever is hidden.
    if (participant.id != viewpoint.inside && is_hidden(participant, scene, hung)) continue;
    add_hung_things(frame, participant, hung);
    const auto prototype = prototype_of(scene, vehicle_models()[participant.model].name);
    if (!prototype) continue;
    auto drawn = instant::drawn_participant(participant, *prototype);
    drawn.paint = paint_of(participant, scene, hung);
    if (participant.id == viewpoint.inside) {
      for (auto& view : frame.views) view.velocity_mps = participant.velocity_mps;
      // A real car is around the driver, or its inside is drawn: of the model only the shadow and the light remain.
      drawn.shown = instant::Shown::shadow_and_light;
      const VehicleModel& model = vehicle_models()[participant.model];
      const auto inside = prototype_of(scene, fmt::format("interior/{}", model.name));
      if (inside && views.show_interior && !scenery::has_cockpit(model)) {
        // It is the whole vehicle but for the panes and the person whose eyes these are, of whom a rider's or walker's
        // head throws its shadow.
        if (const auto head = prototype_of(scene, fmt::format("head/{}", model.name))) {
          auto shadow = drawn;
          shadow.prototype = *head;
          shadow.raises_spray = false;
          frame.participants.push_back(shadow);
        }
        drawn.prototype = *inside;
        drawn.shown = instant::Shown::whole;
        drawn.steering_wheel_rad = steering_ratio * drawn.front_steer_rad;
        add_vehicle_mirrors(frame, participant);
        add_dials(frame, readings_of(shown, participant), participant, scene);
      } else if (inside && views.show_interior) {
        auto interior = drawn;
        interior.prototype = *inside;
        interior.shown = instant::Shown::whole;
        interior.raises_spray = false;  // The car around it raises the spray.
        if (participant.id == shown.driver_car.participant)
          interior.steering_wheel_rad = shown.driver_car.steering_wheel_rad;
        frame.participants.push_back(interior);
        add_hands(frame, interior.steering_wheel_rad, participant, scene);
        add_instruments(frame, readings_of(shown, participant), participant, scene);
        add_windscreen(frame, shown, participant, scene);
        add_mirrors(frame, views.mirrors, scene);
        // The cabin's shell casts the shadow of the parts above the belt line.
        if (const auto shell = prototype_of(scene, fmt::format("shell/{}", model.name))) drawn.prototype = *shell;
      }
    }
    frame.participants.push_back(drawn);
  }
  add_moving_things(frame, shown, scene);
  for (const TrafficLight& light : traffic_lights_of(shown)) {
    const auto prototype = prototype_of(scene, light.for_walkers ? "pedestrian light" : "traffic light");
    if (!prototype) continue;
    instant::DrawnParticipant drawn;
    drawn.prototype = *prototype;
    drawn.world_from_vehicle = light.world_from_light;
    drawn.lamps = light.lamps;
    frame.participants.push_back(drawn);
  }
  return frame;
}

instant::OverlayText banner(std::string text, const rig::Screen& screen) {
  instant::OverlayText line;
  line.text = std::move(text);
  line.height_px = std::max(12.0f, static_cast<float>(screen.height_px) / 22.0f);
  line.x_px = 0.5f * static_cast<float>(screen.width_px);
  line.y_px = 0.5f * static_cast<float>(screen.height_px);
  line.background = {0.05f, 0.05f, 0.06f, 0.75f};
  line.centered = true;
  return line;
}

}  // namespace septet::frame
