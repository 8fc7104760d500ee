// A replay at somebody else's eyes: where the screens stand, where they look, what they say.

#include <algorithm>
#include <optional>
#include <string>

#include <doctest/doctest.h>
#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/scenery/vehicles/eye_point.hpp"
#include "sim-client/frame/screen_frames.hpp"
#include "tests/shipped_files.hpp"
#include "tests/why_not.hpp"

namespace septet::frame {
namespace {

constexpr ParticipantId driver = 1, crosser = 4;

Snapshot crossing() {
  Snapshot world;
  const auto add = [&](ParticipantId id, const char* model, const Vec3& place_m, double heading_rad) {
    Participant participant;
    participant.id = id;
    participant.model = *find_vehicle_model(model);
    participant.world_from_vehicle = {place_m, orientation_from_angles(heading_rad, 0.02, -0.03)};
    world.participants.push_back(participant);
  };
  add(driver, "volvo-s80", {10.0, 20.0, 1.0}, 0.3);
  add(crosser, "lorry", {60.0, -20.0, 2.0}, 1.9);
  world.driver_car.participant = driver;
  world.driver_car.gaze_heading_rad = 0.5;
  return world;
}

rig::Rig seven_screens() {
  auto rig = rig::read_rig(shipped_text("rigs/seven-screens.toml"), "seven-screens");
  REQUIRE_MESSAGE(rig.has_value(), why_not(rig));
  return *rig;
}

std::string texts_of(const instant::FrameInput& frame) {
  std::string texts;
  for (const auto& line : frame.overlay) texts += line.text + '\n';
  return texts;
}

/// Frame of a screen, with or without somebody's eyes.
instant::FrameInput frame_of(const rig::Rig& rig, const rig::Screen& screen, const Snapshot& world,
                             std::optional<Eyes> eyes, const scene::ResolvedScene& scene = {}) {
  ScreenFrames frames;
  REQUIRE(frames.look_through(rig, screen, std::move(eyes)).has_value());
  return frames.frame(world, scene);
}

}  // namespace

TEST_CASE("the rig's eye point lies at the other driver's eyes and its axes are those of their vehicle") {
  const Snapshot world = crossing();
  const rig::Rig rig = seven_screens();
  const Participant& lorry = world.participants[1];
  for (const rig::Screen& screen : rig.screens) {
    const auto frame = frame_of(rig, screen, world, Eyes{crosser, "4 crosser (lorry)"});
    const auto& view = frame.views.front();
    const Vec3 eye_m = view.world_from_car * view.projection.eye_m;
    CHECK(glm::distance(eye_m, lorry.world_from_vehicle * scenery::eye_in(vehicle_models()[lorry.model])) < 1e-9);
    const Vec3 ahead = view.world_from_car.orientation * Vec3(1, 0, 0);
    CHECK(glm::distance(ahead, lorry.world_from_vehicle.orientation * Vec3(1, 0, 0)) < 1e-12);
    // The windows are the rig's: the picture is that of the driver's screens, moved as a whole.
    const auto own = frame_of(rig, screen, world, std::nullopt);
    for (int column = 0; column < 4; ++column)
      CHECK(view.projection.clip_from_eye_relative[column] ==
            own.views.front().projection.clip_from_eye_relative[column]);
  }
}

TEST_CASE("the screen ahead and no other says whose eyes these are and that they look straight on") {
  const Snapshot world = crossing();
  const rig::Rig rig = seven_screens();
  for (const rig::Screen& screen : rig.screens) {
    const bool is_ahead = &screen == &rig::screen_ahead(rig);
    const std::string texts = texts_of(frame_of(rig, screen, world, Eyes{crosser, "4 crosser (lorry)"}));
    CHECK((texts.find("eyes of 4 crosser (lorry)") != std::string::npos) == is_ahead);
    CHECK((texts.find("straight on: their gaze is not logged") != std::string::npos) == is_ahead);
    CHECK(texts.find("km/h") == std::string::npos);  // That would be the driver's.
    CHECK(texts_of(frame_of(rig, screen, world, std::nullopt)).find("eyes of") == std::string::npos);
  }
}

TEST_CASE("the driver's own eyes turn the windows by the logged gaze, others' do not") {
  const Snapshot world = crossing();
  const rig::Rig rig = seven_screens();
  const rig::Screen& ahead = rig::screen_ahead(rig);
  const auto looks_along = [&](std::optional<Eyes> eyes) {
    const auto view = frame_of(rig, ahead, world, std::move(eyes)).views.front();
    return -view.projection.back;
  };
  const Vec3 straight = looks_along(std::nullopt), theirs = looks_along(Eyes{crosser, "4"}),
             gaze = looks_along(Eyes{driver, "1 ego"});
  CHECK(glm::distance(theirs, straight) < 1e-12);
  CHECK(glm::distance(gaze, orientation_from_angles(0.5, 0.0, 0.0) * straight) < 1e-9);
  CHECK(texts_of(frame_of(rig, ahead, world, Eyes{driver, "1 ego"})).find("as logged") != std::string::npos);
}

TEST_CASE("insets, which are mirrors of the driver's car, are left out at others' eyes") {
  const Snapshot world = crossing();
  const auto rig = rig::read_rig(shipped_text("rigs/desktop.toml"), "desktop");
  REQUIRE(rig.has_value());
  const rig::Screen& screen = rig->screens.front();
  CHECK(frame_of(*rig, screen, world, std::nullopt).views.size() > 1);
  CHECK(frame_of(*rig, screen, world, Eyes{crosser, "4"}).views.size() == 1);
}

TEST_CASE(
    "a rig with a real car draws the inside of any other vehicle that one looks out of, and not of the driver's") {
  Snapshot world = crossing();
  const rig::Rig rig = seven_screens();
  const rig::Screen& ahead = rig::screen_ahead(rig);
  CHECK_FALSE(ahead.show_interior);
  for (const char* name : {"volvo-s80", "lorry", "city-bus", "bicycle"}) {
    CAPTURE(name);
    for (Participant& participant : world.participants) participant.model = *find_vehicle_model(name);
    scene::ResolvedScene scene;
    scene.prototypes = {{.name = name}, {.name = fmt::format("interior/{}", name)}};
    const auto insides = [&](ParticipantId of) {
      const auto frame = frame_of(rig, ahead, world, Eyes{of, "one"}, scene);
      return std::ranges::count(frame.participants, 1u, &instant::DrawnParticipant::prototype);
    };
    CHECK(insides(crosser) == 1);
    CHECK(insides(driver) == 0);
  }
}

TEST_CASE("before somebody is there the screens wait at the driver's eyes, and after at the last place, and say so") {
  const Snapshot world = crossing();
  Snapshot without = world;
  without.participants.pop_back();
  const rig::Rig rig = seven_screens();
  const rig::Screen& ahead = rig::screen_ahead(rig);
  ScreenFrames frames;
  REQUIRE(frames.look_through(rig, ahead, Eyes{crosser, "4 crosser (lorry)"}).has_value());
  const scene::ResolvedScene scene;
  const auto place_of = [&](const Snapshot& shown, bool is_there) {
    const auto frame = frames.frame(shown, scene);
    CHECK((texts_of(frame).find("not there at this instant") == std::string::npos) == is_there);
    return frame.views.front().world_from_car.position_m;
  };
  CHECK(place_of(without, false) == world.participants[0].world_from_vehicle.position_m);
  const Vec3 there_m = place_of(world, true);
  CHECK(glm::distance(there_m, world.participants[1].world_from_vehicle.position_m) < 15.0);
  CHECK(place_of(without, false) == there_m);
}

TEST_CASE(
    "what an editor hangs on a participant is drawn where that one is, without lamps of its own, and its paint is "
    "worn") {
  const Snapshot world = crossing();
  const rig::Rig rig = seven_screens();
  ScreenFrames frames;
  REQUIRE(frames.look_through(rig, rig.screens.front(), std::nullopt).has_value());
  scene::ResolvedScene scene;
  scene.prototypes = {
      {.name = "lorry"}, {.name = "participant/4"}, {.name = "participant/44"}, {.name = "participant/4x"}};
  scene.prototypes[1].paint = glm::vec3(0.5f, 0.0f, 0.25f);
  const auto frame = frames.frame(world, scene);
  REQUIRE(frame.participants.size() == 2);
  CHECK(std::ranges::count(frame.participants, *scene.prototypes[1].paint, &instant::DrawnParticipant::paint) == 1);
  CHECK(std::ranges::count(frame.participants, 1u, &instant::DrawnParticipant::prototype) == 1);
  for (const instant::DrawnParticipant& drawn : frame.participants)
    CHECK(drawn.world_from_vehicle.position_m == world.participants[1].world_from_vehicle.position_m);

  scene.prototypes[1].is_hidden = true;
  CHECK(frames.frame(world, scene).participants.empty());
}

TEST_CASE("an object that moves is drawn where its motion has it at the instant shown") {
  Snapshot world = crossing();
  const rig::Rig rig = seven_screens();
  ScreenFrames frames;
  REQUIRE(frames.look_through(rig, rig.screens.front(), std::nullopt).has_value());
  scene::ResolvedScene scene;
  scene.prototypes.resize(2);
  scene.prototypes[1] = {.motion = {{10, 0, 0}, {1, 0, 0, 0}, {{2.0, {4, 0, 0}, {0, 2, 0}, {}}, {3.0, {}, {}, {}}}},
                         .number = 0x80000009};
  for (const auto& [time_s, place_m] :
       {std::pair(1.0, Vec3(10, 0, 0)), std::pair(2.5, Vec3(12, 0.25, 0)), std::pair(9.0, Vec3(14, 1, 0))}) {
    world.simulated_time_s = time_s;
    const auto frame = frames.frame(world, scene);
    REQUIRE(frame.participants.size() == 1);
    CHECK(frame.participants.front().prototype == 1);
    CHECK(frame.participants.front().number == 0x80000009);
    CHECK(glm::distance(frame.participants.front().world_from_vehicle.position_m, place_m) < 1e-12);
  }
}

}  // namespace septet::frame
