/// Pictures of frost and cracks on panes of glass. Software device, validation layer on.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/ice/glass.hpp"
#include "engine/render/renderer.hpp"
#include "tests/engine/instant/ray_through.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/relative.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t glass_width_px = 320, glass_height_px = 240;

struct PanePictures {
  instant::ReferenceScene reference = instant::reference_scene({.trees = 0});
  Renderer renderer;

  explicit PanePictures(Antialiasing antialiasing = Antialiasing::none)
      : renderer(*Renderer::create(
            {glass_width_px, glass_height_px, DevicePreference::software, true, antialiasing, nullptr})) {
    REQUIRE(renderer.upload(reference.scene).has_value());
  }
  FrameInput before_the_glass() const {
    FrameInput input;
    input.environment = instant::reference_day();
    input.views = {instant::forward_view(Vec3(0.0), glass_width_px, glass_height_px)};
    return input;
  }
  RadianceImage drawn(const FrameInput& input) {
    REQUIRE(renderer.draw(input).has_value());
    CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
    return *renderer.read_radiance();
  }
};

/// Upright pane, half a metre before the eye, over the whole picture.
ice::PaneShape upright_pane() {
  return ice::pane_between({0.0, -0.7, -0.5}, {0.0, 0.7, -0.5}, {0.0, -0.7, 0.5}, {0.0, 0.7, 0.5}, 0.0);
}

ice::IceBody on_pane(const std::vector<ice::IceVertex>& surface, ice::OnGlass what, const FrameView& view) {
  ice::IceBody body;
  body.look.on_glass = what;
  body.origin_m = world_eye(view) + Vec3(0.5, 0.0, 0.0);
  body.vertices = surface;
  return body;
}

double mean_of(const glm::vec3& radiance) { return (radiance.r + radiance.g + radiance.b) / 3.0; }

/// Frost of one thickness everywhere.
std::vector<ice::IceVertex> even_frost(float kgpm2) {
  ice::Frost frost = ice::morning_frost(268.15, 1);
  std::vector<ice::IceVertex> surface = ice::frost_surface(upright_pane(), frost);
  for (ice::IceVertex& vertex : surface) vertex.rest_m.z = kgpm2;
  return surface;
}

}  // namespace

TEST_CASE(
    "frost and cracks are drawn without a word of the validation layer beside ice and in a mirror, near and far") {
  for (const Antialiasing antialiasing : {Antialiasing::none, Antialiasing::smoothing, Antialiasing::multisampled}) {
    PanePictures pictures(antialiasing);
    FrameInput input = pictures.before_the_glass();
    input.glass = {on_pane(even_frost(0.1f), ice::OnGlass::frost, input.views[0]),
                   on_pane(ice::star_surface(upright_pane(), {}), ice::OnGlass::cracks, input.views[0])};
    input.glass.push_back(input.glass[1]);
    input.glass[2].origin_m.x += 8.0;
    input.views.push_back(input.views[0]);
    input.views[1].viewport = {200, 4, 100, 60};
    input.views[1].mirrored = true;
    pictures.drawn(input);
    input.ice = {input.glass[0]};
    input.ice[0].look.on_glass = ice::OnGlass::nothing;
    pictures.drawn(input);
    input.glass.clear();
    pictures.drawn(input);
  }
}

TEST_CASE("what lies behind frost loses its contrast by Beer's law with the frost's mass") {
  PanePictures pictures;
  FrameInput input = pictures.before_the_glass();
  FrameInput with_car = input;
  with_car.participants = {instant::reference_car(pictures.reference, {9.0, 0.0, 0.0})};
  const RadianceImage road = pictures.drawn(input), car = pictures.drawn(with_car);
  double before = 1.0;
  for (const float kgpm2 : {0.0f, 0.02f, 0.05f, 0.1f, 0.2f}) {
    CAPTURE(kgpm2);
    for (FrameInput* frame : {&input, &with_car})
      frame->glass = {on_pane(even_frost(kgpm2), ice::OnGlass::frost, frame->views[0])};
    const RadianceImage frosted_road = pictures.drawn(input), frosted_car = pictures.drawn(with_car);
    double clear = 0.0, frosted = 0.0;
    for (std::size_t i = 0; i < road.radiance.size(); ++i) {
      clear += std::abs(mean_of(road.radiance[i]) - mean_of(car.radiance[i]));
      frosted += std::abs(mean_of(frosted_road.radiance[i]) - mean_of(frosted_car.radiance[i]));
    }
    REQUIRE(clear > 10.0);
    const double contrast = frosted / clear, even = std::exp(-16.0 * static_cast<double>(kgpm2));
    // Feathers transmit somewhat more than an even layer of their mass would.
    CHECK(contrast >= even - 0.02);
    CHECK(contrast <= even + 0.15);
    if (kgpm2 > 0.0f)
      CHECK(contrast < before - 0.02);
    else
      CHECK(contrast == relative(1.0, 1e-3));
    before = contrast;
  }
}

