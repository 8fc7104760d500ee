#include "sim-client/film/film.hpp"

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <variant>

#include <doctest/doctest.h>
#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/film_script/film_script.hpp"
#include "engine/image/png.hpp"
#include "engine/math/spherical_interpolation.hpp"
#include "engine/scenery/vehicles/eye_point.hpp"
#include "engine/world/rider.hpp"
#include "sim-client/film/camera.hpp"
#include "sim-client/film/film_folder.hpp"
#include "sim-client/film/film_program.hpp"
#include "sim-client/film/traced/layers.hpp"
#include "tests/relative.hpp"
#include "tests/shipped_files.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::film {
namespace {

constexpr double radians = std::numbers::pi / 180.0, frames_per_second = 25.0;

/// World with a car on a slope that leans, and others.
Snapshot world_with_others() {
  Snapshot world;
  const auto add = [&](ParticipantId id, const char* model, const Vec3& place_m) {
    Participant participant;
    participant.id = id;
    participant.model = *find_vehicle_model(model);
    participant.world_from_vehicle = {place_m, orientation_from_angles(0.7, 0.08, -0.05)};
    world.participants.push_back(participant);
  };
  add(3, "volvo-s80", {3000.0, -2000.0, 35.0});
  add(5, "ambulance", {3200.0, -2000.0, 35.0});
  add(8, "lorry", {3000.0, -1970.0, 35.0});
  add(9, "ambulance", {3100.0, -2000.0, 35.0});
  world.driver_car.participant = 3;
  return world;
}

std::string refusal_of(const std::string& script) {
  const auto read = read_script(script, "shots.toml");
  return why_not(read);
}

}  // namespace

TEST_CASE("a camera begins and ends as told and its angles follow the quadratic law to a billionth of a radian") {
  for (const double sigma : {-1.0, -0.4, 0.0, 0.7, 1.0}) {
    Shot shot{.from_s = 2.0, .to_s = 42.0, .heading_rad = 2.8, .pitch_rad = -0.1};
    shot.turns = {{42.0, -2.2, 0.6, sigma}};
    const double way_rad = 2.0 * std::numbers::pi - 5.0;  // The shorter way leads through half a circle.
    const auto path = camera_path(shot, frames_per_second);
    REQUIRE(path.has_value());
    REQUIRE(path->size() == 1000);
    for (std::size_t n = 0; n < path->size(); ++n) {
      const Look& look = (*path)[n];
      const double share = varied_share(sigma, static_cast<double>(n) / 999.0);
      const double heading_off = std::remainder(look.heading_rad() - (2.8 + way_rad * share), 2.0 * std::numbers::pi);
      REQUIRE(std::abs(heading_off) < 1e-9);
      REQUIRE(std::abs(look.pitch_rad() - (-0.1 + 0.7 * share)) < 1e-9);
      REQUIRE(std::abs(glm::length(look.direction()) - 1.0) < 1e-9);
    }
  }
}

TEST_CASE("turns follow each other without a jump and after the last one the camera holds still") {
  Shot shot{.from_s = 0.0, .to_s = 4.0, .turns = {{1.0, 1.0, 0.0, 1.0}, {3.0, -2.0, -0.3, -1.0}}};
  const auto path = camera_path(shot, frames_per_second);
  REQUIRE(path.has_value());
  REQUIRE(path->size() == 100);
  CHECK(std::abs((*path)[25].heading_rad() - 1.0) < 1e-9);
  for (std::size_t n = 75; n < 100; ++n) CHECK(std::abs((*path)[n].heading_rad() + 2.0) < 1e-9);
  for (std::size_t n = 1; n < 100; ++n) CHECK(std::abs((*path)[n].heading_rad() - (*path)[n - 1].heading_rad()) < 0.13);
}

TEST_CASE("a path without frames or steps or a shorter way is refused with a message that names the shot") {
  const auto refusal = [](double to_s, Turn turn) {
    const auto path = camera_path({.from_s = 1.0, .to_s = to_s, .turns = {turn}, .where = "shot 7"}, frames_per_second);
    return why_not(path);
  };
  const auto check = [](const std::string& message, const char* word) {
    CAPTURE(message);
    CHECK(message.find("shot 7") == 0);
    CHECK(message.find(word) != std::string::npos);
  };
  check(refusal(1.0, {1.0}), "less than a frame");
  check(refusal(3.0, {1.01}), "less than a frame");
  check(refusal(3.0, {3.0, std::numbers::pi}), "neither way is the shorter");
  check(refusal(3.0, {3.0, 1.0, 0.0, 2.0}), "sigma");
}

