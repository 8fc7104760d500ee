#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/rig/rig.hpp"
#include "tests/relative.hpp"
#include "tests/shipped_files.hpp"
#include "tests/why_not.hpp"

namespace septet::rig {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

Rig shipped_rig(const std::string& name) {
  auto rig = read_rig(shipped_text("rigs/" + name + ".toml"), name);
  REQUIRE_MESSAGE(rig, why_not(rig));
  return *rig;
}

constexpr const char* plain_screen = R"(
name = "one"
eye_point_m = [0, 0, 1]
[[screen]]
name = "front"
lower_left_m = [2, 1, 0]
lower_right_m = [2, -1, 0]
upper_left_m = [2, 1, 2]
)";

constexpr const char* one_mirror = R"(
[[mirror]]
name = "left mirror"
lower_left_m = [0.6, 0.9, 0.95]
lower_right_m = [0.7, 0.7, 0.95]
upper_left_m = [0.6, 0.9, 1.05]
)";

std::string refusal(const std::string& text) {
  const auto rig = read_rig(text, "one.toml");
  return why_not(rig);
}

Vec3 middle_of(const Window& window) { return 0.5 * (window.lower_right_m + window.upper_left_m); }

}  // namespace

TEST_CASE("every shipped rig has the two door mirrors and the inside one where a look at them is a zone of the head") {
  for (const char* name : {"desktop", "three-monitors", "seven-screens"}) {
    CAPTURE(name);
    const Rig rig = shipped_rig(name);
    REQUIRE(rig.mirrors.size() == 3);
    for (const Mirror& mirror : rig.mirrors) {
      CAPTURE(mirror.name);
      const Vec3 to_glass = middle_of(mirror.glass) - rig.eye_point_m;
      const double heading_rad = std::atan2(to_glass.y, to_glass.x);
      CHECK(mirror.from_rad <= heading_rad);
      CHECK(heading_rad < mirror.to_rad);
      CHECK((mirror.radius_m > 0.0) == (mirror.name != "inside mirror"));
    }
    for (const Mirror& a : rig.mirrors)
      for (const Mirror& b : rig.mirrors)
        if (a.name != b.name) CHECK((a.to_rad <= b.from_rad || b.to_rad <= a.from_rad));
  }
}

TEST_CASE("the middle of each shipped mirror shows what lies level behind the car") {
  for (const char* name : {"desktop", "three-monitors", "seven-screens"}) {
    const Rig rig = shipped_rig(name);
    for (const Mirror& mirror : rig.mirrors) {
      CAPTURE(mirror.name);
      const Window& glass = mirror.glass;
      const Vec3 normal =
          glm::normalize(glm::cross(glass.lower_right_m - glass.lower_left_m, glass.upper_left_m - glass.lower_left_m));
      const Vec3 seen = glm::reflect(glm::normalize(middle_of(glass) - rig.eye_point_m), normal);
      CHECK(std::abs(seen.z) < 1e-3);
      CHECK(seen.x < -0.98);
    }
  }
}

TEST_CASE("the real mirrors within the seven screens meet those behind") {
  const Rig rig = shipped_rig("seven-screens");
  for (const Mirror& mirror : rig.mirrors) {
    CAPTURE(mirror.name);
    const Vec3 from = middle_of(mirror.glass);
    const Window& glass = mirror.glass;
    const Vec3 normal =
        glm::normalize(glm::cross(glass.lower_right_m - glass.lower_left_m, glass.upper_left_m - glass.lower_left_m));
    const Vec3 way = glm::reflect(glm::normalize(from - rig.eye_point_m), normal);
    int met = 0;
    for (const Screen& screen : rig.screens) {
      if (!screen.name.starts_with("behind")) continue;
      const Window& window = screen.views.front().window;
      const Vec3 right = window.lower_right_m - window.lower_left_m, up = window.upper_left_m - window.lower_left_m;
      const Vec3 back = glm::cross(right, up);
      const Vec3 at = from + way * (glm::dot(window.lower_left_m - from, back) / glm::dot(way, back));
      const double u = glm::dot(at - window.lower_left_m, right) / glm::dot(right, right);
      const double v = glm::dot(at - window.lower_left_m, up) / glm::dot(up, up);
      met += u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0;
    }
    CHECK(met == 1);
  }
}

