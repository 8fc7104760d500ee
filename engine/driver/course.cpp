#include "engine/driver/course.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/turn.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/participant_sight.hpp"
#include "engine/world/people.hpp"
#include "engine/world/traffic_light.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::driver {
namespace {

using LineKind = traffic::YieldLine::Kind;

constexpr double preview_step_m = 5.0;
constexpr double line_sight_m = 90.0;
constexpr double edge_of_crossing_m = 9.0;  ///< From the middle of the lane.
/// Required braking beyond which a line is passed: at amber drivers avoid hard braking.
constexpr double hardest_for_amber_mps2 = 3.0, hardest_mps2 = 7.0;
constexpr double slowest_mps = 3.0, standing_mps = 1.0;
constexpr double start_s = 1.2;  ///< To drive off.
constexpr double doubt_s = 0.5;
/// A driver indicates after the previous exit has been passed, or at the fork.
constexpr double farthest_signal_m = 40.0, turn_before_m = 16.0;
/// Share of the acceleration in a bend that is taken in a turn, where hands have far to go.
constexpr double in_turns = 0.6;
constexpr double stands_before_m = 1.2, overrun_m = 1.0;

/// Permitted excess of the squared speed here over the squared target so far ahead.
double slower_m2ps2(const CourseParameters& course, const OwnPlace& own, double ahead_m) {
  return 2.0 * course.ease_off_mps2 * std::max(0.0, ahead_m - course.lead_s * std::max(own.speed_mps, 0.0));
}

/// Speed here, allowed by bends and limits within the preview.
double allowed_speed_mps(const DriverParameters& driver, const road::RoadNetwork& network,
                         const traffic::Corridor& corridor, const OwnPlace& own) {
  double allowed = std::numeric_limits<double>::infinity();
  for (double ahead_m = 0.0; ahead_m <= driver.course.preview_m; ahead_m += preview_step_m) {
    const double x = traffic::wrap_x(corridor, own.x_m + ahead_m);
    if (!corridor.closed && x >= corridor.length_m) break;
    const road::LanePosition there = traffic::position_at(corridor, x, own.lane);
    const double slower = slower_m2ps2(driver.course, own, ahead_m);
    const road::LanePoint point = road::evaluate_lane(network, there);
    double curvature = std::abs(point.road.curvature_per_m);
    double bend_mps2 = driver.course.bend_mps2;
    if (corridor.is_route) {
      // Turns at crossings are as tight as the lane is beside its line.
      curvature /= std::max(0.3, 1.0 - point.road.curvature_per_m * point.t_m);
      bend_mps2 *= in_turns;
    }
    if (curvature > 1e-6) allowed = std::min(allowed, std::sqrt(bend_mps2 / curvature + slower));
    const double limit = road::speed_limit_mps(network, there) * driver.speed.limit_factor;
    if (limit > 0.0 && ahead_m > 0.0) allowed = std::min(allowed, std::sqrt(limit * limit + slower));
  }
  return allowed;
}

Lamps light_at(const Snapshot& snapshot, const traffic::YieldLine& line) {
  constexpr double as_sent_m = 0.002;
  for (const TrafficLight& light : traffic_lights_of(snapshot))
    if (light.road == line.road && light.along_s == line.along_s && !light.for_walkers &&
        std::abs(light.s_m - line.signal_s_m) < as_sent_m)
      return light.lamps;
  return {};
}

/// The lane's path beyond a line.
std::vector<Vec2> way_at(const CourseLine& ahead, const road::RoadNetwork& network, const OwnPlace& own) {
  if (ahead.lane != 0)
    return traffic::way_beyond(network, ahead.line.kind, {ahead.line.road, ahead.lane, ahead.line.s_m, 0.0});
  const int lane = ahead.line.along_s ? -own.lane : own.lane;
  const bool right_hand = network.roads[ahead.line.road].rule == road::TrafficRule::right_hand;
  return traffic::way_beyond(network, ahead.line.kind,
                             {ahead.line.road, right_hand ? lane : -lane, ahead.line.s_m, 0.0});
}

/// True if a person is at a crossing, on it or at its edge.
bool is_somebody_at(const CourseLine& ahead, const road::RoadNetwork& network, std::span<const Participant> around,
                    const OwnPlace& own) {
  const std::vector<Vec2> way = way_at(ahead, network, own);
  if (way.empty()) return false;
  const Vec2 middle = way[way.size() / 2];
  return std::ranges::any_of(around, [&](const Participant& other) {
    const bool walks_by = is_person_of_swarm(other.id) && !other.lamps.has(Lamp::signal_green);
    return vehicle_models()[other.model].kind == ParticipantKind::pedestrian && !walks_by &&
           glm::distance(Vec2(other.world_from_vehicle.position_m), middle) < edge_of_crossing_m;
  });
}

/// Of the piece that begins beyond a line.
std::optional<traffic::ApproachView> view_of(std::span<const traffic::ApproachView> views,
                                             const traffic::CorridorPiece& beyond) {
  const auto found = std::ranges::find_if(views, [&](const traffic::ApproachView& view) {
    return view.road == beyond.road && view.along_s == beyond.along_s;
  });
  if (found == views.end()) return std::nullopt;
  return *found;
}

/// True where vehicles higher than the driver's eyes hide some of those for whom he looks.
bool vehicles_hide(const traffic::ApproachView& view, std::span<const Participant> around, const Participant& self) {
  const Vec3 eyes_m = self.world_from_vehicle * driver_eyes_m(vehicle_models()[self.model]);
  std::vector<traffic::HighBody> high;
  for (const Participant& other : around) {
    if (other.id == self.id || glm::distance(other.world_from_vehicle.position_m, eyes_m) > line_sight_m ||
        !traffic::hides_behind(shape_of(other)))
      continue;
    if (const auto box = opaque_box_of(other))
      high.push_back({0, traffic::does_move(glm::length(other.velocity_mps)), *box});
  }
  return !high.empty() && traffic::is_hidden_by(high, view, eyes_m);
}

/// True where one who is not at a line yet does not see all beyond it who have right of way.
bool is_hidden(const CourseLine& ahead, std::span<const Participant> around, const Participant& self, double left_m) {
  if (!ahead.view || left_m <= traffic::at_stop_line_m) return false;
  return left_m > ahead.view->seen_from_m ||
         (left_m <= traffic::looks_before_m.front() && vehicles_hide(*ahead.view, around, self));
}

/// True if the driver sees that this line requires a stop.
bool waits(const CourseLine& ahead, const CourseState& state, const DriverParameters& driver,
           const road::RoadNetwork& network, const Snapshot& snapshot, std::span<const Participant> around,
           const OwnPlace& own, double left_m) {
  const double v = std::max(own.speed_mps, 0.0);
  const double needs_mps2 = v * v / (2.0 * std::max(left_m, 0.1));
  if (needs_mps2 > hardest_mps2) return false;
  if (ahead.line.kind == LineKind::light) {
    const Lamps lamps = light_at(snapshot, ahead.line);
    if (lamps.has(Lamp::signal_red)) return true;
    return lamps.has(Lamp::signal_amber) && needs_mps2 < hardest_for_amber_mps2;
  }
  const auto self = std::ranges::find(around, snapshot.driver_car.participant, &Participant::id);
  if (self == around.end()) return false;
  if (is_hidden(ahead, around, *self, left_m)) return true;
  const auto conflict = traffic::first_conflict(ahead.line.kind, way_at(ahead, network, own), around, *self);
  if (!conflict) return false;
  const double own_s = left_m / std::max(v, slowest_mps) + (v < standing_mps ? start_s : 0.0);
  // A driver who has decided does not change for a trifle.
  const double certain_s = state.waits_at_m ? doubt_s : -doubt_s;
  return conflict->in_s * std::max(0.0, 1.0 + state.judgement.value) < own_s + driver.course.gap_s + certain_s;
}

}  // namespace

