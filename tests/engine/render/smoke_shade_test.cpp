#include "engine/render/passes/smoke_shade.hpp"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/core/random.hpp"
#include "engine/light/puff.hpp"
#include "tests/relative.hpp"

namespace septet::render {
namespace {

const Vec3 eye_m(4000.0, -700.0, 12.0);

ShadowCascades low_sun() { return shadow_cascades(eye_m, glm::normalize(glm::vec3(0.5f, -0.3f, 0.6f))); }

SmokePuff puff_at(const Vec3& from_eye_m, float deviation_m, float depth) {
  SmokePuff puff;
  puff.position_m = eye_m + from_eye_m;
  puff.radius_m = deviation_m;
  puff.extinction_area_m2 = depth * 2.0f * light::pi * deviation_m * deviation_m;
  return puff;
}

/// Share of the light at a place, from the texel that it lies in.
float share_at(const SmokeShade& shade, const Vec3& from_eye_m) {
  ViewUniforms uniforms{};
  set_smoke_shade(uniforms, shade, eye_m);
  const glm::vec4 place(glm::vec3(from_eye_m), 1.0f);
  const auto x = static_cast<std::size_t>(std::lround(glm::dot(uniforms.smoke_shade_x, place))),
             y = static_cast<std::size_t>(std::lround(glm::dot(uniforms.smoke_shade_y, place)));
  REQUIRE(std::max(x, y) < std::size_t{light::smoke_shade_side});
  return light::below_smoke(glm::vec3(shade.moments[y * light::smoke_shade_side + x]),
                            glm::dot(uniforms.smoke_shade_height, place));
}

}  // namespace

TEST_CASE("the map of the shade holds the whole extinction area of smoke, large and small, near and wide apart") {
  for (const double apart_m : {2.0, 20.0, 150.0}) {
    Random random(2);
    std::vector<SmokePuff> puffs;
    double area_m2 = 0.0;
    for (int n = 0; n < 200; ++n) {
      const auto within = [&] { return random.uniform(-apart_m, apart_m); };
      puffs.push_back(puff_at({within(), within(), within()}, n % 2 == 0 ? 0.2f : 3.0f, 1.0f));
      area_m2 += double(puffs.back().extinction_area_m2);
    }
    const SmokeShade shade = smoke_shade(puffs, {}, low_sun());
    double held_m2 = 0.0;
    for (const glm::vec4& moments : shade.moments) held_m2 += double(moments.x * shade.texel_m * shade.texel_m);
    CAPTURE(apart_m);
    CHECK(held_m2 == relative(area_m2, 1e-4));
  }
}

TEST_CASE("a place in line with a puff and the sun is shaded below it, by half in its middle and not above") {
  const Vec3 to_light(low_sun().cascades[0].to_light);
  const Vec3 middle_m(30.0, 10.0, 20.0);
  const std::vector puffs{puff_at(middle_m, 2.0f, 1.2f)};
  const SmokeShade shade = smoke_shade(puffs, {}, low_sun());
  CHECK(share_at(shade, middle_m - 12.0 * to_light) == relative(std::exp(-1.2), 0.02));
  CHECK(share_at(shade, middle_m) == relative(std::exp(-0.6), 0.02));
  CHECK(share_at(shade, middle_m + 12.0 * to_light) == relative(1.0, 1e-3));
}

TEST_CASE("smoke under a roof, far away or too thin to see throws no shade") {
  instant::Roof roof;
  roof.object_from_world.position_m = -eye_m;
  roof.min_m = glm::vec3(-50.0f), roof.max_m = glm::vec3(50.0f);
  SceneSummary tunnel;
  tunnel.roofs = {roof};
  const std::vector near{puff_at({10.0, 0.0, 4.0}, 2.0f, 1.0f)}, far{puff_at({400.0, 0.0, 4.0}, 2.0f, 1.0f)},
      thin{puff_at({10.0, 0.0, 4.0}, 2.0f, 0.01f)};
  CHECK_FALSE(smoke_shade(near, {}, low_sun()).moments.empty());
  CHECK(smoke_shade(near, tunnel, low_sun()).moments.empty());
  CHECK(smoke_shade(far, {}, low_sun()).moments.empty());
  CHECK(smoke_shade(thin, {}, low_sun()).moments.empty());
  CHECK(smoke_shade({}, {}, low_sun()).moments.empty());
}

}  // namespace septet::render
