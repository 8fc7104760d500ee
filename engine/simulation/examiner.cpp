#include "engine/simulation/examiner.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "engine/road/lane_links.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/road/turn.hpp"
#include "engine/simulation/lights_stage.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::simulation {
namespace {

using Line = traffic::YieldLine;

const char* name_of(Line::Kind kind) {
  switch (kind) {
    case Line::Kind::light:
      return "lights";
    case Line::Kind::give_way:
      return "give_way";
    case Line::Kind::crossing:
      return "crossing";
  }
  return "";
}

/// The light at a line; null where the scenario switches none there.
const SwitchedLight* light_at(const Model& model, const Line& line) {
  const auto found = std::ranges::find_if(model.lights, [&](const SwitchedLight& light) {
    return light.head.road == line.road && light.head.along_s == line.along_s && !light.head.for_walkers &&
           light.head.s_m == line.signal_s_m;
  });
  return found == model.lights.end() ? nullptr : &*found;
}

void note_line(const Model& model, const Line& line, std::span<const Participant> participants, const Participant& car,
               int lane, const State& state, std::vector<Event>& events) {
  const std::string& road = model.roads.roads[line.road].id;
  if (line.kind == Line::Kind::light) {
    const SwitchedLight* light = light_at(model, line);
    if (!light) return;
    const Lamps lamps = lamps_at(model, *light, state.time_s());
    const char* shows = lamps.has(Lamp::signal_red) ? "red" : lamps.has(Lamp::signal_amber) ? "amber" : "green";
    events.push_back({"right_of_way", std::nullopt,
                      fmt::format("kind=lights road={} margin_s={:.1f} shows={}", road,
                                  lamps.has(Lamp::signal_red) ? 0.0 : traffic::conflict_horizon_s, shows)});
    return;
  }
  const auto way = traffic::way_beyond(model.roads, line.kind, {line.road, lane, line.s_m, 0.0});
  const auto conflict = traffic::first_conflict(line.kind, way, participants, car);
  if (!conflict) return;
  events.push_back({"right_of_way", conflict->with,
                    fmt::format("kind={} road={} margin_s={:.1f}", name_of(line.kind), road, conflict->in_s)});
}

/// Logs a turn when the car has left a road of a junction.
void note_turn(const Model& model, const ExaminerState& examiner, std::vector<Event>& events) {
  const road::RoadPosition& was = *examiner.front;
  const bool along = road::runs_along_s(model.roads, {was.road, examiner.lane, was.s_m, 0.0});
  const int side = road::turn_through(model.roads, was.road, examiner.lane, along);
  if (side == 0) return;
  events.push_back({"turn", driver_participant,
                    fmt::format("side={} road={} began_s={:.3f}", side > 0 ? "left" : "right",
                                model.roads.roads[was.road].id, examiner.entered_s)});
}

Event limit_note(double limit_mps) { return {"speed_limit", std::nullopt, fmt::format("kmh={:.0f}", 3.6 * limit_mps)}; }

}  // namespace

std::vector<Event> notes_in_force(const State& state) {
  if (!state.examiner || state.examiner->limit_mps == 0.0) return {};
  return {limit_note(state.examiner->limit_mps)};
}

void advance_examiner(const Model& model, std::span<const Participant> participants, const Participant& car,
                      State& state, std::vector<Event>& events) {
  if (!state.examiner) return;
  ExaminerState& examiner = *state.examiner;
  const Vec3 front = car.world_from_vehicle * Vec3(vehicle_models()[car.model].front_m(), 0.0, 0.0);
  const auto location = road::locate(model.roads, {front.x, front.y}, examiner.front ? &*examiner.front : nullptr);
  if (!location || location->lanes.lane == 0 || location->lanes.outside_m > 0.0) {
    examiner.front.reset();
    return;
  }
  const road::RoadPosition& here = location->position;
  const road::LanePosition in_lane{here.road, location->lanes.lane, here.s_m, 0.0};
  const bool along = road::runs_along_s(model.roads, in_lane);
  const bool same_road = examiner.front && examiner.front->road == here.road;
  if (same_road) {
    for (const Line& line : model.yield_lines) {
      if (line.road != here.road || line.along_s != along) continue;
      const double was_m = line.s_m - examiner.front->s_m, is_m = line.s_m - here.s_m;
      if (along ? was_m > 0.0 && is_m <= 0.0 : was_m < 0.0 && is_m >= 0.0)
        note_line(model, line, participants, car, location->lanes.lane, state, events);
    }
  } else {
    const auto in_junction = [&](road::RoadIndex road) { return model.roads.roads[road].junction != road::no_index; };
    const bool was_in_junction = examiner.front && in_junction(examiner.front->road);
    if (was_in_junction && !in_junction(here.road)) note_turn(model, examiner, events);
    if (!was_in_junction) examiner.entered_s = state.time_s();
  }
  const double limit_mps = road::speed_limit_mps(model.roads, in_lane);
  if (limit_mps != examiner.limit_mps) events.push_back(limit_note(limit_mps));
  examiner.limit_mps = limit_mps;
  examiner.front = here;
  examiner.lane = location->lanes.lane;
}

}  // namespace septet::simulation
