#include "engine/instant/participants.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/instant/headlight_beam.hpp"
#include "engine/math/pose_keys.hpp"
#include "engine/scene/keyed_part.hpp"
#include "engine/world/limbs.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/relative.hpp"

namespace septet::instant {
namespace {

using scene::PartRole;

std::vector<MeshSummary> summaries(const scene::ResolvedScene& scene) {
  std::vector<MeshSummary> result;
  for (const scene::SurfaceMesh& mesh : scene.meshes)
    result.push_back({{mesh.bounds_min_m, mesh.bounds_max_m}, glm::vec3(1.0f)});
  return result;
}

float in_the_open(const RigidTransform&) { return 1.0f; }

}  // namespace

TEST_CASE("each lamp of a traffic light shines by its own bit") {
  Lamps lamps;
  lamps.set(Lamp::signal_red, true);
  CHECK(shining(PartRole::signal_red, lamps, 0.0, 0.0) == 1.0f);
  CHECK(shining(PartRole::signal_amber, lamps, 0.0, 0.0) == 0.0f);
  CHECK(shining(PartRole::signal_green, lamps, 0.0, 0.0) == 0.0f);
  lamps = {};
  lamps.set(Lamp::signal_green, true);
  CHECK(shining(PartRole::signal_green, lamps, 0.0, 0.0) == 1.0f);
  CHECK(shining(PartRole::signal_red, lamps, 0.0, 0.0) == 0.0f);
}

TEST_CASE("front wheels steer and every wheel rolls forward and lifts") {
  DrawnParticipant car;
  car.front_steer_rad = 0.2;
  car.wheel_spin_rad = 0.5;
  car.wheel_lift_m = {0.03, 0.0, 0.0, -0.02};
  scene::Instance wheel;
  wheel.world_from_object.position_m = {2.7, 0.8, 0.3};
  wheel.role = PartRole::wheel_front_left;
  const RigidTransform front = vehicle_from_part(wheel, car);
  CHECK(front.position_m.z == doctest::Approx(0.33));
  CHECK(glm::length(front.orientation * Vec3(0, 1, 0) - Vec3(-std::sin(0.2), std::cos(0.2), 0)) < 1e-12);
  wheel.role = PartRole::wheel_rear_right;
  const RigidTransform rear = vehicle_from_part(wheel, car);
  CHECK(rear.position_m.z == doctest::Approx(0.28));
  // The wheel's top moves forward.
  CHECK((rear.orientation * Vec3(0, 0, 1)).x == doctest::Approx(std::sin(0.5)));
}

TEST_CASE("a beacon flashes twice in its half of every half second and not when it is off") {
  Lamps on;
  on.set(Lamp::beacon, true);
  for (const double y_m : {0.4, -0.4}) {
    double lit_s = 0.0;
    int edges = 0;
    bool before = false;
    for (int i = 0; i < 1000; ++i) {
      const float now = shining(PartRole::beacon, on, 7.0 + i * 0.001, y_m);
      lit_s += 0.001 * now;
      edges += now > 0.5f && !before;
      before = now > 0.5f;
      CHECK(shining(PartRole::beacon, {}, 7.0 + i * 0.001, y_m) == 0.0f);
    }
    CHECK(edges == 4);
    CHECK(lit_s == relative(0.24, 0.02));
  }
  CHECK(shining(PartRole::beacon, on, 0.03, 0.4) == 1.0f);
  CHECK(shining(PartRole::beacon, on, 0.03, -0.4) == 0.0f);
}

TEST_CASE("a film of 25 pictures a second has all of a beacon's light whenever its first picture is taken") {
  Lamps on;
  on.set(Lamp::beacon, true);
  for (int shift = 0; shift < 40; ++shift) {
    double lit_s = 0.0;
    for (int picture = 0; picture < 25; ++picture)
      lit_s += 0.04 * shining(PartRole::beacon, on, 3.0 + 0.001 * shift + 0.04 * picture, 0.4);
    CHECK(lit_s == relative(0.24, 1e-4));
  }
}

namespace {

/// A walker on a circle (curvature 0: a straight line) at an even speed.
struct Walk {
  double speed_mps = 1.4, curvature_1pm = 0.0;

