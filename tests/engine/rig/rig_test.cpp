#include "engine/rig/rig.hpp"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/engine/rig/upper_right.hpp"
#include "tests/relative.hpp"
#include "tests/shipped_files.hpp"
#include "tests/why_not.hpp"

namespace septet::rig {
namespace {

std::string shipped(const std::string& name) { return shipped_text("rigs/" + name + ".toml"); }

Vec3 from_eye(const Rig& rig, const Vec3& point) { return point - rig.eye_point_m; }
double azimuth_deg(const Vec3& direction) { return std::atan2(direction.y, direction.x) * 57.29577951308232; }

constexpr const char* one_screen = R"(
eye_point_m = [0, 0, 1]
[[screen]]
name = "front"
lower_left_m = [2, 1, 0]
lower_right_m = [2, -1, 0]
upper_left_m = [2, 1, 2]
)";

}  // namespace

TEST_CASE("seven screens cover 220 by 30 degrees ahead and 60 by 30 behind") {
  const auto rig = read_rig(shipped("seven-screens"), "seven-screens.toml");
  REQUIRE_MESSAGE(rig, why_not(rig));
  REQUIRE(rig->screens.size() == 7);
  const auto left_edge = [&](int i) {
    return azimuth_deg(from_eye(*rig, rig->screens[i].views[0].window.lower_left_m));
  };
  const auto right_edge = [&](int i) {
    return azimuth_deg(from_eye(*rig, rig->screens[i].views[0].window.lower_right_m));
  };
  CHECK(left_edge(0) == doctest::Approx(110.0));
  CHECK(right_edge(4) == doctest::Approx(-110.0));
  CHECK(left_edge(5) == doctest::Approx(-150.0));
  CHECK(right_edge(6) == doctest::Approx(150.0));
  for (const auto& screen : rig->screens) {
    const auto& window = screen.views[0].window;
    for (const Vec3& corner : {window.lower_left_m, window.lower_right_m, window.upper_left_m, upper_right_m(window)}) {
      const Vec3 direction = from_eye(*rig, corner);
      const double elevation_deg =
          std::atan2(std::abs(direction.z), std::hypot(direction.x, direction.y)) * 57.29577951308232;
      CHECK(elevation_deg == relative(15.0, 1e-5));
    }
  }
}

TEST_CASE("neighbouring screens ahead share an edge") {
  const auto rig = read_rig(shipped("seven-screens"), "seven-screens.toml");
  REQUIRE(rig);
  for (int i : {0, 1, 2, 3, 5}) {
    const auto& left = rig->screens[i].views[0].window;
    const auto& right = rig->screens[i + 1].views[0].window;
    CHECK(glm::length(left.lower_right_m - right.lower_left_m) < 1e-5);
    CHECK(glm::length(upper_right_m(left) - right.upper_left_m) < 1e-5);
  }
}

TEST_CASE("a screen may show the instruments alone: it is never the screen ahead, and has no insets") {
  const std::string panel =
      "[[screen]]\nname = \"panel\"\nshows = \"instruments\"\nlower_left_m = [2.05, 0.52, 1.0]\n"
      "lower_right_m = [2.05, 0.22, 1.0]\nupper_left_m = [2.05, 0.52, 1.3]\n";
  const auto rig = read_rig(shipped("desktop") + panel, "desktop");
  REQUIRE(rig);
  CHECK(rig->screens.back().only_instruments);
  CHECK(screen_ahead(*rig).name == "desktop");
  const auto inset = read_rig(shipped("desktop") + panel + "[[screen.inset]]\nmirror = \"left mirror\"\n", "desktop");
  REQUIRE_FALSE(inset);
  CHECK(inset.error().what == "a screen that shows the instruments has insets");
  const auto alone = read_rig("name = \"alone\"\neye_point_m = [1.35, 0.37, 1.17]\n" + panel, "alone");
  REQUIRE_FALSE(alone);
  CHECK(alone.error().what == "no screen of the rig shows the road");
  CHECK_FALSE(read_rig(shipped("desktop") + panel + "shows_not = 1\n", "desktop"));
}