CourseState read_course(const road::RoadNetwork& network, const traffic::Corridor& corridor,
                        std::span<const traffic::ApproachView> views) {
  CourseState state;
  const std::vector<traffic::YieldLine> lines = traffic::yield_lines(network);
  for (std::size_t k = 0; k < corridor.pieces.size(); ++k) {
    const traffic::CorridorPiece& piece = corridor.pieces[k];
    for (const traffic::YieldLine& line : lines) {
      if (line.road != piece.road || line.along_s != piece.along_s) continue;
      // On a route give-way lines are minded with all else that has right of way (junction_gaps.hpp).
      if (corridor.is_route &&
          (line.kind == LineKind::give_way || line.s_m < piece.from_s_m || line.s_m > piece.from_s_m + piece.length_m))
        continue;
      const double x_m = traffic::x_on_piece(piece, line.s_m);
      const bool is_last = k + 1 == corridor.pieces.size();
      const bool gives_way = line.kind == LineKind::give_way && !is_last;
      state.lines.push_back({x_m, line, gives_way ? view_of(views, corridor.pieces[k + 1]) : std::nullopt,
                             corridor.is_route ? piece.lane : 0});
    }
    const int side =
        road::turn_through(network, piece.road, corridor.is_route ? piece.lane : piece.side, piece.along_s);
    if (side != 0) state.turns.push_back({piece.x_m, piece.x_m + piece.length_m, side});
  }
  std::ranges::stable_sort(state.lines, {}, &CourseLine::x_m);
  return state;
}