  double stride() const { return speed_mps / strides_hz(speed_mps); }
  /// Pose of his left or right foot in the world at a phase: he goes on by a stride each turn of it.
  RigidTransform world_from_foot(bool left, double phase_rad) const {
    const double way_m = phase_rad / (2.0 * std::numbers::pi) * stride();
    const CurvePlace place = beside_curve(curvature_1pm, way_m, 0.0);
    Participant person;
    person.model = *find_vehicle_model("pedestrian");
    person.world_from_vehicle = {{place.x_m, place.y_m, 0.0}, orientation_from_angles(place.turn_rad, 0.0, 0.0)};
    person.velocity_mps = person.world_from_vehicle.orientation * Vec3(speed_mps, 0.0, 0.0);
    person.angular_velocity_radps.z = curvature_1pm * speed_mps;
    person.wheel_spin_rad = std::fmod(phase_rad, 2.0 * std::numbers::pi);
    person.wheel_spin_radps = 2.0 * std::numbers::pi * strides_hz(speed_mps);
    scene::Instance foot;
    foot.world_from_object.position_m = {0.1, left ? 0.09 : -0.09, hip_height_m};
    foot.role = left ? PartRole::foot_left : PartRole::foot_right;
    return person.world_from_vehicle * vehicle_from_part(foot, drawn_participant(person, 0));
  }
};

const Vec3 heel_m(-heel_behind_m, 0.0, -ankle_height_m), toe_m(toe_ahead_m, 0.0, -ankle_height_m);

}  // namespace

namespace {

/// One stance of a foot: from the first to the last picture in which a point of its sole is on the ground.
struct Stance {
  double slide_m = 0.0, deepest_m = 0.0, highest_ankle_m = 0.0, lowest_ankle_m = 1.0;
  double on_ground = 0.0, flat = 0.0;  ///< Shares of the cycle.
};

Stance stance_of(const Walk& walk, bool left) {
  constexpr double turn = 2.0 * std::numbers::pi;
  constexpr int steps = 2000;
  Stance stance;
  for (int i = 0; i < steps; ++i) {
    const double phase = turn * (10.0 + double(i) / steps), next = phase + turn / steps;
    const RigidTransform now = walk.world_from_foot(left, phase), then = walk.world_from_foot(left, next);
    const bool heel_down = (now * heel_m).z < 0.002, toe_down = (now * toe_m).z < 0.002;
    stance.deepest_m = std::min({stance.deepest_m, (now * heel_m).z, (now * toe_m).z});
    if (!heel_down && !toe_down) continue;
    stance.on_ground += 1.0 / steps;
    const Vec3 point = heel_down ? heel_m : toe_m;
    stance.slide_m += glm::length(Vec2(then * point - now * point));
    if (!heel_down || !toe_down) continue;
    stance.flat += 1.0 / steps;
    stance.highest_ankle_m = std::max(stance.highest_ankle_m, now.position_m.z);
    stance.lowest_ankle_m = std::min(stance.lowest_ankle_m, now.position_m.z);
  }
  return stance;
}

}  // namespace

TEST_CASE(
    "the foot on the ground stays where it is for the whole stance, on turns as well, and the other is in the air") {
  for (const double speed_mps : {0.5, 0.8, 1.0, 1.4, 1.7, 2.0, 3.5})
    for (const double radius_m : {0.0, 10.0, 3.0, -1.5})
      for (const bool left : {true, false}) {
        CAPTURE(speed_mps);
        CAPTURE(radius_m);
        const Stance stance = stance_of({speed_mps, radius_m == 0.0 ? 0.0 : 1.0 / radius_m}, left);
        CHECK(stance.slide_m < 0.01);
        CHECK(stance.flat > 0.18);
        CHECK(stance.highest_ankle_m < ankle_height_m + 0.01);
        CHECK(stance.lowest_ankle_m > ankle_height_m - 0.01);
        CHECK(stance.deepest_m > -0.005);
        // Walkers have a foot on the ground at every instant, runners fly.
        CHECK(stance.on_ground < 0.64);
        if (speed_mps < 1.8) CHECK(stance.on_ground > 0.5);
        if (speed_mps > 3.0) CHECK(stance.on_ground < 0.42);
      }
}

TEST_CASE("steps a minute are those of people who walk and run") {
  CHECK(120.0 * strides_hz(1.4) == relative(113.7, 0.02));
  CHECK(120.0 * strides_hz(1.0) == relative(96.1, 0.02));
  CHECK(120.0 * strides_hz(1.8) == relative(128.9, 0.02));
  for (const double speed_mps : {0.3, 1.4, 3.5})
    CHECK(stride_m(strides_hz(speed_mps)) * strides_hz(speed_mps) == relative(speed_mps, 1e-12));
}

TEST_CASE("who walks bends his knees, rises and falls by some centimetres, and stands still when he stands") {
  DrawnParticipant walker;
  walker.speed_mps = 1.4;
  scene::Instance part;
  part.world_from_object.position_m = {0.1, 0.09, hip_height_m};
  const auto pose = [&](PartRole role, double phase_rad) {
    part.role = role;
    walker.wheel_spin_rad = phase_rad;
    return vehicle_from_part(part, walker);
  };
  double lowest_m = 2.0, highest_m = 0.0, most_bent = 0.0, least_bent = 4.0, highest_foot_m = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double phase = 2.0 * std::numbers::pi * i / 200;
    const double hips_m = pose(PartRole::trunk, phase).position_m.z;
    lowest_m = std::min(lowest_m, hips_m), highest_m = std::max(highest_m, hips_m);
    const Vec3 thigh = pose(PartRole::leg_left, phase).orientation * Vec3(0, 0, -1),
               shin = pose(PartRole::shin_left, phase).orientation * Vec3(0, 0, -1);
    CHECK(thigh.x * shin.z - thigh.z * shin.x <= 1e-9);  // No knee bends forwards.
    const double bent = std::acos(std::clamp(glm::dot(thigh, shin), -1.0, 1.0));
    most_bent = std::max(most_bent, bent), least_bent = std::min(least_bent, bent);
    highest_foot_m = std::max(highest_foot_m, pose(PartRole::foot_left, phase).position_m.z);
    // No leg is torn out of its shoe, and all is smooth.
    const RigidTransform foot = pose(PartRole::foot_left, phase), next = pose(PartRole::foot_left, phase + 0.001);
    CHECK(glm::length(foot.position_m - pose(PartRole::shin_left, phase) * Vec3(0, 0, -shin_m)) < 1e-9);
    CHECK(glm::length(next.position_m - foot.position_m) < 0.002);
  }
  CHECK(highest_m - lowest_m > 0.03);
  CHECK(highest_m - lowest_m < 0.06);
  CHECK(most_bent > 0.8);
  CHECK(most_bent < 1.4);
  CHECK(least_bent < 0.35);
  CHECK(highest_foot_m < 0.30);
  CHECK(glm::length(pose(PartRole::foot_left, 0.7).position_m -
                    pose(PartRole::foot_left, 0.7 + 2.0 * std::numbers::pi).position_m) < 1e-9);
  walker.speed_mps = 0.0;
  CHECK(glm::length(pose(PartRole::foot_left, 0.3).position_m - pose(PartRole::foot_left, 2.0).position_m) < 1e-12);
  CHECK(pose(PartRole::foot_left, 0.3).position_m.x == doctest::Approx(0.1));
  CHECK(pose(PartRole::foot_left, 0.3).position_m.z == relative(ankle_height_m, 0.02));
}