TEST_CASE("more of a frosted pane is seen through with every minute of the blower, from its foot upwards") {
  PanePictures pictures;
  FrameInput input = pictures.before_the_glass();
  const RadianceImage clear = pictures.drawn(input);
  ice::Frost frost = ice::morning_frost(268.15, 3);
  std::array<double, 2> before{};
  bool foot_first = false;
  for (int minute = 0; minute <= 8; ++minute) {
    input.glass = {on_pane(ice::frost_surface(upright_pane(), frost), ice::OnGlass::frost, input.views[0])};
    if (input.glass[0].vertices.empty()) input.glass.clear();
    const RadianceImage seen = pictures.drawn(input);
    std::array<double, 2> shares{};  // Shares of the upper and of the lower half.
    for (std::uint32_t y = 0; y < glass_height_px; ++y)
      for (std::uint32_t x = 0; x < glass_width_px; ++x)
        if (glm::length(seen.at(x, y) - clear.at(x, y)) < 0.01f * (glm::length(clear.at(x, y)) + 0.01f))
          shares[2 * y / glass_height_px] += 2.0 / (glass_width_px * glass_height_px);
    CAPTURE(minute);
    CHECK(shares[0] >= before[0]);
    CHECK(shares[1] >= before[1]);
    foot_first = foot_first || shares[1] > shares[0] + 0.1;
    before = shares;
    for (int i = 0; i < 240; ++i) ice::warm(frost, 268.15, 8.0, 0.25);
  }
  CHECK(foot_first);
  CHECK(before[0] == relative(1.0, 1e-3));
}

TEST_CASE(
    "a star's cracks shine and hide within the blow's reach and change no pixel beyond it, seen from either side") {
  PanePictures pictures;
  FrameInput input = pictures.before_the_glass();
  const RadianceImage clear = pictures.drawn(input);
  const ice::Star star{0.55, 0.45, 0.12, 5};
  const ice::IceBody cracks = on_pane(ice::star_surface(upright_pane(), star), ice::OnGlass::cracks, input.views[0]);
  ice::IceBody turned = cracks;  // Half a turn about the upright: the other side faces the eye.
  for (ice::IceVertex& vertex : turned.vertices)
    for (glm::vec3* turns : {&vertex.position_m, &vertex.normal}) turns->x = -turns->x, turns->y = -turns->y;
  for (const bool other_side : {false, true}) {
    input.glass = {other_side ? turned : cracks};
    const RadianceImage seen = pictures.drawn(input);
    const Vec3 middle = ice::place_on(upright_pane(), star.across, star.up) * Vec3(1.0, other_side ? -1.0 : 1.0, 1.0);
    int brighter = 0, darker = 0, beyond = 0;
    for (std::uint32_t y = 0; y < glass_height_px; ++y)
      for (std::uint32_t x = 0; x < glass_width_px; ++x) {
        const double change = mean_of(seen.at(x, y)) - mean_of(clear.at(x, y));
        if (std::abs(change) < 0.02 * mean_of(clear.at(x, y))) continue;
        const Vec3 ray = ray_through(input.views[0], x + 0.5, y + 0.5), met = ray * (0.5 / ray.x);
        const double off_m = glm::length(met - Vec3(0.5, middle.y, middle.z));
        beyond += off_m > star.reach_m + 0.006 ? 1 : 0;
        (change > 0.0 ? brighter : darker) += 1;
      }
    CHECK(beyond == 0);
    CHECK(brighter > 150);
    CHECK(darker > 50);
    CHECK(brighter + darker < 6000);
  }
}

}  // namespace septet::render