TEST_CASE("the window of a desktop, which does not reach the mirrors, has each of them as an inset of its shape") {
  {
    const Rig rig = shipped_rig("desktop");
    std::size_t shown = 0;
    for (const Screen& screen : rig.screens)
      for (const View& view : screen.views)
        if (view.mirror) {
          ++shown;
          CHECK(view.mirrored);
          const Window& glass = view.window;
          const double glass_aspect = glm::distance(glass.lower_left_m, glass.lower_right_m) /
                                      glm::distance(glass.lower_left_m, glass.upper_left_m);
          CHECK(view.width * screen.width_px / (view.height * screen.height_px) == relative(glass_aspect, 0.01));
        }
    CHECK(shown == rig.mirrors.size());
  }
}

TEST_CASE("a mirror's zone is around its glass unless the rig says where") {
  const auto usual = read_rig(std::string(plain_screen) + one_mirror, "one.toml");
  REQUIRE_MESSAGE(usual, why_not(usual));
  const double heading_rad = std::atan2(0.8, 0.65);
  CHECK(usual->mirrors[0].from_rad == doctest::Approx(heading_rad - 15 * degree));
  CHECK(usual->mirrors[0].to_rad == doctest::Approx(heading_rad + 15 * degree));
  const auto said =
      read_rig(std::string(plain_screen) + one_mirror + "zone_from_deg = 20\nzone_to_deg = 70.5\n", "one.toml");
  REQUIRE(said);
  CHECK(said->mirrors[0].from_rad == doctest::Approx(20 * degree));
  CHECK(said->mirrors[0].to_rad == doctest::Approx(70.5 * degree));
}

TEST_CASE("a head tracker's axes are read with their signs") {
  const auto rig =
      read_rig(std::string(plain_screen) +
                   "[head]\nport = 4243\nforward = \"z\"\nturn_left = \"-roll\"\nreach_m = [0.1, 0.2, 0]\n",
               "one.toml");
  REQUIRE_MESSAGE(rig, why_not(rig));
  REQUIRE(rig->head);
  CHECK(rig->head->port == 4243);
  CHECK(rig->head->listen == "127.0.0.1");
  CHECK(rig->head->forward.of == HeadAxis::Of::z);
  CHECK_FALSE(rig->head->forward.inverted);
  CHECK(rig->head->turn_left.of == HeadAxis::Of::roll);
  CHECK(rig->head->turn_left.inverted);
  CHECK(rig->head->reach_m == Vec3(0.1, 0.2, 0.0));
}

TEST_CASE("what a rig says wrongly of head and mirrors is refused with what and where") {
  const std::string mirror = one_mirror;
  const auto with = [&](const std::string& text) { return refusal(plain_screen + text); };
  CHECK(with("[head]\nforward = \"--z\"\n").find("head.forward") != std::string::npos);
  CHECK(with("[head]\nup = \"\"\n").find("head.up") != std::string::npos);
  CHECK(with("[head]\nport = 0\n").find("port") != std::string::npos);
  CHECK(with("[head]\nreach_m = [0.1, nan, 0.1]\n") != "");
  CHECK(with("[head]\nreach_m = [0.1, -0.1, 0.1]\n").find("reach_m") != std::string::npos);
  CHECK(with(mirror + mirror).find("two mirrors") != std::string::npos);
  CHECK(with(mirror + "zone_from_deg = 50\nzone_to_deg = 50\n").find("zone") != std::string::npos);
  CHECK(with(mirror + "radius_m = 0.01\n").find("a ball") != std::string::npos);
  CHECK(with(mirror + "radius_m = -1\n").find("radius_m") != std::string::npos);
  CHECK(with("[[screen.inset]]\nmirror = \"left mirror\"\n").find("no mirror") != std::string::npos);
  CHECK(with("[[mirror]]\nname = \"\\u001b[31m\"\n").find("mirror.name") != std::string::npos);
  // Seen from behind: left and right changed.
  CHECK(with("[[mirror]]\nname = \"m\"\nlower_left_m = [0.7, 0.7, 1]\nlower_right_m = [0.6, 0.9, 1]\nupper_left_m = "
             "[0.7, 0.7, 1.1]\n")
            .find("front") != std::string::npos);
  // Eyes that may come to stand behind a screen 2 m ahead, or a glass 0.6 m ahead, would be blind.
  std::string near = plain_screen;
  for (std::size_t at; (at = near.find("[2,")) != std::string::npos;) near.replace(at, 3, "[0.25,");
  CHECK(refusal(near) == "");
  CHECK(refusal(near + "[head]\n").find("front") != std::string::npos);
  CHECK(refusal(near + "[head]\nreach_m = [0.2, 0.3, 0.2]\n") == "");
}

}  // namespace septet::rig