TEST_CASE("a cyclist's feet stay on the pedals all the way round") {
  DrawnParticipant cyclist;
  scene::Instance shin, crank;
  shin.world_from_object.position_m = {0.22, 0.0, 1.01};
  crank.world_from_object.position_m = {0.22 + bracket_ahead_m, 0.0, 1.01 - bracket_below_m};
  crank.role = PartRole::crank;
  for (int i = 0; i < 48; ++i) {
    cyclist.wheel_spin_rad = i * 0.13;
    const RigidTransform pedals = vehicle_from_part(crank, cyclist);
    for (const double side : {1.0, -1.0}) {
      shin.role = side > 0 ? PartRole::pedalling_shin_left : PartRole::pedalling_shin_right;
      const Vec3 foot = vehicle_from_part(shin, cyclist) * Vec3(0, 0, -shin_m);
      CHECK(glm::length(foot - pedals * Vec3(0, 0, side * crank_m)) < 1e-6);
    }
  }
  cyclist.wheel_spin_rad = 0.2;  // Forward at the top.
  CHECK((vehicle_from_part(crank, cyclist) * Vec3(0, 0, crank_m)).x > 0.22 + bracket_ahead_m);
}

TEST_CASE("only lit lamps shine and glow") {
  const ReferenceScene reference = reference_scene({{}, false, 0});
  const std::vector<MeshSummary> meshes = summaries(reference.scene);
  DrawnParticipant car = reference_car(reference, {0, 0, 0});
  const auto glows = [&] {
    return place_participants(std::span(&car, 1), reference.scene.prototypes, meshes, 0.0,
                              car.world_from_vehicle.position_m, in_the_open)
        .glows.size();
  };
  CHECK(glows() == 0);
  car.lamps.set(Lamp::brake, true);
  CHECK(glows() == 2);
  car.lamps.set(Lamp::indicator_left, true);
  CHECK(glows() == 3);
}