TEST_CASE("an orbit keeps its distance and its pitch and a level horizon though the car leans") {
  const Snapshot world = world_with_others();
  for (const Bearings bearings : {Bearings::vehicle, Bearings::world}) {
    Shot shot{
        .from_s = 0.0, .to_s = 4.0, .distance_m = 8.0, .bearings = bearings, .heading_rad = 3.0, .pitch_rad = -0.2};
    shot.turns = {{4.0, 0.1, -0.2, 0.0}};
    const auto path = camera_path(shot, frames_per_second);
    REQUIRE(path.has_value());
    const auto pivot = find_pivot(shot, world, Vec3(0.0), *path, {});
    REQUIRE(pivot.has_value());
    const RigidTransform& car = world.participants[0].world_from_vehicle;
    const auto viewpoint = viewpoint_at(shot, *pivot, world, {});
    CHECK_FALSE(viewpoint.inside.has_value());  // The car is drawn whole.
    const double north_rad = bearings == Bearings::world ? 0.0 : 2.0 * std::atan2(car.orientation.z, car.orientation.w);
    for (const Look& look : *path) {
      const auto view = views_at(shot, *pivot, look, 320, 180).views[0].projection;
      const Vec3 eye_m = viewpoint.world_from_views * view.eye_m, middle_m = car * pivot->in_views_m;
      const Vec3 forward = viewpoint.world_from_views.orientation * -view.back;
      REQUIRE(std::abs(glm::length(eye_m - middle_m) - 8.0) < 1e-9);
      REQUIRE(glm::length(eye_m + 8.0 * forward - middle_m) < 1e-9);
      REQUIRE(std::abs(std::asin(forward.z) + 0.2) < 1e-9);
      REQUIRE(std::abs((viewpoint.world_from_views.orientation * view.right).z) < 1e-12);
      REQUIRE(std::abs(std::remainder(std::atan2(forward.y, forward.x) - north_rad - look.heading_rad(),
                                      2.0 * std::numbers::pi)) < 1e-9);
    }
  }
}

TEST_CASE("an orbit about a person who is thrown stays above the road and does not turn about as he tumbles") {
  Snapshot world = world_with_others();
  Participant& walker = world.participants[1];
  walker.model = *find_vehicle_model("pedestrian");
  const Shot shot{.from_s = 0.0, .to_s = 1.0, .participant = "5", .distance_m = 6.0, .pitch_rad = 5.0 * radians};
  const auto path = camera_path(shot, frames_per_second);
  REQUIRE(path.has_value());
  const auto pivot = find_pivot(shot, world, Vec3(0.0), *path, {});
  REQUIRE(pivot.has_value());
  const Vec3 eye_in_views_m = views_at(shot, *pivot, path->front(), 320, 180).views[0].projection.eye_m;
  for (double tumbled = 0.0; tumbled <= 170.0; tumbled += 5.0) {
    CAPTURE(tumbled);
    walker.world_from_vehicle = {{3200.0, -2000.0, 35.0}, orientation_from_angles(1.0, tumbled * radians, 0.0)};
    if (tumbled >= 90.0) walker.world_from_vehicle.position_m.z += 1.75;  // His feet are up.
    const RigidTransform views = viewpoint_at(shot, *pivot, world, {}).world_from_views;
    CHECK((views * eye_in_views_m).z > 35.15);
    CHECK(heading_rad(views.orientation) == doctest::Approx(1.0));
  }
}

