/// Pictures of ice. Software device, validation layer on.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/ice/objects.hpp"
#include "engine/render/renderer.hpp"
#include "tests/engine/instant/ray_through.hpp"
#include "tests/relative.hpp"

namespace septet::render {
namespace {

Renderer ice_renderer(std::uint32_t width, std::uint32_t height, Antialiasing antialiasing = Antialiasing::none) {
  return *Renderer::create({width, height, DevicePreference::software, true, antialiasing, nullptr});
}

ice::IceBody body_of(const ice::Surface& surface, const Vec3& origin_m) {
  ice::IceBody body;
  body.origin_m = origin_m;
  body.vertices = surface;
  return body;
}

/// View from the world's origin along x.
FrameInput seen_ahead(std::uint32_t width, std::uint32_t height) {
  FrameInput input;
  input.environment.sun_elevation_rad = 0.8;
  FrameView view;
  view.projection = symmetric_view(Vec3(0.0), 0.0, 0.0, 0.9, 2.0 * std::atan(std::tan(0.45) * height / width));
  view.viewport = {0, 0, width, height};
  input.views = {view};
  input.ice_surroundings_px = 32;
  return input;
}

void check_valid(Renderer& renderer, const FrameInput& input) {
  REQUIRE(renderer.draw(input).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
}

/// Distances along a ray at which it meets triangles.
std::vector<double> hits(const std::vector<ice::IceVertex>& triangles, const Vec3& from, const Vec3& ray) {
  std::vector<double> found;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const Vec3 a(triangles[i].position_m), ab = Vec3(triangles[i + 1].position_m) - a,
                                           ac = Vec3(triangles[i + 2].position_m) - a;
    const Vec3 p = glm::cross(ray, ac);
    const double det = glm::dot(ab, p);
    if (std::abs(det) < 1e-14) continue;
    const Vec3 off = from - a, q = glm::cross(off, ab);
    const double u = glm::dot(off, p) / det, v = glm::dot(ray, q) / det;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0) found.push_back(glm::dot(ac, q) / det);
  }
  return found;
}

}  // namespace

TEST_CASE("ice is drawn without a word of the validation layer in both modes with one sample and with four") {
  for (const Antialiasing antialiasing : {Antialiasing::none, Antialiasing::smoothing, Antialiasing::multisampled}) {
    Renderer renderer = ice_renderer(160, 120, antialiasing);
    FrameInput input = seen_ahead(160, 120);
    ice::IceBody body = body_of(ice::sphere(), {2.5, 0.6, 0.0});
    for (const ice::Crack& crack : generic_cracks(bounds(body.vertices), 2, 1)) append_crack(body.inside, crack);
    append_air(body.inside, bounds(body.vertices), 5, 1);
    input.ice = {body, body};
    input.ice[1].origin_m.y = -0.6;
    input.ice[1].look.mode = ice::Mode::quality;
    input.ice[1].look.roughness = 0.5f;
    check_valid(renderer, input);
    input.ice[1].look.seen_beyond = true;
    // A mirror in the picture's corner sees them, too.
    input.views.push_back(input.views[0]);
    input.views[1].viewport = {100, 4, 50, 30};
    input.views[1].mirrored = true;
    check_valid(renderer, input);
    input.ice.clear();
    check_valid(renderer, input);
    input.ice = {body};
    REQUIRE(renderer.resize(96, 64).has_value());
    input.views = seen_ahead(96, 64).views;
    check_valid(renderer, input);
  }
}

TEST_CASE("cracks are drawn where a ray meets them inside the ice and nowhere else, at 99 of 100 pixels") {
  constexpr std::uint32_t width = 480, height = 360;
  Renderer renderer = ice_renderer(width, height);
  for (const char* name : {"sphere", "cube"}) {
    CAPTURE(name);
    FrameInput input = seen_ahead(width, height);
    ice::IceBody body = body_of(*ice::object(name), {1.9, 0.0, 0.0});
    body.look.bump = 0.0f;
    body.look.reflects = false;
    for (const ice::Crack& crack : generic_cracks(bounds(body.vertices), 2, 3))
      append_crack(body.inside, crack, ice::InsideKind::mark);
    input.ice = {body};
    check_valid(renderer, input);
    const RadianceImage light = *renderer.read_radiance();
    int met = 0, agreed = 0, drawn = 0;
    for (std::uint32_t y = 0; y < height; y += 2)
      for (std::uint32_t x = 0; x < width; x += 2) {
        const Vec3 ray = ray_through(input.views[0], x + 0.5, y + 0.5), from = -body.origin_m;
        const std::vector<double> cracks = hits(body.inside, from, ray);
        if (cracks.empty()) continue;
        const std::vector<double> faces = hits(body.vertices, from, ray);
        const bool inside = std::ranges::any_of(cracks, [&](double at) {
          return std::ranges::count_if(faces, [&](double face) { return face > at; }) % 2 == 1;
        });
        const glm::vec3 seen = light.at(x, y);
        const bool red = seen.r > 0.5f && seen.g < 0.5f * seen.r;
        ++met;
        drawn += red;
        agreed += red == inside;
      }
    CAPTURE(met);
    CAPTURE(drawn);
    CHECK(met > 2000);
    CHECK(drawn > 1000);
    CHECK(drawn < met);
    MESSAGE(name << ": " << agreed << " of " << met << " pixels agree");
    CHECK(agreed >= 0.99 * met);
  }
}

