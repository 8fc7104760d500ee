/// The mirrors of the cockpit as pixels: objects behind the car are in their glass at the place of light's shortest
/// path.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/world/instrument_panel.hpp"
#include "sim-client/frame/prototype_of.hpp"
#include "tests/engine/instant/reflection_point.hpp"
#include "tests/engine/rig/upper_right.hpp"
#include "tests/relative.hpp"
#include "tests/sim-client/frame/cockpit_view.hpp"

namespace septet::frame {
namespace {

const std::string names[] = {"left mirror", "inside mirror", "right mirror"};

rig::Rig small_monitors() {
  rig::Rig rig = rig_called("three-monitors");
  for (rig::Screen& screen : rig.screens) screen.width_px = 640, screen.height_px = 360;
  return rig;
}

const rig::Mirror& mirror_called(const rig::Rig& rig, const std::string& name) {
  return *std::ranges::find(rig.mirrors, name, &rig::Mirror::name);
}

instant::ScreenCorners corners_of(const rig::Mirror& mirror) {
  return {mirror.glass.lower_left_m, mirror.glass.lower_right_m, mirror.glass.upper_left_m};
}

Snapshot by_night() {
  Snapshot shown = in_the_seat();
  shown.environment.sun_elevation_rad = -0.4;
  shown.environment.sun_illuminance_lux = 0.0;
  return shown;
}

/// A cube that shines, in the car's frame.
instant::DynamicMesh beacon(const RigidTransform& world_from_car, const Vec3& place_m, double half_m) {
  instant::DynamicMesh mesh;
  mesh.prototype = *prototype_of(vehicles_scene(), "cockpit/signs");
  mesh.origin_m = world_from_car * place_m;
  mesh.radius_m = static_cast<float>(2.0 * half_m);
  // Colour of the needles.
  const glm::vec2 uv = instrument_panel::uv_of_middle(instrument_panel::Sign::needle);
  for (const int axis : {0, 1, 2})
    for (const double side : {1.0, -1.0}) {
      Vec3 normal(0.0), a(0.0), b(0.0);
      normal[axis] = side;
      a[(axis + 1) % 3] = side;
      b[(axis + 2) % 3] = 1.0;
      const std::array<Vec3, 4> face{normal - a - b, normal + a - b, normal + a + b, normal - a + b};
      for (const std::size_t i : {0, 1, 2, 0, 2, 3})
        mesh.vertices.push_back({glm::vec3(half_m * face[i]), glm::vec3(normal), uv});
    }
  return mesh;
}

struct Seen {
  glm::dvec2 pixel{0.0};  ///< Middle of the changed pixels.
  double changed = 0.0;   ///< Sum of the changes.
  float most = 0.0f;      ///< Radiance.
};

/// Draws a screen without and with a body, and finds it by the difference.
class Stage {
 public:
  Stage(const rig::Rig& rig, const rig::Screen& screen, const Snapshot& shown, const Head& head = {},
        render::Antialiasing antialiasing = render::Antialiasing::automatic)
      : renderer_(*render::Renderer::create({.width = screen.width_px,
                                             .height = screen.height_px,
                                             .device = render::DevicePreference::software,
                                             .validation = true,
                                             .antialiasing = antialiasing})),
        views_(*screen_views(rig, screen, head)),
        input_(client_frame(shown, views_, driver_viewpoint(shown), vehicles_scene())) {
    REQUIRE(renderer_.upload(vehicles_scene()).has_value());
    without_ = draw(input_);
  }
  const ScreenViews& views() const { return views_; }
  const instant::FrameInput& input() const { return input_; }
  render::RadianceImage draw(const instant::FrameInput& input) {
    REQUIRE(renderer_.draw(input).has_value());
    auto radiance = renderer_.read_radiance();
    REQUIRE(radiance.has_value());
    CHECK(renderer_.statistics().validation_messages == 0);
    return *radiance;
  }
  Seen with(const Vec3& place_m, double half_m, const rig::Mirror* within = nullptr) {
    instant::FrameInput input = input_;
    input.meshes.push_back(beacon(input.views[0].world_from_car, place_m, half_m));
    return found(draw(input), within);
  }
  /// `within`: restricted to one of several mirrors that see it.
  Seen found(const render::RadianceImage& with, const rig::Mirror* within = nullptr) const {
    Seen seen;
    glm::dvec2 low(0.0), high(with.width, with.height);
    if (within) {
      const rig::Window& glass = within->glass;
      const glm::dvec2 corners[] = {pixel(glass.lower_left_m), pixel(glass.lower_right_m), pixel(glass.upper_left_m),
                                    pixel(upper_right_m(glass))};
      low = high = corners[0];
      for (const glm::dvec2& corner : corners) low = glm::min(low, corner), high = glm::max(high, corner);
    }
    for (std::uint32_t y = 0; y < with.height; ++y)
      for (std::uint32_t x = 0; x < with.width; ++x) {
        if (x < low.x || y < low.y || x > high.x || y > high.y) continue;
        const std::size_t i = std::size_t{y} * with.width + x;
        const float more = std::min(with.radiance[i].r - without_.radiance[i].r, 1.0f);
        if (more < 0.02f) continue;
        seen.pixel += double(more) * glm::dvec2(x + 0.5, y + 0.5);
        seen.changed += double(more);
        seen.most = std::max(seen.most, with.radiance[i].r);
      }
    if (seen.changed > 0.0) seen.pixel /= seen.changed;
    return seen;
  }
  glm::dvec2 pixel(const Vec3& car_m) const {
    const instant::OffAxisView& projection = views_.views.front().projection;
    const glm::dvec4 clip = projection.clip_from_eye_relative * glm::dvec4(car_m - projection.eye_m, 1.0);
    return {(0.5 + 0.5 * clip.x / clip.w) * without_.width, (0.5 + 0.5 * clip.y / clip.w) * without_.height};
  }