TEST_CASE("the screen ahead is the one that the driver looks straight through") {
  for (const auto& [name, ahead] :
       {std::pair{"seven-screens", "ahead-3"}, {"three-monitors", "middle"}, {"desktop", "desktop"}}) {
    const auto rig = read_rig(shipped(name), name);
    REQUIRE(rig);
    const Screen& screen = screen_ahead(*rig);
    CHECK(screen.name == ahead);
    const auto point = point_ahead(*rig, screen);
    REQUIRE(point);
    CHECK(point->x == doctest::Approx(0.5));
    // Desks show the dashboard, so that their screens' middles lie below the eyes.
    CHECK(point->y > 0.2);
    CHECK(point->y < 0.501);
  }
  const auto seven = read_rig(shipped("seven-screens"), "seven-screens");
  CHECK_FALSE(point_ahead(*seven, seven->screens[5]));  // It stands behind.
}

TEST_CASE("every shipped rig is read") {
  for (const char* name : {"seven-screens", "three-monitors", "desktop"}) {
    const auto rig = read_rig(shipped(name), name);
    CHECK_MESSAGE(rig, why_not(rig));
    if (rig) CHECK(rig->name == name);
  }
}

TEST_CASE("a drive at a desk is heard and one in a hall has the sound of its own installation") {
  for (const char* name : {"three-monitors", "desktop"}) CHECK(read_rig(shipped(name), name)->sound.has_value());
  CHECK_FALSE(read_rig(shipped("seven-screens"), "seven-screens")->sound.has_value());
}

TEST_CASE("a screen has the monitor that its rig names and none unless it does") {
  const std::string good = one_screen;
  const auto plain = read_rig(good, "my.toml"),
             placed = read_rig(good + "monitor = 2\nfull_screen = true\n", "my.toml");
  REQUIRE((plain && placed));
  CHECK_FALSE(plain->screens[0].monitor.has_value());
  CHECK_FALSE(plain->screens[0].full_screen);
  CHECK(placed->screens[0].monitor == 2u);
  CHECK(placed->screens[0].full_screen);
}

TEST_CASE("a wrong rig is refused with its line and column and a remedy") {
  const auto refuse = [](const std::string& text, const std::string& where, const std::string& what) {
    const auto rig = read_rig(text, "my.toml");
    REQUIRE_FALSE(rig);
    CHECK(rig.error().where == where);
    CHECK(rig.error().what.find(what) != std::string::npos);
    CHECK_FALSE(rig.error().remedy.empty());
  };
  const std::string good = one_screen;
  REQUIRE(read_rig(good, "my.toml"));
  refuse("eye_point_m = [0, 0", "my.toml:1:20", "");
  refuse(good + "heigth_px = 3\n", "my.toml:8:13", "heigth_px");
  refuse(good + "width_px = 5\n", "my.toml:8:12", "width_px");
  refuse("eye_point_m = [0, 0, 1]\n", "my.toml:1:1", "no screen");
  refuse(good + "monitor = 64\n", "my.toml:8:11", "monitor");
  refuse(good + "full_screen = \"left\"\n", "my.toml:8:15", "full_screen");
  refuse(good + "[network]\ntransport = \"pigeon\"\n", "my.toml:9:13", "pigeon");
  const auto network = [&](const std::string& key, const std::string& address, const std::string& where) {
    refuse(good + "[network]\n" + key + " = \"" + address + "\"\n", where,
           "network." + key + " is \"" + address + "\"");
  };
  network("server_address", "10.7.0.300", "my.toml:9:18");
  network("server_address", "", "my.toml:9:18");
  // The server opens these, and no name of a machine is one.
  for (const char* none : {"10.7.0.300", "10.7.0", "10.7.0.1.2", "::1", "localhost", " 127.0.0.1", "0x7f.1"})
    network("interface_address", none, "my.toml:9:21");
  for (const char* none : {"", "239.77.77.256", "ff02::1", "10.7.0.3", "223.1.1.1", "240.1.1.1", "255.255.255.255"})
    network("tick_group", none, "my.toml:9:14");
  refuse(good + "[head]\nlisten = \"10.7.0.300\"\n", "my.toml:9:10", "head.listen is \"10.7.0.300\"");
  refuse(good + "[car.actuators]\nfan_least = 0.5\nfan_most = 0.4\n", "my.toml:9:13", "the fan just turns");
  const std::string desktop = shipped("desktop"), named = "[[screen]]\nname = \"";
  const auto called = [&](const std::string& name) {
    std::string text = desktop;
    return read_rig(text.replace(text.find(named) + named.size(), 7, name), "long.toml");
  };
  CHECK(called(std::string(63, 's')));
  REQUIRE_FALSE(called(std::string(64, 's')));
  CHECK(called(std::string(64, 's')).error().remedy == "use small letters, digits and hyphens, 63 at most");
  refuse(
      "eye_point_m = [0, 0, 1]\n[[screen]]\nname = \"front\"\nlower_left_m = [2, 1, 0]\nlower_right_m = [2, -1, "
      "0]\nupper_left_m = [2, 0, 2]\n",
      "my.toml:6:16", "rectangle");
  // Half a degree off a right angle is refused.
  refuse(
      "eye_point_m = [0, 0, 1]\n[[screen]]\nname = \"front\"\nlower_left_m = [2, 1, 0]\nlower_right_m = [2, -1, "
      "0]\nupper_left_m = [2, 1.0175, 2]\n",
      "my.toml:6:16", "rectangle");
  const std::string mirror =
      "[[screen.inset]]\nlower_left_m = [1, 1, 0]\nlower_right_m = [1, 0, 0]\nupper_left_m = [1, 1, 1]\nheight = "
      "0.25\nwidth = 0.25\n";
  REQUIRE(read_rig(good + mirror + "left = 0.75\ntop = 0.75\n", "my.toml"));
  refuse(good + mirror + "left = 0.8\n", "my.toml:14:8", "edge of its screen");
  refuse(good + mirror + "top = 0.8\n", "my.toml:8:1", "edge of its screen");
}