TEST_CASE("a car that is shown by its shadow and light alone has both and nothing to see") {
  const ReferenceScene reference = reference_scene({{}, false, 0});
  DrawnParticipant car = reference_car(reference, {0, 0, 0});
  car.lamps.set(Lamp::low_beam, true);
  car.shown = Shown::shadow_and_light;
  const PlacedParticipants placed =
      place_participants(std::span(&car, 1), reference.scene.prototypes, summaries(reference.scene), 0.0,
                         car.world_from_vehicle.position_m, in_the_open);
  CHECK_FALSE(placed.meshes.empty());
  for (const PlacedMesh& mesh : placed.meshes) CHECK_FALSE(mesh.seen);
  CHECK(placed.headlights.size() == 2);
  CHECK(placed.glows.empty());
}

TEST_CASE("a lamp glows once whatever the levels of detail and a far vehicle has no near parts") {
  const ReferenceScene reference = reference_scene({{}, false, 0});
  scene::Prototype prototype = reference.scene.prototypes.front();
  const std::size_t parts = prototype.parts.size();
  for (std::size_t i = 0; i < parts; ++i) {
    scene::Instance far = prototype.parts[i];
    prototype.parts[i].visible_to_m = far.visible_from_m = 50.0f;
    prototype.parts.push_back(far);
  }
  DrawnParticipant car;
  car.lamps.set(Lamp::brake, true);
  for (const double distance_m : {20.0, 80.0}) {
    const PlacedParticipants placed =
        place_participants(std::span(&car, 1), std::span(&prototype, 1), summaries(reference.scene), 0.0,
                           Vec3(distance_m, 0, 0), in_the_open);
    CHECK(placed.glows.size() == 2);
    CHECK(placed.meshes.size() == (distance_m > 50.0 ? parts : 2 * parts));
  }
}

TEST_CASE("a participant whose prototype has not arrived is left out") {
  DrawnParticipant car;
  car.prototype = 5;
  CHECK(place_participants(std::span(&car, 1), {}, {}, 0.0, Vec3(0.0), in_the_open).meshes.empty());
}

TEST_CASE("the steering wheel's top goes to the left where the driver steers to the left") {
  DrawnParticipant car;
  car.steering_wheel_rad = 0.4;
  scene::Instance wheel;
  wheel.role = PartRole::steering_wheel;
  const Vec3 top = vehicle_from_part(wheel, car).orientation * Vec3(0, 0, 1);
  CHECK(top.y == doctest::Approx(std::sin(0.4)));
  CHECK(top.z == doctest::Approx(std::cos(0.4)));
}

