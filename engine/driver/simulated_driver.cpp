#include "engine/driver/simulated_driver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/road/lane_geometry.hpp"
#include "engine/sight/air.hpp"
#include "engine/world/limited_sight.hpp"

namespace septet::driver {
namespace {

constexpr double look_around_interval_s = 0.05;
constexpr double all_snow_cover = 0.3;  ///< Cover from which a road counts as completely snowy.
/// On a route: a lane open for this far may be changed to, and the goal is where the car's middle stands at the end.
constexpr double room_to_change_m = 40.0, stops_past_goal_m = 5.0;
constexpr double lane_preview_m = 300.0;  ///< A lane counts as open if it is so for this far.

/// A point of the lane's centre, or of the path between two while changing.
Vec3 lane_point(const SimulatedDriver& driver, const road::RoadNetwork& network, double x_m, double ahead_m,
                double speed_mps) {
  const LaneState& lanes = driver.lanes;
  const traffic::Corridor& corridor = *driver.corridor;
  const double x = std::min(x_m + ahead_m, corridor.closed ? std::numeric_limits<double>::max() : corridor.length_m);
  const auto centre = [&](int lane) {
    return road::evaluate_lane(network, traffic::position_at(corridor, traffic::wrap_x(corridor, x), lane))
        .road.position_m;
  };
  const Vec3 here = centre(lanes.lane);
  if (lanes.phase < LanePhase::change) return here;
  const double across = place_across(lanes, speed_mps, ahead_m / std::max(speed_mps, 1.0));
  return here + across * (centre(lanes.target) - here);
}

/// A point of the intended path: in the lane, in an ambulance's tracks, or between.
Vec3 path_point(const SimulatedDriver& driver, const road::RoadNetwork& network, double x_m, double ahead_m,
                double speed_mps) {
  const Vec3 in_lane = lane_point(driver, network, x_m, ahead_m, speed_mps);
  const double share = share_of_tracks(driver.tracks, ahead_m / std::max(speed_mps, 1.0));
  if (share == 0.0) return in_lane;
  const double x = traffic::wrap_x(*driver.corridor, x_m + ahead_m);
  const traffic::CorridorPiece& piece = traffic::piece_at(*driver.corridor, x);
  const road::LanePosition along = traffic::position_at(*driver.corridor, x, driver.lanes.lane);
  const double across_m = across_at(driver.tracks, x);
  const Vec3 in_tracks =
      road::evaluate(network, {along.road, along.s_m, piece.along_s ? across_m : -across_m}).position_m;
  return in_lane + share * (in_tracks - in_lane);
}

double bearing_rad(const RigidTransform& world_from_vehicle, const Vec3& point_m) {
  const Vec3 seen = glm::conjugate(world_from_vehicle.orientation) * (point_m - world_from_vehicle.position_m);
  return std::atan2(seen.y, seen.x);
}

PathAngles see_path(const SimulatedDriver& driver, const road::RoadNetwork& network, const Participant& body,
                    const OwnPlace& own) {
  const SteeringParameters& steering = driver.parameters.steering;
  const double near_m = steering.near_distance_m, far_m = std::max(near_m, steering.far_time_s * own.speed_mps);
  return {bearing_rad(body.world_from_vehicle, path_point(driver, network, own.x_m, near_m, own.speed_mps)),
          bearing_rad(body.world_from_vehicle, path_point(driver, network, own.x_m, far_m, own.speed_mps))};
}

/// A driver who takes over in motion holds the wheel as the bend requires.
void take_the_wheel(SimulatedDriver& driver, const road::RoadNetwork& network, const OwnPlace& own) {
  const road::LanePoint lane = road::evaluate_lane(network, traffic::position_at(*driver.corridor, own.x_m, own.lane));
  const double ahead = traffic::piece_at(*driver.corridor, own.x_m).along_s ? 1.0 : -1.0;
  driver.steering.intended_rad = driver.steering.hands_rad = steady_wheel_rad(
      driver.parameters.car, own.speed_mps, ahead * lane.road.curvature_per_m, ahead * lane.road.roll_rad);
}

/// Distance over which the lane stays open, up to the preview.
double open_for_m(const road::RoadNetwork& network, const traffic::Corridor& corridor, double x_m, int lane) {
  if (lane < 1) return 0.0;
  for (double ahead_m = 0.0; ahead_m <= lane_preview_m; ahead_m += 50.0) {
    const double x = traffic::wrap_x(corridor, x_m + ahead_m);
    if ((!corridor.closed && x >= corridor.length_m) || !traffic::lane_open(network, corridor, x, lane)) return ahead_m;
  }
  return std::numeric_limits<double>::infinity();
}

/// `sight_m`: how far he sees, where something limits it.
double desired_speed_mps(const SimulatedDriver& driver, const road::RoadNetwork& network, const OwnPlace& own,
                         double snow_cover, const std::optional<double>& sight_m) {
  const SpeedParameters& speed = driver.parameters.speed;
  const double limit = road::speed_limit_mps(network, traffic::position_at(*driver.corridor, own.x_m, own.lane));
  const double unposted_mps = driver.corridor->is_route ? traffic::unposted_mps : speed.desired_speed_mps;
  const double dry = limit > 0.0 ? limit * speed.limit_factor : unposted_mps;
  const double snow = std::clamp(snow_cover / all_snow_cover, 0.0, 1.0);
  const double wish = std::min(dry * (1.0 - snow * (1.0 - speed.on_snow)),
                               std::min(driver.course.speed_mps, driver.junction.speed_mps));
  if (!sight_m) return wish;
  return std::min(
      wish, sight::stopping_speed_mps(*sight_m - speed.standstill_gap_m, speed.reaction_time_s, speed.braking_mps2));
}

/// Obstacle for the foot: the vehicle seen on the path a reaction time ago, or the end of the lane. The car's own path
/// is known at once.
std::optional<Obstacle> obstacle_ahead(const SimulatedDriver& driver, LaneScene scene) {
  scene.vehicles = driver.minded;
  if (driver.tracks.follows) return obstacle_in_tracks(driver.tracks, scene, driver.parameters.speed);
  const auto wish_mps2 = [&](const std::optional<Obstacle>& obstacle) {
    return wished_acceleration_mps2(driver.parameters.speed, scene.own.speed_mps, scene.desired_speed_mps, obstacle);
  };
  auto vehicle = obstacle_on_way(driver.lanes, scene, driver.parameters.speed);
  const auto line = line_ahead(driver.course, scene.own, driver.parameters.speed);
  if (line && wish_mps2(line) < wish_mps2(vehicle)) vehicle = line;
  if (driver.junction.crossed_at_m) {
    const double gap_m = *driver.junction.crossed_at_m - scene.own.x_m - scene.own.front_m;
    const std::optional<Obstacle> across = Obstacle{gap_m + 0.5 * driver.parameters.speed.standstill_gap_m, 0.0};
    if (wish_mps2(across) < wish_mps2(vehicle)) vehicle = across;
  }
  if (driver.junction.waits_at_m) {
    const double left_m = *driver.junction.waits_at_m - scene.own.x_m - scene.own.front_m;
    const std::optional<Obstacle> at_junction = Obstacle{left_m + driver.parameters.speed.standstill_gap_m, 0.0};
    if (wish_mps2(at_junction) < wish_mps2(vehicle)) vehicle = at_junction;
  }
  if (scene.lane_ends_in_m >= lane_preview_m) return vehicle;
  const std::optional<Obstacle> end = Obstacle{scene.lane_ends_in_m, 0.0};
  return wish_mps2(end) < wish_mps2(vehicle) ? end : vehicle;
}

/// No road in sight: hold the wheel, brake.
DriverInput stop_off_road(SimulatedDriver& driver, double dt_s) {
  driver.pedals.accelerator = 0.0;
  driver.pedals.brake = std::min(0.6, driver.pedals.brake + dt_s);
  DriverInput input;
  input.steering_wheel_rad = driver.steering.hands_rad;
  input.brake = driver.pedals.brake;
  if (driver.parameters.car.has_clutch) {
    input.selector = GearSelector::manual;
    input.clutch = 1.0;
  }
  input.hazard_lights = true;
  return input;
}

/// Goes by the route that he is told, if there is one: another corridor where it is new, or the old one ends soon.
void follow_route(SimulatedDriver& driver, const road::RoadNetwork& network, const Snapshot& snapshot) {
  const bool is_new = learn_route(driver.route, network, snapshot);
  if (is_new && !driver.route.leads()) driver.corridor.reset();
  if (!driver.route.leads()) return;
  const Participant* body = find_participant(snapshot, snapshot.driver_car.participant);
  const auto x_m = [&] {
    const auto own = see_own_place(network, *driver.corridor, snapshot, driver.place);
    return own ? own->x_m : driver.corridor->pieces.front().x_m;
  };
  const bool goes_on = driver.corridor && driver.corridor->is_route && !is_new;
  if (!body || (goes_on && !needs_more(driver.route, *driver.corridor, x_m()))) return;
  const traffic::Corridor* before = driver.corridor ? &*driver.corridor : nullptr;
  auto corridor = route_corridor(driver.route, network, snapshot, before);
  if (!corridor) return;
  const bool continues = before && before->is_route;
  driver.corridor = std::move(corridor);
  CourseState course = read_course(network, *driver.corridor, driver.views);
  if (continues) {
    driver.course.lines = std::move(course.lines);
    driver.course.turns = std::move(course.turns);
    return;
  }
  driver.course = std::move(course);
  driver.lanes = {};
  driver.vehicles.clear();
  driver.foot_eyes = {};
  driver.minded.clear();
}

}  // namespace

void learn_views(SimulatedDriver& driver, const road::RoadNetwork& network, std::vector<traffic::ApproachView> views) {
  driver.views = std::move(views);
  if (driver.corridor) driver.course.lines = read_course(network, *driver.corridor, driver.views).lines;
}

DriverInput advance(SimulatedDriver& driver, const road::RoadNetwork& network, const Snapshot& snapshot, double dt_s) {
  driver.now_s += dt_s;
  ++driver.sequence;
  if (snapshot.game && !std::exchange(driver.plays, true)) driver.parameters = playing(driver.parameters);
  follow_route(driver, network, snapshot);
  if (!driver.corridor) {
    driver.corridor = find_corridor(network, snapshot);
    if (driver.corridor) driver.course = read_course(network, *driver.corridor, driver.views);
  }
  const Participant* body = find_participant(snapshot, snapshot.driver_car.participant);
  const auto own = driver.corridor ? see_own_place(network, *driver.corridor, snapshot, driver.place) : std::nullopt;
  if (!own || !body) {
    driver.corridor.reset();
    driver.place.reset();
    driver.lanes = {};
    driver.tracks = {};
    driver.known = {};
    driver.junction = {};
    DriverInput input = stop_off_road(driver, dt_s);
    input.sequence = driver.sequence;
    return input;
  }
  driver.place = own->position;
  if (!driver.steering.has_seen) take_the_wheel(driver, network, *own);
  if (driver.lanes.lane == 0) driver.lanes.lane = driver.lanes.target = own->lane;
  if (driver.now_s >= driver.next_look_around_s) {
    look_around(driver.known, snapshot, look_around_interval_s);
    auto seen = see_vehicles(network, *driver.corridor, driver.known.bodies, body->id, *own);
    see_accelerations(driver.vehicles, look_around_interval_s, seen);
    driver.vehicles = std::move(seen);
    const double reaction_s = driver.parameters.speed.reaction_time_s;
    driver.minded = remembered_vehicles(driver.foot_eyes.through(driver.now_s, driver.vehicles, reaction_s), reaction_s,
                                        own->speed_mps);
    driver.next_look_around_s = driver.now_s + look_around_interval_s;
    look_at_course(driver.course, driver.parameters, network, *driver.corridor, snapshot, driver.known.bodies, *own,
                   driver.now_s, look_around_interval_s, driver.eyes_random);
    if (driver.corridor->is_route)
      look_at_junction(driver.junction, driver.route, *driver.corridor, driver.parameters.course, network,
                       driver.known.bodies, body->id, *own, driver.vehicles, driver.course.judgement.value,
                       look_around_interval_s);
    driver.junction.crossed_at_m =
        driver.corridor->is_route && is_at_junction(driver.route, *driver.corridor, own->x_m)
            ? crossed_at_m(*driver.corridor, network, driver.known.bodies, body->id, *own, own->lane)
            : std::nullopt;
    const LaneChoiceParameters& lanes = driver.parameters.lanes;
    if (driver.lanes.phase == LanePhase::keep && lanes.in_tracks_within_m > 0.0)
      look_at_tracks(driver.tracks, *driver.corridor, *own, driver.vehicles, lanes.in_tracks_within_m,
                     lanes.duration_s);
  }

  const DriverParameters& parameters = driver.parameters;
  LaneScene scene{.own = *own, .vehicles = driver.vehicles};
  scene.desired_speed_mps =
      desired_speed_mps(driver, network, *own, snapshot.environment.snow_cover, limited_sight_m(snapshot, body->id));
  scene.grows_to_the_right = lanes_grow_to_the_right(traffic::piece_at(*driver.corridor, own->x_m));
  scene.open_inside = std::isinf(open_for_m(network, *driver.corridor, own->x_m, own->lane - 1));
  scene.open_outside = std::isinf(open_for_m(network, *driver.corridor, own->x_m, own->lane + 1));
  scene.lane_ends_in_m = std::min(1e9, open_for_m(network, *driver.corridor, own->x_m, driver.lanes.lane));

  if (driver.corridor->is_route) {
    const WantedLane wanted = wanted_lane(driver.route, *driver.corridor, own->x_m);
    scene.wanted_lane = wanted.lane;
    scene.open_inside = open_for_m(network, *driver.corridor, own->x_m, own->lane - 1) >= room_to_change_m;
    scene.open_outside = open_for_m(network, *driver.corridor, own->x_m, own->lane + 1) >= room_to_change_m;
    const double goal_m = driver.route.goal_x_m - own->x_m - own->front_m + stops_past_goal_m;
    scene.lane_ends_in_m = std::min(scene.lane_ends_in_m, std::max(0.5, goal_m));
  }

  const PathAngles path = see_path(driver, network, *body, *own);
  const bool at_ease = std::abs(path.near_rad) * parameters.steering.near_distance_m < parameters.mirrors.ease_m;
  const auto looked = advance_mirrors(driver.mirrors, parameters.mirrors, at_ease, dt_s, driver.head_random);
  advance_tracks(driver.tracks, dt_s);
  if (driver.tracks.follows)
    driver.lanes = {.lane = own->lane, .target = own->lane};  // The lane to return to.
  else
    advance_lane_choice(driver.lanes, parameters, scene, driver.mirrors, looked, dt_s, driver.head_random);
  advance_pedals(driver.pedals, parameters.speed, parameters.car, *own, scene.desired_speed_mps,
                 obstacle_ahead(driver, scene), dt_s, driver.foot_random);

  DriverInput input;
  // Standing, the wheel mends no place in the lane.
  input.steering_wheel_rad =
      driver.course.stands_at_line(*own)
          ? driver.steering.hands_rad
          : advance_steering(driver.steering, parameters.steering, parameters.car, path, sees_road(driver.mirrors),
                             own->speed_mps, driver.now_s, dt_s, driver.hands_random);
  input.accelerator = driver.pedals.accelerator;
  input.brake = driver.pedals.brake;
  if (parameters.car.has_clutch) {
    const DriverCar& car = snapshot.driver_car;
    input.accelerator = advance_gears(driver.gears, parameters.gears, parameters.car,
                                      {.engine_radps = car.engine_radps,
                                       .speed_mps = own->speed_mps,
                                       .gear = car.gear,
                                       .accelerator = driver.pedals.accelerator,
                                       .braking = driver.pedals.brake > 0.0},
                                      dt_s);
    input.selector = GearSelector::manual;
    input.gear = static_cast<std::int8_t>(driver.gears.lever);
    input.clutch = driver.gears.clutch;
  }
  const bool signals = driver.lanes.phase >= LanePhase::signal && driver.lanes.phase != LanePhase::go_back;
  if (signals)
    input.indicator = (driver.lanes.target < driver.lanes.lane) == scene.grows_to_the_right ? IndicatorStalk::left
                                                                                            : IndicatorStalk::right;
  else
    input.indicator = turn_indicator(driver.course, parameters.course, *own);
  input.hazard_lights =
      advance_warning(driver.warning, parameters.speed, *own, driver.vehicles, dt_s, driver.foot_random);
  input.gaze_heading_rad = driver.mirrors.head_rad;
  input.sequence = driver.sequence;
  return input;
}

}  // namespace septet::driver