TEST_CASE("in quality mode cracks bend what is seen, absorption takes red before blue, and ice is seen through ice") {
  constexpr std::uint32_t width = 240, height = 180;
  Renderer renderer = ice_renderer(width, height);
  FrameInput input = seen_ahead(width, height);
  ice::IceBody body = body_of(ice::sphere(), {1.9, 0.0, 0.0});
  body.look.mode = ice::Mode::quality;
  body.look.bump = 0.0f;
  body.look.reflects = false;
  body.look.absorption_per_m = glm::vec3(0.0f);
  const auto light_of = [&](const std::vector<ice::IceBody>& bodies) {
    input.ice = bodies;
    check_valid(renderer, input);
    return *renderer.read_radiance();
  };
  const auto differing = [&](const RadianceImage& a, const RadianceImage& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.radiance.size(); ++i)
      count += glm::length(a.radiance[i] - b.radiance[i]) > 0.02f * glm::length(a.radiance[i]) + 1e-4f;
    return count;
  };
  const RadianceImage clear = light_of({body});
  const glm::vec3 through = clear.at(width / 2, height / 2);

  ice::IceBody blue = body;
  blue.look.absorption_per_m = {2.0f, 1.0f, 0.0f};
  const glm::vec3 taken = light_of({blue}).at(width / 2, height / 2) / through;
  // A metre through the middle.
  CHECK(taken.r == relative(std::exp(-2.0), 0.03));
  CHECK(taken.g == relative(std::exp(-1.0), 0.03));
  CHECK(taken.b == relative(1.0, 0.01));

  ice::IceBody cracked = body;
  for (const ice::Crack& crack : generic_cracks(bounds(body.vertices), 2, 3)) append_crack(cracked.inside, crack);
  ice::IceBody straight = cracked;
  straight.look.bent_by_cracks = false;
  const int bent = differing(light_of({cracked}), light_of({straight}));
  CAPTURE(bent);
  CHECK(bent > 1000);

  ice::IceBody behind = blue;
  behind.origin_m = {3.2, 0.0, 0.0};
  blue.look.seen_beyond = true;
  const RadianceImage both = light_of({behind, blue}), either = light_of({blue, behind});
  // Two metres of ice, in any order.
  const glm::vec3 share = both.at(width / 2, height / 2) / through;
  CHECK(share.r == relative(std::exp(-4.0), 0.15));
  CHECK(share.g == relative(std::exp(-2.0), 0.15));
  CHECK(share.b == relative(1.0, 0.1));
  CHECK(differing(both, either) == 0);
}

TEST_CASE("the sun's highlight is brighter and smaller on wet ice than on dry, and water takes frost away") {
  constexpr std::uint32_t width = 200, height = 150;
  Renderer renderer = ice_renderer(width, height);
  FrameInput input = seen_ahead(width, height);
  input.environment.sun_azimuth_rad = 3.1;
  const auto light_of = [&](float wetness, float frost) {
    ice::IceBody body = body_of(ice::sphere(), {1.9, 0.0, 0.0});
    body.look.bump = 0.0f;
    body.look.wetness = wetness;
    body.look.roughness = frost;
    input.ice = {body};
    check_valid(renderer, input);
    return *renderer.read_radiance();
  };
  const auto brightest = [](const RadianceImage& light) {
    float most = 0.0f;
    for (const glm::vec3& r : light.radiance) most = std::max(most, r.g);
    return most;
  };
  const auto mean_difference = [](const RadianceImage& a, const RadianceImage& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.radiance.size(); ++i) sum += std::abs(a.radiance[i].g - b.radiance[i].g);
    return sum / static_cast<double>(a.radiance.size());
  };
  const RadianceImage dry = light_of(0.0f, 0.0f), wet = light_of(1.0f, 0.0f), frosted = light_of(0.0f, 0.8f),
                      thawed = light_of(1.0f, 0.8f);
  CHECK(brightest(wet) > 1.5f * brightest(dry));
  CHECK(brightest(frosted) < brightest(dry));
  CHECK(mean_difference(frosted, dry) > 0.01);
  CHECK(mean_difference(thawed, wet) < 1e-6);
}

