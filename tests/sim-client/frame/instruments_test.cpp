#include "sim-client/frame/instruments.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include <doctest/doctest.h>

#include "car-io/driving_keys.hpp"
#include "tests/shipped_files.hpp"

namespace septet::frame {
namespace {

rig::Rig shipped_rig(const std::string& name) { return *rig::read_rig(shipped_text("rigs/" + name + ".toml"), name); }

Snapshot driving(double speed_mps, int gear, Lamps lamps = {}, double engine_radps = 200.0) {
  Snapshot snapshot;
  snapshot.participants.push_back({.id = 1, .lamps = lamps});
  snapshot.driver_car.participant = 1;
  snapshot.driver_car.speed_mps = speed_mps;
  snapshot.driver_car.gear = static_cast<std::int8_t>(gear);
  snapshot.driver_car.engine_radps = engine_radps;
  return snapshot;
}

Lamps lit(Lamp lamp) {
  Lamps lamps;
  lamps.set(lamp, true);
  return lamps;
}

bool says(const std::vector<instant::OverlayText>& texts, const std::string& text) {
  return std::ranges::any_of(texts, [&](const auto& line) { return line.text == text; });
}

}  // namespace

TEST_CASE("speed and gear are those of the snapshot, where no cockpit is drawn with dials of its own") {
  rig::Rig rig = shipped_rig("desktop");
  rig::Screen& screen = rig.screens[0];
  CHECK(instruments(driving(30.0, 5), rig, screen).empty());
  screen.show_interior = false;
  CHECK(says(instruments(driving(30.0, 5), rig, screen), "108 km/h   5"));
  CHECK(says(instruments(driving(0.0, 0), rig, screen), "0 km/h   N"));
  CHECK(says(instruments(driving(-2.5, -1), rig, screen), "9 km/h   R"));
  CHECK(instruments(driving(30.0, 5), rig, screen).size() == 1);
}

TEST_CASE("warning lamps show what is on") {
  rig::Rig rig = shipped_rig("desktop");
  rig::Screen& screen = rig.screens[0];
  CHECK(says(instruments(driving(0.0, 1, {}, 0.0), rig, screen), "engine stalled"));
  screen.show_interior = false;
  CHECK(says(instruments(driving(10.0, 2, lit(Lamp::indicator_left)), rig, screen), "◀"));
  CHECK_FALSE(says(instruments(driving(10.0, 2, lit(Lamp::indicator_left)), rig, screen), "▶"));
  CHECK(says(instruments(driving(10.0, 2, lit(Lamp::indicator_right)), rig, screen), "▶"));
  CHECK(says(instruments(driving(0.0, 1, {}, 0.0), rig, screen), "engine stalled"));
}

TEST_CASE("only screens whose rig asks for instruments have them") {
  for (const char* name : {"desktop", "three-monitors", "seven-screens"}) {
    const rig::Rig rig = shipped_rig(name);
    for (const auto& screen : rig.screens) {
      CAPTURE(screen.name);
      CHECK(instruments(driving(30.0, 5, {}, 0.0), rig, screen).empty() ==
            (screen.name != "desktop" && screen.name != "middle"));
    }
  }
}

TEST_CASE("the table of keys has every key and stays on the screen") {
  rig::Screen screen;
  for (const auto& [width_px, height_px] : {std::pair{1280u, 747u}, {1920u, 1080u}, {3840u, 2160u}, {640u, 458u}}) {
    screen.width_px = width_px;
    screen.height_px = height_px;
    const auto texts = key_table("Press any key to start", screen);
    for (const auto& key : car_io::driving_keys()) {
      CHECK(says(texts, car_io::names_of_keys(key)));
      CHECK(says(texts, key.does));
    }
    CHECK(texts.front().text == "Press any key to start");
    CHECK(texts.back().y_px + texts.back().height_px < 0.85f * static_cast<float>(height_px));
  }
}

TEST_CASE("the table of keys is one panel: its boxes touch, and no text is wider than its own") {
  rig::Screen screen;
  screen.width_px = 1280;
  screen.height_px = 747;
  const auto texts = key_table("", screen);
  REQUIRE(texts.size() == 2 * car_io::driving_keys().size());
  for (std::size_t i = 0; i < texts.size(); i += 2) {
    CHECK(texts[i].x_px + texts[i].least_box_px == texts[i + 1].x_px);
    if (i > 0) CHECK(texts[i].y_px == texts[i - 2].y_px + texts[i].height_px + 4.0f);  // As boxes are drawn.
    for (const auto& text : {texts[i], texts[i + 1]})
      CHECK(text.text.size() * 0.45f * text.height_px < text.least_box_px);
  }
}

TEST_CASE(
    "a notice's first line is the largest, and a long second one is broken between its words and stays on the screen") {
  rig::Screen screen;
  for (const std::uint32_t width_px : {320u, 1280u, 3840u}) {
    screen.width_px = width_px;
    screen.height_px = width_px * 7 / 12;
    const std::string about =
        "A first lesson: country road, village with a crossing, straight on at the lights, out of the roundabout by "
        "the second way";
    const auto lines = notice("Press any key to start\n" + about, screen);
    REQUIRE(lines.size() >= 3);
    CHECK(lines[0].text == "Press any key to start");
    std::string joined;
    for (std::size_t i = 1; i < lines.size(); ++i) {
      joined += (i == 1 ? "" : " ") + lines[i].text;
      CHECK(lines[i].height_px < lines[0].height_px);
      CHECK(lines[i].y_px - 0.5f * lines[i].height_px >= lines[i - 1].y_px + 0.5f * lines[i - 1].height_px);
      CHECK(lines[i].text.size() * 0.4f * lines[i].height_px < static_cast<float>(width_px));
    }
    CHECK(joined == about);
    CHECK(key_table("Press any key to start\n" + about, screen).size() ==
          key_table("", screen).size() + notice("Press any key to start\n" + about, screen).size());
  }
  CHECK(notice("", screen).empty());
  CHECK(notice("a\n" + std::string(300, 'b'), screen).size() == 2);
}

TEST_CASE("a window that stands upright has its keys and its notices within its width") {
  rig::Screen screen;
  screen.width_px = 500;
  screen.height_px = 900;
  for (const auto& text : key_table("Press any key to start", screen)) {
    const double right_px = text.centered ? text.text.size() * 0.45 * text.height_px : text.x_px + text.least_box_px;
    CHECK(right_px < 500.0);
  }
  const std::string paused = "Paused. Escape: go on. R: begin again. Enter: end";
  for (const std::string& said : {paused, "no signal from the car, check its cable and its hub. " + paused}) {
    std::string joined;
    for (const auto& text : notice(said, screen)) {
      CHECK(text.text.size() * 0.45f * text.height_px < 500.0f);
      joined += (joined.empty() ? "" : " ") + text.text;
    }
    CHECK(joined == said);
  }
}

TEST_CASE("an engine that idles is not called stalled and one that stands is") {
  const rig::Rig rig = shipped_rig("desktop");
  const auto is_told_at = [&](double engine_radps) {
    return says(instruments(driving(0.0, 0, {}, engine_radps), rig, rig.screens[0]), "engine stalled");
  };
  CHECK_FALSE(is_told_at(70.0));
  CHECK_FALSE(is_told_at(20.0));
  CHECK(is_told_at(0.0));
}

}  // namespace septet::frame