TEST_CASE("a shot through a cyclist's eyes goes with the rider once he has left his bicycle") {
  Snapshot world = world_with_others();
  world.participants[1].model = *find_vehicle_model("bicycle");
  const Shot shot{.from_s = 0.0, .to_s = 1.0, .participant = "5"};
  const auto pivot = find_pivot(shot, world, Vec3(0.0), {}, {});
  REQUIRE(pivot.has_value());
  const auto eye_m = [&] { return viewpoint_at(shot, *pivot, world, {}).world_from_views * pivot->in_views_m; };
  const auto eye_of = [](const Participant& one) {
    return one.world_from_vehicle * scenery::eye_in(vehicle_models()[one.model]);
  };
  CHECK(glm::distance(eye_m(), eye_of(world.participants[1])) < 1e-9);
  Participant rider;
  rider.id = rider_of(5);
  rider.model = *find_vehicle_model("pedestrian");
  rider.world_from_vehicle = {{3210.0, -2001.0, 36.0}, orientation_from_angles(1.0, 1.2, 0.3)};
  world.participants.push_back(rider);
  CHECK(glm::distance(eye_m(), eye_of(rider)) < 1e-9);
  CHECK(viewpoint_at(shot, *pivot, world, {}).inside == rider.id);
}

TEST_CASE("with the eyes of the driver a camera sees what a screen in front of them shows") {
  const Snapshot world = world_with_others();
  const Vec3 eye_m(1.35, 0.37, 1.17);
  Shot shot{.from_s = 0.0, .to_s = 1.0};
  shot.field_of_view_rad = 2.0 * std::atan(0.5);
  const auto pivot = find_pivot(shot, world, eye_m, {}, {});
  REQUIRE(pivot.has_value());
  const auto viewpoint = viewpoint_at(shot, *pivot, world, {}), screen_viewpoint = frame::driver_viewpoint(world);
  CHECK(viewpoint.inside == screen_viewpoint.inside);
  CHECK(viewpoint.world_from_views.position_m == screen_viewpoint.world_from_views.position_m);
  CHECK(viewpoint.world_from_views.orientation == screen_viewpoint.world_from_views.orientation);
  const auto view = views_at(shot, *pivot, {}, 160, 120).views[0];
  const auto screen = instant::off_axis_view(
      {eye_m + Vec3(0.8, 0.4, -0.3), eye_m + Vec3(0.8, -0.4, -0.3), eye_m + Vec3(0.8, 0.4, 0.3)}, eye_m);
  REQUIRE(screen.has_value());
  for (int column = 0; column < 4; ++column)
    CHECK(glm::length(view.projection.clip_from_eye_relative[column] - screen->clip_from_eye_relative[column]) < 1e-12);
}

TEST_CASE("a shot means the driver, the nearest, a name, a number or a model, and waits for one who is gone") {
  Snapshot world = world_with_others();
  const logging::ParticipantNames names{{3, "ego"}, {5, "crosser"}, {8, "ambulance"}, {9, "3"}, {77, "not yet there"}};
  Shot shot{.from_s = 1.5, .to_s = 2.0};
  const auto found = [&](const char* name, const logging::ParticipantNames& known) {
    shot.participant = name;
    const auto pivot = find_pivot(shot, world, Vec3(1.0), {}, known);
    return pivot ? *pivot->participant : 0;
  };
  CHECK(found("driver", names) == 3);
  CHECK(found("nearest", names) == 8);
  CHECK(found("crosser", names) == 5);
  CHECK(found("ambulance", {}) == 9);
  CHECK(found("ambulance", names) == 8);  // A name goes before a model's,
  CHECK(found("3", names) == 9);          // and before a number.
  CHECK(found("5", names) == 5);
  CHECK(found("not yet there", names) == 0);
  shot.participant = "tram";
  shot.where = "shots.toml, shot 2";
  const auto nobody = find_pivot(shot, world, Vec3(0.0), {}, names);
  REQUIRE_FALSE(nobody.has_value());
  for (const char* word : {"shots.toml, shot 2", "tram", "1.5 s", "5 crosser (ambulance)", "8 ambulance (lorry)"}) {
    CAPTURE(word);
    CHECK(describe(nobody.error()).find(word) != std::string::npos);
  }
  const Pivot pivot{5, Vec3(0.0)};
  const auto before = viewpoint_at(shot, pivot, world, {});
  std::erase_if(world.participants, [](const Participant& other) { return other.id == 5; });
  CHECK(viewpoint_at(shot, pivot, world, before).world_from_views.position_m == before.world_from_views.position_m);
}