void look_at_course(CourseState& state, const DriverParameters& driver, const road::RoadNetwork& network,
                    const traffic::Corridor& corridor, const Snapshot& snapshot, std::span<const Participant> around,
                    const OwnPlace& own, double now_s, double dt_s, Random& random) {
  state.speed_mps = allowed_speed_mps(driver, network, corridor, own);
  if (state.lines.empty()) return;
  state.judgement.advance(driver.course.judgement, driver.course.judgement_time_s, dt_s, random);
  std::optional<double> seen;
  for (const CourseLine& ahead : state.lines) {
    const double left_m = traffic::distance_m(corridor, own.x_m, ahead.x_m) - own.front_m;
    // A driver who stopped a little beyond it waits there.
    if (left_m < (own.speed_mps < standing_mps ? -overrun_m : 0.0) || left_m > line_sight_m) continue;
    if (ahead.line.kind == LineKind::crossing && state.speed_mps > driver.course.crossing_mps &&
        is_somebody_at(ahead, network, around, own))
      state.speed_mps = std::min(state.speed_mps, std::sqrt(driver.course.crossing_mps * driver.course.crossing_mps +
                                                            slower_m2ps2(driver.course, own, left_m)));
    if (!waits(ahead, state, driver, network, snapshot, around, own, left_m)) continue;
    seen = ahead.x_m;
    break;
  }
  state.waits_at_m = state.eyes.through(now_s, seen, driver.speed.reaction_time_s);
}

std::optional<Obstacle> line_ahead(const CourseState& state, const OwnPlace& own, const SpeedParameters& speed) {
  if (!state.waits_at_m) return std::nullopt;
  const double left_m = *state.waits_at_m - own.x_m - own.front_m;
  if (left_m < -overrun_m) return std::nullopt;
  // Stops at the line, nearer than behind a vehicle.
  return Obstacle{.gap_m = left_m + speed.standstill_gap_m - stands_before_m, .speed_mps = 0.0};
}

IndicatorStalk turn_indicator(const CourseState& state, const CourseParameters& course, const OwnPlace& own) {
  for (const CourseTurn& turn : state.turns) {
    const double to_go_m = turn.begins_m - own.x_m;
    const double before_m = std::min(std::max(course.turn_signal_s * std::max(own.speed_mps, slowest_mps), 4.0),
                                     turn.side < 0 ? turn_before_m : farthest_signal_m);
    if (to_go_m > before_m || own.x_m > turn.ends_m) continue;
    return turn.side > 0 ? IndicatorStalk::left : IndicatorStalk::right;
  }
  return IndicatorStalk::off;
}

}  // namespace septet::driver