TEST_CASE("two screens of one eye show the same ice on both sides of their edge") {
  constexpr std::uint32_t width = 320, height = 200;
  Renderer renderer = ice_renderer(width, height);
  for (const ice::Mode mode : {ice::Mode::paper, ice::Mode::quality}) {
    FrameInput input = seen_ahead(width, height);
    ice::IceBody body = body_of(ice::cube(), {2.2, 0.05, 0.1});
    body.look.mode = mode;
    for (const ice::Crack& crack : generic_cracks(bounds(body.vertices), 2, 3)) append_crack(body.inside, crack);
    input.ice = {body};
    if (mode == ice::Mode::quality) {
      input.ice[0].look.seen_beyond = true;
      input.ice.push_back(body_of(ice::sphere(), {4.0, 0.1, 0.0}));
    }
    check_valid(renderer, input);
    const image::Image left = *renderer.read_back();
    // The neighbouring screen has the same direction; its picture begins half a picture further to the right.
    OffAxisView& projection = input.views[0].projection;
    const double half_width_m = std::tan(0.45), half_height_m = half_width_m * height / width;
    projection = *off_axis_view(
        {{1.0, 0.0, -half_height_m}, {1.0, -2.0 * half_width_m, -half_height_m}, {1.0, 0.0, half_height_m}}, Vec3(0.0));
    check_valid(renderer, input);
    const image::Image right = *renderer.read_back();
    int most = 0, beyond = 0;
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = width / 2; x < width; ++x)
        for (std::size_t c = 0; c < 3; ++c) {
          const int apart = std::abs(left.rgba[4 * (std::size_t{y} * width + x) + c] -
                                     right.rgba[4 * (std::size_t{y} * width + x - width / 2) + c]);
          most = std::max(most, apart);
          beyond += apart > 1;
        }
    CAPTURE(most);
    // Rounding puts a pixel of a face's edge on the other face here and there.
    CHECK(beyond <= 3 * 12);
  }
}

TEST_CASE("open, inverted, flat, endless and crowded bodies of ice are drawn harmlessly or left out") {
  constexpr std::uint32_t width = 120, height = 90;
  Renderer renderer = ice_renderer(width, height);
  FrameInput input = seen_ahead(width, height);
  const ice::Surface whole = ice::sphere();
  ice::IceBody open = body_of(whole, {2, 0, 0}), inverted = open, flat = open, broken = open, around = open, far = open;
  open.vertices.resize(open.vertices.size() / 2 / 3 * 3);
  for (std::size_t i = 0; i < inverted.vertices.size(); i += 3)
    std::swap(inverted.vertices[i], inverted.vertices[i + 1]);
  for (ice::IceVertex& vertex : flat.vertices) vertex.position_m = glm::vec3(0.1f);
  broken.vertices[7].position_m.x = std::numeric_limits<float>::quiet_NaN();
  broken.vertices[9].normal = glm::vec3(0.0f);
  around.origin_m = Vec3(0.1, 0.0, 0.0);
  far.origin_m = Vec3(1e9, 0.0, 0.0);
  ice::IceBody crowded = body_of(whole, {2, 0, 0});
  for (const ice::Crack& crack : generic_cracks(bounds(whole), 20000, 1))
    append_crack(crowded.inside, crack, ice::InsideKind::crack, 1);
  for (const ice::Mode mode : {ice::Mode::paper, ice::Mode::quality})
    for (const ice::IceBody* body : {&open, &inverted, &flat, &broken, &around, &far, &crowded}) {
      input.ice = {*body};
      input.ice[0].look.mode = mode;
      input.ice[0].look.seen_beyond = true;
      check_valid(renderer, input);
    }
  // Seventy bodies at once share the layers.
  input.ice.assign(70, body_of(whole, {2, 0, 0}));
  for (ice::IceBody& body : input.ice) body.look.mode = ice::Mode::quality, body.look.seen_beyond = true;
  check_valid(renderer, input);
  const RadianceImage light = *renderer.read_radiance();
  CHECK(std::ranges::all_of(light.radiance, [](const glm::vec3& r) {
    return std::isfinite(r.r) && std::isfinite(r.g) && std::isfinite(r.b) && r.r >= 0.0f;
  }));
}

}  // namespace septet::render