TEST_CASE(
    "with bearings of the gaze a camera looks where the driver's logged head looked, and with others straight on") {
  Snapshot world = world_with_others();
  world.driver_car.gaze_heading_rad = 0.6;
  world.driver_car.head.from_rest_m = Vec3(0.1, -0.05, 0.02);
  const Vec3 eye_m(1.35, 0.37, 1.17);
  Shot shot{.from_s = 0.0, .to_s = 1.0, .bearings = Bearings::gaze};
  const auto seen = [&](const Participant& by, const Vec3& at_m) {
    const auto pivot = find_pivot(shot, world, eye_m, {}, {});
    REQUIRE(pivot.has_value());
    const auto from = viewpoint_at(shot, *pivot, world, {}).world_from_views;
    CHECK(glm::length(from * pivot->in_views_m - by.world_from_vehicle * at_m) < 1e-9);
    return inverse(by.world_from_vehicle).orientation * (from.orientation * Vec3(1, 0, 0));
  };
  const Vec3 ahead = seen(world.participants[0], eye_m + world.driver_car.head.from_rest_m);
  CHECK(glm::length(ahead - Vec3(std::cos(0.6), std::sin(0.6), 0.0)) < 1e-9);
  shot.participant = "8";
  const Participant& lorry = world.participants[2];
  CHECK(glm::length(seen(lorry, scenery::eye_in(vehicle_models()[lorry.model])) - Vec3(1, 0, 0)) < 1e-9);
  CHECK(refusal_of("[[shot]]\nfrom_s = 0.0\nto_s = 1.0\ndistance_m = 5.0\nbearings = \"gaze\"\n").find("gaze") !=
        std::string::npos);
}

TEST_CASE("a camera that would go below the road is refused") {
  Shot shot{.from_s = 0.0, .to_s = 1.0, .distance_m = 8.0, .pitch_rad = 4.0 * radians};
  const auto path = camera_path(shot, frames_per_second);
  REQUIRE(path.has_value());
  const auto pivot = find_pivot(shot, world_with_others(), Vec3(0.0), *path, {});
  REQUIRE_FALSE(pivot.has_value());
  CHECK(describe(pivot.error()).find("below the road") != std::string::npos);
}

TEST_CASE("a script is read with its turns and its places") {
  const auto script = read_script(
      "[[shot]]\nfrom_s = 1\nto_s = 5.5\nparticipant = \"lorry\"\ndistance_m = 9\nheading_deg = 90\n"
      "field_of_view_deg = 40\ninterior = true\n[[shot.turn]]\nuntil_s = 3\npitch_deg = -10\nsigma = 1\n"
      "[[shot.turn]]\nheading_deg = 180\n\n"
      "[[shot]]\nfrom_s = 0\nto_s = 2\nplace = { x_m = 1.0, y_m = -2, z_m = 3 }\n",
      "shots.toml");
  REQUIRE(script.has_value());
  REQUIRE(script->shots.size() == 2);
  const Shot& first = script->shots[0];
  CHECK(first.participant == "lorry");
  CHECK(first.to_s == 5.5);
  CHECK(first.distance_m == 9.0);
  CHECK(first.interior);
  CHECK(first.field_of_view_rad == doctest::Approx(40.0 * radians));
  REQUIRE(first.turns.size() == 2);
  // Members that a turn does not name stay unchanged, and the last one takes the rest of the shot.
  CHECK(first.turns[0].heading_rad == doctest::Approx(90.0 * radians));
  CHECK(first.turns[1].pitch_rad == doctest::Approx(-10.0 * radians));
  CHECK(first.turns[1].until_s == 5.5);
  CHECK(*script->shots[1].place_m == Vec3(1.0, -2.0, 3.0));
  CHECK(script->shots[1].bearings == Bearings::world);
}

