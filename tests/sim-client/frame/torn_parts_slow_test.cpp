/// What was torn off a vehicle, as pixels: it is gone from it, and lies beside it in its colour and form.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/effects/debris/piece.hpp"
#include "sim-client/frame/debris_drawing.hpp"
#include "sim-client/frame/dent_drawing.hpp"
#include "tests/sim-client/frame/cockpit_view.hpp"

namespace septet::frame {
namespace {

using debris::Mount;

constexpr std::uint32_t torn_width_px = 640, torn_height_px = 400;
const Vec3 car_place_m(400.0, 300.0, 10.0);

struct Lying {
  debris::Part part;
  Mount mount;
  RigidTransform vehicle_from_part;
};

/// A red saloon from its front on the left.
image::Image picture_of(debris::Mounts torn, const std::vector<Lying>& pieces, const std::string& name) {
  Snapshot snapshot;
  snapshot.simulated_time_s = 10.0;
  Participant car{.id = 1, .model = *find_vehicle_model("saloon"), .paint = 5};
  car.world_from_vehicle.position_m = car_place_m;
  snapshot.participants = {car};
  snapshot.effects.push_back({debris::dent_effect_id, debris::dent_keyframe_kind,
                              debris::encode_dents(std::vector<debris::DentedVehicle>{{1, {}, torn}}), 0});
  const Vec3 eye_m = car_place_m + Vec3(6.6, 5.4, 2.2), to_m = car_place_m + Vec3(1.9, 0.9, 0.4) - eye_m;
  ScreenViews views;
  instant::FrameView view;
  view.projection = instant::symmetric_view(Vec3(0.0), std::atan2(to_m.y, to_m.x),
                                            std::atan2(to_m.z, std::hypot(to_m.x, to_m.y)), 0.9, 0.58);
  view.viewport = {0, 0, torn_width_px, torn_height_px};
  views.views.push_back(view);
  instant::FrameInput frame =
      client_frame(snapshot, views, {.world_from_views = {eye_m, Quat(1, 0, 0, 0)}}, vehicles_scene());
  DentDrawing dents;
  dents.show(snapshot, vehicles_scene());
  dents.add_to(frame);
  std::vector<EffectKeyframe> keyframes;
  Random random(4);
  for (const Lying& lying : pieces) {
    debris::Piece piece =
        debris::make_part(lying.part, car.world_from_vehicle * lying.vehicle_from_part, Vec3(0.0), Vec3(0.0), random);
    piece.origin = debris::PieceOrigin{1, car.model, car.paint, lying.mount};
    keyframes.push_back({debris::first_effect_id + 1 + static_cast<std::uint32_t>(keyframes.size()),
                         debris::keyframe_kind, debris::encode(debris::keyframe_of(piece)), 0});
  }
  std::vector<EffectMoment> moments;
  for (const EffectKeyframe& keyframe : keyframes) moments.push_back({.before = &keyframe});
  DebrisDrawing debris;
  frame.meshes = debris.draw(moments, 0.0, vehicles_scene()).meshes;
  rig::Screen screen;
  screen.width_px = torn_width_px;
  screen.height_px = torn_height_px;
  return drawn_picture(screen, std::move(frame), name);
}

int red_pixels(const image::Image& picture) {
  int count = 0;
  for (std::uint32_t x = 0; x < picture.width; ++x)
    for (std::uint32_t y = 0; y < picture.height; ++y) {
      const image::Color at = picture.at(x, y);
      count += at.red > 40 && at.red > 2 * at.green && at.red > 2 * at.blue;
    }
  return count;
}

const Quat straight(1, 0, 0, 0);

}  // namespace

TEST_CASE("a car that lost a door or a bumper has less of its red, and a red door or bumper lies beside it") {
  const int whole = red_pixels(picture_of(0, {}, "torn-nothing"));
  REQUIRE(whole > 10'000);
  const int without_door = red_pixels(picture_of(debris::bit_of(Mount::front_left_door), {}, "torn-door"));
  const int without_bumper = red_pixels(picture_of(debris::bit_of(Mount::front_bumper), {}, "torn-bumper"));
  CHECK(without_door < 0.92 * whole);
  CHECK(without_bumper < 0.95 * whole);
  const Lying door{debris::Part::door, Mount::front_left_door, {{2.6, 2.6, 0.3}, straight}},
      bumper{debris::Part::bumper, Mount::front_bumper, {{4.7, 0.6, 0.2}, orientation_from_angles(0.5, 0.0, 0.0)}};
  CHECK(red_pixels(picture_of(debris::bit_of(Mount::front_left_door), {door}, "torn-door-lies")) > without_door + 1500);
  CHECK(red_pixels(picture_of(debris::bit_of(Mount::front_bumper), {bumper}, "torn-bumper-lies")) >
        without_bumper + 1000);
  debris::Mounts most = 0;
  for (const Mount mount :
       {Mount::front_bumper, Mount::front_left_lamp, Mount::front_left_door, Mount::rear_left_door, Mount::windscreen})
    most |= debris::bit_of(mount);
  const Lying lamp{debris::Part::lamp, Mount::front_left_lamp, {{4.3, 2.2, 0.2}, straight}};
  CHECK(red_pixels(picture_of(most, {door, bumper, lamp}, "torn-most")) > without_door);
}

}  // namespace septet::frame
