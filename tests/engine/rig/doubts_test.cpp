#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "engine/rig/rig.hpp"
#include "engine/rig/rig_doubts.hpp"
#include "tests/shipped_files.hpp"
#include "tests/why_not.hpp"

namespace septet::rig {
namespace {

/// Doubts about a screen 1.6 m wide and 0.9 m high.
std::vector<Error> doubts_with(const std::string& settings) {
  const auto rig = read_rig(
      "eye_point_m = [0, 0, 1]\n[[screen]]\nname = \"front\"\nlower_left_m = [2, 0.8, 0.5]\n"
      "lower_right_m = [2, -0.8, 0.5]\nupper_left_m = [2, 0.8, 1.4]\n" +
          settings,
      "own.toml");
  REQUIRE_MESSAGE(rig, why_not(rig));
  return doubts_of(*rig, "own.toml");
}

}  // namespace

TEST_CASE("pixels more than 5 % wider than high, or higher than wide, are doubted with the size that would fit") {
  const auto of = [](int width_px, int height_px) {
    return doubts_with(fmt::format("width_px = {}\nheight_px = {}\n", width_px, height_px));
  };
  for (const int height_px : {1030, 1080, 1130}) CHECK(of(1920, height_px).empty());
  for (const int height_px : {1020, 1140}) CHECK(of(1920, height_px).size() == 1);
  CHECK(of(2560, 1440).empty());
  const auto high = of(1920, 1200);
  REQUIRE(high.size() == 1);
  CHECK(high[0].what ==
        "the pixels of the screen front are 1.11 times as wide as high: 1920 × 1200 pixels on 1.600 m × 0.900 m");
  CHECK(high[0].where == "own.toml");
  CHECK(high[0].remedy == "measure its corners again (1.000 m of height would fit), or give it 1920 × 1080 pixels");
  const auto flat = of(2560, 1080);
  REQUIRE(flat.size() == 1);
  CHECK(flat[0].what.find("0.75 times as wide as high") != std::string::npos);
  CHECK(flat[0].remedy == "measure its corners again (0.675 m of height would fit), or give it 2560 × 1440 pixels");
}

TEST_CASE("an instruments' panel, which takes its window's shape, is not doubted for its pixels") {
  const std::string square =
      "width_px = 1920\nheight_px = 1080\n[[screen]]\nname = \"panel\"\nwidth_px = 800\nheight_px = 800\n"
      "lower_left_m = [1.9, 0.15, 0.6]\nlower_right_m = [1.9, -0.15, 0.6]\nupper_left_m = [1.9, 0.15, 0.7]\n";
  CHECK(doubts_with(square).size() == 1);
  CHECK(doubts_with(square + "shows = \"instruments\"\n").empty());
}

TEST_CASE("an inset is doubted for its pixels by its own corners, with the height that would fit") {
  const auto with_inset = [](double height) {
    return doubts_with(
        fmt::format("width_px = 1920\nheight_px = 1080\n[[screen.inset]]\nleft = 0.1\ntop = 0.1\nwidth = 0.25\n"
                    "height = {}\nlower_left_m = [1, 0.4, 1]\nlower_right_m = [1, 0, 1]\nupper_left_m = [1, 0.4, "
                    "1.2]\n",
                    height));
  };
  CHECK(with_inset(240.0 / 1080.0).empty());
  const auto flat = with_inset(0.2);
  REQUIRE(flat.size() == 1);
  CHECK(flat[0].what ==
        "the pixels of inset 1 of the screen front are 0.90 times as wide as high: 480 × 216 pixels for 0.400 m × "
        "0.200 m");
  CHECK(flat[0].remedy == "give it height = 0.2222, or other corners");
}

TEST_CASE("no shipped rig is doubted") {
  for (const char* name : {"seven-screens", "three-monitors", "desktop"}) {
    const auto rig = read_rig(shipped_text(fmt::format("rigs/{}.toml", name)), name);
    REQUIRE_MESSAGE(rig, why_not(rig));
    for (const Error& doubt : doubts_of(*rig, name)) FAIL_CHECK(describe(doubt));
  }
}

}  // namespace septet::rig