 private:
  render::Renderer renderer_;
  ScreenViews views_;
  instant::FrameInput input_;
  render::RadianceImage without_;
};

}  // namespace

TEST_CASE(
    "what shines behind the car is in each mirror at the pixel of the shortest way, also when the eyes have moved") {
  const rig::Rig rig = small_monitors();
  const Snapshot shown = by_night();
  struct Case {
    std::size_t screen;
    std::string mirror;
    Vec3 place_m;
  };
  for (const Case& each : {Case{0, names[0], {-10.0, 3.2, 1.4}}, Case{0, names[0], {-28.0, 6.5, 1.0}},
                           Case{2, names[1], {-18.0, -0.8, 0.9}}, Case{2, names[2], {-10.0, -3.4, 1.4}}}) {
    CAPTURE(each.mirror);
    glm::dvec2 before(0.0);
    for (const Vec3& moved_m : {Vec3(0.0), Vec3(0.0, 0.03, 0.0), Vec3(0.06, -0.04, 0.03)}) {
      CAPTURE(moved_m.y);
      Stage stage(rig, rig.screens[each.screen], shown, {moved_m, 0.0});
      const rig::Mirror& mirror = mirror_called(rig, each.mirror);
      const Seen seen = stage.with(each.place_m, 0.02 * std::abs(each.place_m.x), &mirror);
      REQUIRE(seen.changed > 4.0);
      const Vec3 there_m =
          instant::reflection_point(corners_of(mirror), mirror.radius_m, rig.eye_point_m + moved_m, each.place_m);
      const glm::dvec2 expected = stage.pixel(there_m);
      CAPTURE(seen.pixel.x);
      CAPTURE(seen.pixel.y);
      CAPTURE(expected.x);
      CAPTURE(expected.y);
      CHECK(glm::distance(seen.pixel, expected) < 1.5);
      if (moved_m == Vec3(0.0))
        before = seen.pixel;
      else
        CHECK(glm::distance(seen.pixel, before) > 2.0);
    }
  }
}

TEST_CASE("a mirror shows things as bright as they are but for what silver takes, and left to the left") {
  const rig::Rig rig = small_monitors();
  const Snapshot shown = by_night();
  for (const render::Antialiasing antialiasing :
       {render::Antialiasing::smoothing, render::Antialiasing::multisampled, render::Antialiasing::temporal}) {
    Stage left(rig, rig.screens[0], shown, {}, antialiasing), ahead(rig, rig.screens[1], shown, {}, antialiasing);
    const Seen direct = ahead.with({12.0, 0.8, 1.6}, 0.5), mirrored = left.with({-12.0, 3.4, 1.4}, 0.6);
    CHECK(double(mirrored.most) == relative(0.9 * double(direct.most), 0.03));
    CHECK(left.with({-12.0, 4.4, 1.4}, 0.4).pixel.x < left.with({-12.0, 3.4, 1.4}, 0.4).pixel.x - 3.0);
  }
}

TEST_CASE("only the screens that see a mirror draw it, and what is not seen costs nothing") {
  const rig::Rig rig = small_monitors();
  const Snapshot shown = in_the_seat();
  const auto on = [&](const std::string& name, std::size_t screen) {
    const auto views = screen_views(rig, rig.screens[screen]);
    REQUIRE(views.has_value());
    return std::ranges::any_of(views->mirrors, [&](const SeenMirror& seen) { return seen.mirror.name == name; });
  };
  CHECK(on(names[0], 0));
  CHECK_FALSE(on(names[0], 1));
  CHECK_FALSE(on(names[0], 2));
  CHECK(on(names[1], 2));
  CHECK_FALSE(on(names[1], 0));
  CHECK(on(names[2], 2));
  CHECK_FALSE(on(names[2], 1));
  // Around a real car there are its own.
  const rig::Rig seven = rig_called("seven-screens");
  for (const rig::Screen& screen : seven.screens) {
    const auto views = screen_views(seven, screen);
    REQUIRE(views.has_value());
    CHECK(views->mirrors.empty());
    CHECK(client_frame(shown, *views, driver_viewpoint(shown), vehicles_scene()).mirrors.empty());
  }
}

TEST_CASE("the headlamps of whoever follows by night shine in the mirrors") {
  const rig::Rig rig = small_monitors();
  Snapshot shown = by_night();
  Participant follower = shown.participants[0];
  follower.id = 2;
  follower.world_from_vehicle.position_m = shown.participants[0].world_from_vehicle * Vec3(-25.0, 0.0, 0.0);
  shown.participants.push_back(follower);
  Stage dark(rig, rig.screens[2], shown);
  shown.participants[1].lamps.set(Lamp::low_beam, true);
  const rig::Mirror& mirror = mirror_called(rig, names[1]);
  const Seen lit =
      dark.found(dark.draw(client_frame(shown, dark.views(), driver_viewpoint(shown), vehicles_scene())), &mirror);
  CHECK(lit.changed > 3.0);
  const glm::dvec2 expected =
      dark.pixel(instant::reflection_point(corners_of(mirror), 0.0, rig.eye_point_m, Vec3(-25.0 + 3.7, 0.0, 0.65)));
  CHECK(glm::distance(lit.pixel, expected) < 12.0);
}

TEST_CASE("mirrors in rain with followers behind are drawn without a complaint of the validation layer") {
  const rig::Rig rig = rig_called("three-monitors");
  for (const std::string weather : {"day", "night", "rain"}) {
    if (!std::getenv("SEPTET_PICTURES") && weather != "rain") continue;
    Snapshot shown = weather == "night" ? by_night() : in_the_seat(80.0, 2400.0);
    if (weather == "rain") {
      shown.environment.rain_mm_per_h = 6.0;
      shown.environment.cloud_cover = 1.0;
    }
    for (int i = 0; i < 3; ++i) {
      Participant follower = shown.participants[0];
      follower.id = std::uint32_t(2 + i);
      follower.paint = std::uint8_t(3 + i);
      follower.lamps.set(Lamp::low_beam, weather != "day");
      follower.world_from_vehicle.position_m = shown.participants[0].world_from_vehicle * Vec3(-10.0 - 8.0 * i,
                                                                                               i == 0   ? 3.5
                                                                                               : i == 1 ? 0.0
                                                                                                        : -3.5,
                                                                                               0.0);
      shown.participants.push_back(follower);
    }
    for (std::size_t i = 0; i < 3; i += std::getenv("SEPTET_PICTURES") ? 1 : 2) {
      rig::Screen screen = rig.screens[i];
      screen.width_px = 960, screen.height_px = 540;
      seat_picture(shown, rig, screen, "mirrors-" + weather + "-" + screen.name);
    }
  }
}

}  // namespace septet::frame