TEST_CASE("the keyboard that drives is the named screen's or those at the server's own machine") {
  const std::string screens =
      "eye_point_m = [0, 0, 1]\n[[screen]]\nname = \"near\"\nlower_left_m = [2, 1, 0]\nlower_right_m = [2, -1, "
      "0]\nupper_left_m = [2, 1, 2]\n"
      "[[screen]]\nname = \"far\"\nmachine = \"pc-2\"\nlower_left_m = [2, 1, 0]\nlower_right_m = [2, -1, "
      "0]\nupper_left_m = [2, 1, 2]\n";
  const auto driving = [&](const std::string& car) {
    const auto rig = read_rig(screens + "[car]\n" + car, "my.toml");
    REQUIRE_MESSAGE(rig, why_not(rig));
    return driving_screens(*rig);
  };
  using Names = std::set<std::string>;
  CHECK(driving("source = \"keyboard\"\n") == Names{"near"});
  CHECK(driving("source = \"keyboard\"\nkeyboard_screen = \"far\"\n") == Names{"far"});
  CHECK(driving("source = \"hid\"\nkeyboard_screen = \"far\"\n").empty());
  CHECK(driving("source = \"simulated-driver\"\n").empty());

  const auto refused = [&](const std::string& text, const std::string& what) {
    const auto rig = read_rig(text, "my.toml");
    REQUIRE_FALSE(rig);
    CHECK(rig.error().what.find(what) != std::string::npos);
  };
  refused(screens + "[car]\nsource = \"keyboard\"\nkeyboard_screen = \"fra\"\n", "\"fra\"");
  // No seat for a driver.
  refused(one_screen + std::string("machine = \"pc-2\"\n[car]\nsource = \"keyboard\"\n"), "no keyboard drives");
}

TEST_CASE("the point straight ahead of the eyes is told from the screen's upper left") {
  const auto ahead = [](const std::string& eye) {
    std::string text = one_screen;
    text.replace(text.find("[0, 0, 1]"), 9, eye);
    const auto rig = read_rig(text, "my.toml");
    REQUIRE(rig);
    const auto point = point_ahead(*rig, rig->screens[0]);
    REQUIRE(point);
    return *point;
  };
  CHECK(glm::distance(ahead("[0, 0, 1]"), Vec2(0.5, 0.5)) < 1e-9);
  CHECK(glm::distance(ahead("[0, 0.5, 1.5]"), Vec2(0.25, 0.25)) < 1e-9);
  CHECK(glm::distance(ahead("[0, -0.5, 0.2]"), Vec2(0.75, 0.9)) < 1e-9);
}

}  // namespace septet::rig