TEST_CASE("a film says how far it is and how long the rest will take") {
  CHECK(progress_text({.frames = 0, .planned = 4}, 1.0) == "0 of 4 frames");
  CHECK(progress_text({.frames = 1, .planned = 4}, 20.0) == "1 of 4 frames, 60 s left");
  CHECK(progress_text({.frames = 1, .planned = 4, .share_of_next = 0.5}, 360.0) ==
        "1 of 4 frames and 50 % of the next, 10 min left");
  CHECK(progress_text({.frames = 2, .planned = 4, .kept = 2}, 1.0) == "2 of 4 frames");
  CHECK(progress_text({.frames = 3, .planned = 4, .kept = 2}, 20.0) == "3 of 4 frames, 20 s left");
  // Half of the next was kept too: progress since is a quarter of a frame in 20 s.
  CHECK(progress_text({.frames = 2, .planned = 4, .kept = 2, .share_of_next = 0.75, .kept_of_next = 0.5}, 16.0) ==
        "2 of 4 frames and 75 % of the next, 80 s left");
  CHECK(progress_text({.frames = 0, .planned = 4, .bad_samples = 3}, 1.0) ==
        "0 of 4 frames, 3 samples with NaN or infinite light");
  CHECK(progress_text({.frames = 4, .planned = 4, .encoding = true}, 20.0) ==
        "all 4 pictures are drawn; ffmpeg makes the film of them");
}

TEST_CASE("a lens opens as photographers reckon and is sharp where it is told or where the camera looks") {
  const auto script = read_script(
      "[[shot]]\nfrom_s = 1\nto_s = 5\ndistance_m = 9\nf_number = 2\nshutter_deg = 180\n"
      "field_of_view_deg = 39.5978\n[[shot]]\nfrom_s = 1\nto_s = 5\nf_number = 4\n"
      "focus_m = 3.5\n[[shot]]\nfrom_s = 1\nto_s = 5\n",
      "shots.toml");
  REQUIRE(script.has_value());
  // 39.6 degrees is the view of 50 mm across 36 mm; at f/2 it opens 25 mm.
  CHECK(lens_radius_m(script->shots[0]) == relative(0.0125, 1e-4));
  CHECK(script->shots[0].focus_m == 9.0);
  CHECK(script->shots[0].shutter_rad == doctest::Approx(std::numbers::pi));
  CHECK(script->shots[2].shutter_rad == 0.0);
  CHECK(script->shots[1].focus_m == 3.5);
  CHECK(lens_radius_m(script->shots[2]) == 0.0);
}

TEST_CASE("the example in the description of the format is a script whose cameras have a way") {
  const std::string text = shipped_text("sim-client/film/FILM.md");
  const auto begin = text.find("```toml\n") + 8;
  REQUIRE(begin < text.size());
  const auto script = read_script(text.substr(begin, text.find("```", begin) - begin), "FILM.md");
  REQUIRE(script.has_value());
  const auto plan = plan_film(*script, frames_per_second, {0.0, 9.0});
  REQUIRE(plan.has_value());
  CHECK(plan->frames.size() == 325);
}

TEST_CASE("a wrong script is refused with one message that names the line and the remedy") {
  const std::string shot = "[[shot]]\nfrom_s = 1\nto_s = 5\n";
  struct Wrong {
    std::string text;
    int line;
    std::string remedy;
  };
  const std::vector<Wrong> wrong = {
      {"", 1, "add a [[shot]]"},
      {"shot = 3", 1, "write [[shot]]"},
      {"[[shot]\n", 1, "correct the TOML"},
      {"\n[[shot]]\nfrom_s = 1\n", 2, "add to_s"},
      {"[[shot]]\nfrom_s = 1\nto_s = 1\n", 3, "later than from_s"},
      {"[[shot]]\nfrom_s = nan\nto_s = 1\n", 2, "give a number from 0"},
      {"[[shot]]\nfrom_s = 1\nto_s = inf\n", 3, "give a number from 0"},
      {"[[shot]]\nfrom_s = \"now\"\nto_s = 2\n", 2, "give a number from 0"},
      {shot + "participant = 7\n", 4, "put it in quotes"},
      {shot + "colour = \"red\"\n", 4, "FILM.md"},
      {shot + "distance_m = -1\n", 4, "give a number from 0"},
      {shot + "pitch_deg = 91\n", 4, "give a number from -90 to 90"},
      {shot + "field_of_view_deg = 180\n", 4, "give a number from 1 to 150"},
      {shot + "f_number = 0\n", 4, "give a number from 0.5 to 128"},
      {shot + "focus_m = 3\n", 4, "add f_number"},
      {shot + "shutter_deg = 361\n", 4, "give a number from 0 to 360"},
      {shot + "bearings = \"north\"\n", 4, "choose one of: vehicle, world"},
      {shot + "place = 3\n", 4, "write { x_m"},
      {shot + "place = { x_m = 1, y_m = 2 }\n", 4, "add z_m"},
      {shot + "place = { x_m = 1, y_m = 2, z_m = 3 }\nbearings = \"vehicle\"\n", 5, "leave bearings out"},
      {shot + "place = { x_m = 1, y_m = 2, z_m = 3 }\nparticipant = \"nearest\"\n", 5, "leave one of them out"},
      {shot + "[[shot.turn]]\nsigma = 1.5\n", 5, "give a number from -1 to 1"},
      {shot + "[[shot.turn]]\nuntil_s = 6\n", 5, "at most the shot's to_s"},
      {shot + "[[shot.turn]]\n[[shot.turn]]\n", 5, "later than"},
  };
  for (const Wrong& script : wrong) {
    const std::string message = refusal_of(script.text);
    CAPTURE(script.text);
    CAPTURE(message);
    CHECK(message.find(fmt::format("shots.toml:{}:", script.line)) == 0);
    CHECK(message.find(script.remedy) != std::string::npos);
  }
  std::string many;
  for (std::size_t n = 0; n <= most_shots; ++n) many += shot;
  CHECK(refusal_of(many).find("more than 1000 shots") != std::string::npos);
}