TEST_CASE("no snow lies on what drives and its beams begin at its head lamps") {
  const ReferenceScene reference = reference_scene({{}, false, 0});
  DrawnParticipant car = reference_car(reference, {0, 0, 0});
  car.lamps.set(Lamp::low_beam, true);
  const PlacedParticipants placed =
      place_participants(std::span(&car, 1), reference.scene.prototypes, summaries(reference.scene), 0.0,
                         car.world_from_vehicle.position_m, in_the_open);
  REQUIRE_FALSE(placed.meshes.empty());
  for (const PlacedMesh& mesh : placed.meshes) CHECK_FALSE(mesh.snowed_on);
  REQUIRE(placed.headlights.size() == 2);
  Vec3 low(1e9), high(-1e9);
  for (const LampGlow& glow : placed.glows) {
    if (!glow.beam) continue;
    low = glm::min(low, glow.position_m), high = glm::max(high, glow.position_m);
  }
  REQUIRE(low.x < high.x + 1e-3);
  REQUIRE(high.y - low.y > 0.5);
  for (const Headlight& light : placed.headlights) {
    CHECK(std::min(glm::length(light.position_m - low), glm::length(light.position_m - high)) < 0.2);
    CHECK(light.intensity == doctest::Approx(0.5f * beam::pair_intensity));
  }
  CHECK(std::abs(placed.headlights[0].position_m.y - placed.headlights[1].position_m.y) > 0.5);
}

TEST_CASE("two beams of a car become one as it goes away, with the same light in all and without a leap") {
  const ReferenceScene reference = reference_scene({{}, false, 0});
  const std::vector<MeshSummary> meshes = summaries(reference.scene);
  double apart_before_m = 1e9;
  for (double distance_m = 10.0; distance_m < 60.0; distance_m += 0.5) {
    DrawnParticipant car = reference_car(reference, {distance_m, 0, 0});
    car.lamps.set(Lamp::low_beam, true);
    const PlacedParticipants placed =
        place_participants(std::span(&car, 1), reference.scene.prototypes, meshes, 0.0, Vec3(0.0), in_the_open);
    CAPTURE(distance_m);
    REQUIRE(!placed.headlights.empty());
    REQUIRE(placed.headlights.size() <= 2);
    float intensity = 0.0f;
    for (const Headlight& light : placed.headlights) intensity += light.intensity;
    CHECK(intensity == doctest::Approx(beam::pair_intensity));
    const double apart_m = glm::length(placed.headlights.front().position_m - placed.headlights.back().position_m);
    CHECK(apart_m <= apart_before_m + 1e-9);
    CHECK(apart_before_m - apart_m < (apart_before_m > 1e8 ? 1e9 : 0.45));
    apart_before_m = apart_m;
    // Lamps fifteen metres before the eye and nearer are two, each at its place.
    if (distance_m < 19.0) CHECK(apart_m > 0.8);
    if (distance_m > 28.0) CHECK(apart_m == 0.0);
  }
}

TEST_CASE("a beacon lights what is around it while it flashes, in its colour, and a dark one does not") {
  ReferenceScene reference = reference_scene({{}, false, 0});
  scene::Prototype prototype = reference.scene.prototypes.front();
  std::vector<MeshSummary> meshes = summaries(reference.scene);
  MeshSummary lens;
  lens.bounds = {glm::vec3(-0.5f), glm::vec3(0.5f)};
  lens.emission = {0.7f, 3.0f, 16.0f};
  meshes.push_back(lens);
  scene::Instance beacon;
  beacon.mesh = static_cast<std::uint32_t>(meshes.size() - 1);
  beacon.role = PartRole::beacon;
  beacon.scale = {0.3f, 0.5f, 0.1f};
  beacon.world_from_object.position_m = Vec3(0.5, 0.5, 2.0);
  prototype.parts = {beacon};
  DrawnParticipant ambulance;
  ambulance.world_from_vehicle.position_m = Vec3(20.0, 0.0, 0.0);
  const auto lit = [&](double at_s) {
    return place_participants(std::span(&ambulance, 1), std::span(&prototype, 1), meshes, at_s, Vec3(0.0), in_the_open)
        .beacons;
  };
  CHECK(lit(0.03).empty());
  ambulance.lamps.set(Lamp::beacon, true);
  const std::vector<BeaconLight> flash = lit(0.03);
  REQUIRE(flash.size() == 1);
  CHECK(flash[0].intensity.b > 4.0f * flash[0].intensity.g);
  // Mean from all round of sides of 0.3 x 0.1 and 0.5 x 0.1 m².
  CHECK(flash[0].intensity.b == relative(16.0 * 0.08 * 2.0 / 3.14159, 0.01));
  CHECK(flash[0].ahead == glm::vec2(1.0f, 0.0f));
  CHECK(glm::length(flash[0].position_m - Vec3(20.5, 0.5, 2.0)) < 1e-6);
  CHECK(lit(0.4).empty());
  ambulance.shown = Shown::shadow_and_light;
  CHECK(lit(0.03).empty());
}