TEST_CASE("a film shows its session at even steps and slow motion at shorter ones and nothing beyond the session") {
  const auto plan = plan_film(default_script(2.0, 13.01, frames_per_second), frames_per_second, {2.0, 13.01});
  REQUIRE(plan.has_value());
  REQUIRE(plan->script.shots.size() == 3);
  REQUIRE(plan->frames.size() == 275);
  for (std::size_t n = 0; n < plan->frames.size(); ++n) {
    CHECK(plan->frames[n].number == n + 1);
    CHECK(std::abs(plan->frames[n].instant_s - (2.0 + static_cast<double>(n) / frames_per_second)) < 1e-9);
  }
  const auto brief = plan_film(default_script(0.0, 0.1, frames_per_second), frames_per_second, {0.0, 0.1});
  REQUIRE(brief.has_value());
  CHECK(brief->script.shots.size() == 1);
  const auto slow =
      plan_film({{{.from_s = 1.0, .to_s = 2.0, .speed = 0.25, .turns = {{1.5, 1.0}}}}}, frames_per_second, {0.0, 8.0});
  REQUIRE(slow.has_value());
  REQUIRE(slow->frames.size() == 100);
  CHECK(slow->frames[1].instant_s == doctest::Approx(1.01));
  CHECK(slow->paths[0][25].heading_rad() == doctest::Approx(0.5));
  CHECK_FALSE(plan_film({{{.from_s = 0.0, .to_s = 8.0, .speed = 0.01}}}, 1e4, {0.0, 8.0}).has_value());
  const auto beyond = plan_film({{{.from_s = 1.0, .to_s = 9.0, .where = "shot 4"}}}, frames_per_second, {0.0, 8.0});
  REQUIRE_FALSE(beyond.has_value());
  CHECK(describe(beyond.error()).find("shot 4: it shows 1 to 9 s, and the session lasts from 0.00 to 8.00 s") == 0);
}

TEST_CASE("layers are named by a list and what is no layer is refused with those there are") {
  std::set<Layer> layers;
  CHECK(read_layers("normal,depth", layers) == "");
  CHECK(layers == std::set<Layer>{Layer::depth, Layer::normal});
  CHECK(layers_text(layers) == "depth,normal");
  CHECK(read_layers("all", layers) == "");
  CHECK(read_layers(layers_text(layers), layers) == "");
  CHECK(layers.size() == 7);
  for (const char* wrong : {"", "depth,", "dept", "depth normal", ",", "DEPTH"}) {
    CAPTURE(wrong);
    CHECK(read_layers(wrong, layers).find("is no layer; write all, or some of depth,") != std::string::npos);
  }
}

TEST_CASE("a picture's layers are its pixels' and its header says where the camera stood and how bright white is") {
  raytrace::TracedPicture traced(2, 1);
  traced.pixels[0] = {.radiance = {0.5f, 0.25f, 0.125f},
                      .variance = 0.01f,
                      .normal = {0.0f, -1.0f, 0.5f},
                      .albedo = {0.1f, 0.2f, 0.3f},
                      .depth_m = 12.0f,
                      .object = 0x80000001u,
                      .participant = 7,
                      .motion_px = {3.5f, -1.25f}};
  FrameFacts facts{.simulated_time_s = 2.5, .ev100 = 12.0};
  facts.view.projection = instant::symmetric_view({0.0, 0.0, 1.2}, 0.3, -0.1, 1.0, 0.6);
  facts.view.world_from_car = {{4000.0, -300.0, 2.0}, orientation_from_angles(2.0, 0.02, 0.01)};
  const exr::Picture picture = exr_picture(
      traced, facts, {.frame = 9}, ExrNumbers::half_precision,
      {Layer::depth, Layer::object, Layer::participant, Layer::normal, Layer::albedo, Layer::motion, Layer::variance});
  const double scale = 8000.0 / (1.2 * std::exp2(12.0));
  CHECK(picture.white_luminance_cdpm2 == doctest::Approx(1.2 * std::exp2(12.0)));
  const auto value = [&](const std::string& name, std::size_t pixel) -> double {
    for (const exr::Channel& channel : picture.channels)
      if (channel.name == name)
        return std::visit([&](const auto& values) { return static_cast<double>(values[pixel]); }, channel.values);
    FAIL("no channel " << name);
    return 0.0;
  };
  CHECK(value("R", 0) == doctest::Approx(0.5 * scale));
  CHECK(value("B", 0) == doctest::Approx(0.125 * scale));
  CHECK(value("variance", 0) == doctest::Approx(0.01 * scale * scale));
  CHECK(value("normal.Y", 0) == -1.0);
  CHECK(value("albedo.G", 0) == doctest::Approx(0.2));
  CHECK(value("object", 0) == 0x80000001u);
  CHECK(value("participant", 0) == 7);
  CHECK(value("motion.X", 0) == 3.5);
  CHECK(value("motion.Y", 0) == -1.25);
  CHECK(std::get<std::string>(picture.attributes.at("septet.motion")).find("pixels to the next frame") == 0);
  CHECK(value("Z", 0) == 12.0);
  CHECK(std::isinf(value("Z", 1)));
  CHECK(std::get<std::string>(picture.attributes.at("septet.seed")) == "9");
  CHECK(std::get<double>(picture.attributes.at("septet.tick")) == 300.0);
  // The middle of the camera's view lies ahead of it, and its right to its right.
  const Vec3 eye_m = instant::world_eye(facts.view);
  const Vec3 ahead_m = eye_m + 5.0 * (facts.view.world_from_car.orientation * -facts.view.projection.back),
             right_m = ahead_m + facts.view.world_from_car.orientation * facts.view.projection.right;
  CHECK(glm::distance(picture.camera_from_world * glm::dvec4(ahead_m, 1.0), glm::dvec4(0, 0, 5, 1)) < 1e-9);
  CHECK(glm::distance(picture.camera_from_world * glm::dvec4(right_m, 1.0), glm::dvec4(1, 0, 5, 1)) < 1e-9);
  CHECK(picture.screen_width == doctest::Approx(2.0 * std::tan(0.5)));
}

TEST_CASE("a picture that is there already counts where it is whole and of the film's size") {
  const TemporaryFolder place;
  const auto folder = FilmFolder::open(place / "film", {{"size", "4x3"}}, false);
  REQUIRE(folder.has_value());
  const auto has = [&](std::uint64_t number, std::uint32_t width_px, std::uint32_t height_px) {
    FilmOptions options;
    options.width_px = width_px, options.height_px = height_px;
    return folder->has(number, options);
  };
  CHECK_FALSE(has(0, 4, 3));
  REQUIRE(image::write_png(folder->picture(0), image::Image(4, 3, {1, 2, 3})).has_value());
  CHECK(has(0, 4, 3));
  CHECK_FALSE(has(0, 4, 4));
  CHECK_FALSE(has(0, 5, 3));
  CHECK_FALSE(has(1, 4, 3));
  std::filesystem::resize_file(folder->picture(0), 20);
  CHECK_FALSE(has(0, 4, 3));
}

}  // namespace septet::film