TEST_CASE("whoever has the main beam on sends it out beside the dipped one and whoever has not does not") {
  const ReferenceScene reference = reference_scene({{}, false, 0});
  for (const bool high : {false, true})
    for (const bool low : {false, true}) {
      DrawnParticipant car = reference_car(reference, {0, 0, 0});
      car.lamps.set(Lamp::low_beam, low);
      car.lamps.set(Lamp::high_beam, high);
      const PlacedParticipants placed =
          place_participants(std::span(&car, 1), reference.scene.prototypes, summaries(reference.scene), 0.0,
                             car.world_from_vehicle.position_m, in_the_open);
      REQUIRE(placed.headlights.size() == (low || high ? 2 : 0));
      for (const Headlight& light : placed.headlights) CHECK(light.main_beam == (high ? 1.0f : 0.0f));
    }
}

TEST_CASE("a participant is drawn where and as the snapshot has it") {
  Participant participant;
  participant.id = 12;
  participant.world_from_vehicle = {{1.0, 2.0, 3.0}, orientation_from_angles(0.4, 0.1, 0.0)};
  participant.lamps.set(Lamp::brake, true);
  participant.front_steer_rad = 0.2;
  participant.wheel_spin_rad = 0.7;
  participant.wheel_lift_m = {0.01, -0.02, 0.03, -0.04};
  const DrawnParticipant drawn = drawn_participant(participant, 5);
  CHECK(drawn.prototype == 5);
  CHECK(drawn.number == 12);
  CHECK(drawn.world_from_vehicle.position_m == participant.world_from_vehicle.position_m);
  CHECK(drawn.world_from_vehicle.orientation == participant.world_from_vehicle.orientation);
  CHECK(drawn.lamps.has(Lamp::brake));
  CHECK(drawn.front_steer_rad == 0.2);
  CHECK(drawn.wheel_spin_rad == 0.7);
  CHECK(drawn.wheel_lift_m == participant.wheel_lift_m);
}

TEST_CASE("a part with keys is placed where they are at the instant that is drawn") {
  const std::vector<PoseKey> keys{{0.0f, {0, 0, 0}}, {2.0f, {0, 0, 3}}};
  scene::Prototype lift;
  lift.parts.emplace_back().keyed = std::make_shared<const scene::KeyedPart>(scene::KeyedPart{{}, {}, keys});
  const std::vector<MeshSummary> meshes(1);
  DrawnParticipant drawn;
  drawn.world_from_vehicle.position_m = {10, 0, 0};
  for (const double time_s : {0.5, 1.0, 3.0}) {
    const auto placed = place_participants({&drawn, 1}, {&lift, 1}, meshes, time_s, {}, in_the_open);
    REQUIRE(placed.meshes.size() == 1);
    CHECK(placed.meshes[0].origin_m.z == doctest::Approx(time_s < 2.0 ? 1.5 * time_s : 1.5));
  }
}

TEST_CASE("a part that its keys leave no size is not placed") {
  PoseKey there, gone;
  gone.scale = glm::vec3(0.0f);
  std::vector<PoseKey> keys{there, there, gone, gone};
  keys[1].at_s = keys[2].at_s = 1.0f;
  keys[3].at_s = 2.0f;
  scene::Prototype pose;
  pose.parts.emplace_back().keyed = std::make_shared<const scene::KeyedPart>(scene::KeyedPart{{}, {}, keys});
  const std::vector<MeshSummary> meshes(1);
  const DrawnParticipant drawn;
  for (const double time_s : {0.5, 0.99, 1.0, 1.5, 2.5}) {
    CAPTURE(time_s);
    const auto placed = place_participants({&drawn, 1}, {&pose, 1}, meshes, time_s, {}, in_the_open);
    CHECK(placed.meshes.size() == (std::fmod(time_s, 2.0) < 1.0 ? 1 : 0));
  }
}

}  // namespace septet::instant
