#include "engine/simulation/saved_state.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "engine/core/archive.hpp"
#include "engine/core/hash.hpp"
#include "engine/core/printable.hpp"
#include "engine/core/version.hpp"
#include "engine/effects/debris/save_debris.hpp"
#include "engine/effects/smoke/save_smoke.hpp"
#include "engine/physics/impact/impact_members.hpp"
#include "engine/physics/impact/sound_state.hpp"
#include "engine/physics/vehicle/vehicle_members.hpp"
#include "engine/road/position_members.hpp"
#include "engine/scenario/run/save_scenario.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/guidance.hpp"
#include "engine/simulation/people_stage.hpp"
#include "engine/simulation/save_people.hpp"
#include "engine/simulation/save_thrown.hpp"
#include "engine/simulation/solids.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/world_members.hpp"

namespace septet {
SEPTET_MEMBERS(LimitedSight, driver, seen_m)
}

namespace septet::debris {
SEPTET_MEMBERS(GroundPoint, height_m, normal, friction_factor)
}

namespace septet::debris {
SEPTET_MEMBERS(Dent, place_m, heading_rad, depth_m, half_width_m, top_m)
SEPTET_MEMBERS(DentedVehicle, vehicle, dents, torn)
}  // namespace septet::debris

namespace septet::ice {
SEPTET_MEMBERS(LyingSlab, vehicle, foot_m, size_m)
SEPTET_MEMBERS(IcicleRow, from_m, to_m, longest_m, seed)
SEPTET_MEMBERS(Frost, thickness_kgpm2, heated_s, seed, glass_k, melted_kgpm2)
SEPTET_MEMBERS(Star, across, up, reach_m, seed)
SEPTET_MEMBERS(Pane, vehicle, frost, stars)
SEPTET_MEMBERS(Sheet, left_m, right_m, thickness_m)
// Rows of icicles follow from roads and seed, and sheets from the black ice.
SEPTET_MEMBER_GROUPS(StillIce, hashed(slabs), kept(rows, sheets), hashed(thawed_kh))
}  // namespace septet::ice

namespace septet {
SEPTET_MEMBERS(CrashedBody, mass_kg, yaw_inertia_kgm2, mass_centre_ahead_m, mass_centre_above_m, before_mps,
               yaw_rate_before_radps, delta_v_mps, delta_yaw_rate_radps, principal_direction_rad, crush_m)
SEPTET_MEMBERS(CrashLedger, kinetic_before_j, kinetic_after_j, crush_j, friction_j, debris_j, wheels_j)
SEPTET_MEMBERS(CrashRecord, tick, ticks, contact_s, first, second, stands, point_m, normal_rad, closing_speed_mps,
               sliding_mps, overlap_m, overlap_share, depth_m, of_first, of_second, ledger, pieces_kinetic_j, pulse_ns,
               is_unfinished)
}  // namespace septet

namespace septet::vehicle {
SEPTET_MEMBERS(Faults, anti_lock, misfire)
}

namespace septet::scene {
SEPTET_MEMBERS(MotionLeg, from_s, velocity_mps, acceleration_mps2, turn_radps)
SEPTET_MEMBERS(Motion, position_m, rotation, legs)
}  // namespace septet::scene

namespace septet {
SEPTET_MEMBERS(GuidanceWord, what, now, exit)
SEPTET_MEMBERS(Guidance, next, to_next_m, told, told_count, told_at)
}  // namespace septet

namespace septet::traffic {
SEPTET_MEMBERS(PlaceOnLane, way, at_m)
SEPTET_MEMBERS(RouteStep, enters, leaves, begins_m)
SEPTET_MEMBERS(LaneRoute, steps, length_m, time_s, from, to, reached_m)
}  // namespace septet::traffic

namespace septet::simulation {

// Graph and turns follow from the roads and the route.
SEPTET_MEMBER_GROUPS(GuidanceState,
                     hashed(goals, route, step, along_m, turn, soon_told, now_told, lane_told, arrived, off_ticks,
                            wait_ticks, shown),
                     kept(shown_at, route_at), left_out(graph, turns))
SEPTET_MEMBERS(SolidMotion, participant, foot_m, heading_rad, motion)
SEPTET_MEMBERS(CarFaults, vehicle, lamps_out)
SEPTET_MEMBERS(BlackIce, road, lane, s_m, length_m, thickness_m)
// Panes are in the effects' chained hash, where there are any.
SEPTET_MEMBER_GROUPS(IceState, hashed(still, black), kept(panes, keyframe, glass_keyframe))
SEPTET_MEMBERS(KerbTouch, height_m, closing_speed_mps)
SEPTET_MEMBERS(WheelStrike, kerb, squeeze_m)
SEPTET_MEMBERS(DentState, vehicles, keyframe)
SEPTET_MEMBERS(CrashedVehicle, id, mass_kg, velocity_mps, angular_velocity_radps)
SEPTET_MEMBERS(VehicleCrash, first, second, point_m, normal, closing_speed_mps)
SEPTET_MEMBERS(StandingCrash, vehicle, touch)
SEPTET_MEMBERS(CarImpact, vehicle, pulse, struck, due_s)
SEPTET_MEMBERS(LooseBody, id, model, box_size_m, paint, lamps, front_steer_rad, wheel_spin_rad, body, height_m, up,
               climb_mps, acceleration_mps2, road, hull)
SEPTET_MEMBERS(BodyContact, first, second, engagement)
SEPTET_MEMBERS(BodiesState, bodies, contacts)
SEPTET_MEMBERS(OpenCrash, record, run, last_push, last_in_contact, is_impact_over, is_told, first_at, second_at, first,
               second, of_contact, debris_j, wheels_j, deepest_m, first_moves, second_moves, has_ledger)
SEPTET_MEMBERS(CrashMemory, struck_vehicles, struck_standing, parts)
SEPTET_MEMBERS(ExaminerState, front, lane, limit_mps, entered_s)
SEPTET_MEMBERS(Sighting, id, seen, was_seen, since)
SEPTET_MEMBERS(Sightings, near, changed)
SEPTET_MEMBERS(MotionState, start_x_m, start_y_m, start_heading_rad, is_over)
SEPTET_MEMBERS(GameState, standing, next_move_s, random)
SEPTET_MEMBERS(Fire, vehicle, flames, smoke, burning_s, burning)
SEPTET_MEMBERS(PublishedEffect, id, tick, settled)
SEPTET_MEMBERS(PublishedEffects, keyframes, channels)

// Smoke and its track have a reader of their own; new smoke is in the effects' chained hash.
SEPTET_MEMBER_GROUPS(FireState, left_out(smoke, track), kept(soot), hashed(fires), kept(keyframes))
// Debris and fires have readers of their own; moved debris is in the chained hash. Dents follow from the crashes and
// are only shown; keyframes follow from debris, and the rest caches where something was found.
SEPTET_MEMBER_GROUPS(EffectsState, left_out(debris), hashed(crashes), kept(dents), left_out(fires), hashed(ice, random),
                     kept(published), hashed(hash), left_out(surface_memory), kept(surface_hint))
// Storyboard, traffic and effects have readers of their own. The input's effect is in the car. Faults, impacts, bodies,
// thrown ones, people, things that are gone, solids in motion, limited sights, a given motion, a game, an examiner and
// guidance are hashed where there are any. Open crashes and sightings change nothing.
SEPTET_MEMBER_GROUPS(State, hashed(tick, car), kept(faults), hashed(hull), kept(impacts, bodies, thrown, open_crashes),
                     hashed(wheel_roads, kerbs, strikes, car_road), kept(off_road_ticks), left_out(scenario, traffic),
                     kept(people), left_out(effects),
                     kept(gone, solid_motions, sights, sightings, motion, game, examiner, guidance, input),
                     hashed(diagnostics, touching))

namespace {

constexpr std::array magic{'S', 'E', 'P', 'T', 'S', 'T', 'A', 'T'};
constexpr std::size_t longest_name = 256;
constexpr auto wrong = "it does not fit together";
constexpr double longest_crush_m = 100.0;

struct Heading {
  std::array<char, 8> word = magic;
  std::uint32_t format = saved_state_version;
  std::string build;
  std::uint64_t drive = 0;
};
SEPTET_MEMBERS(Heading, word, format, build, drive)

std::uint64_t hash_of(std::span<const std::byte> bytes) {
  StateHash hash;
  hash.add_bytes(bytes);
  return hash.value();
}

std::uint64_t drive_of(const Model& model) {
  StateHash hash;
  hash.add(model.sources_hash);
  hash.add(model.seed);
  hash.add(model.driver_entity);
  return hash.value();
}

// A surface is remembered from its first query, which at crossing roads may depend on the order of queries; so it is
// kept, in the order of its keys.
void save_surface(const EffectsState& state, StateWriter& writer) {
  const std::map<std::uint64_t, debris::GroundPoint> ordered(state.surface_memory.begin(), state.surface_memory.end());
  transfer(writer, ordered);
}

void restore_surface(StateReader& reader, EffectsState& state) {
  std::map<std::uint64_t, debris::GroundPoint> ordered;
  transfer(reader, ordered);
  state.surface_memory.insert(ordered.begin(), ordered.end());
}

void save_effects(const EffectsState& state, StateWriter& writer) {
  transfer(writer, state);
  debris::save_debris(state.debris, writer);
  save_surface(state, writer);
  const bool burns = state.fires.smoke.has_value();
  transfer(writer, burns);
  transfer(writer, state.fires);
  if (burns) smoke::save_smoke(*state.fires.smoke, state.fires.track, writer);
}

void require_keyframes(const std::vector<EffectKeyframe>& keyframes, StateReader& reader) {
  reader.require(std::ranges::is_sorted(keyframes, std::ranges::less_equal{}, &EffectKeyframe::id), wrong);
}

bool is_sound(const CarImpact& running) {
  const auto is_mass = [](double mass) { return mass > 0.0; };  // Infinite of what stands fast.
  return impact::is_sound(running.pulse) && impact::is_within(running.due_s, 0.0, impact::longest_pulse_s) &&
         is_mass(running.struck.mass_kg) && is_mass(running.struck.yaw_inertia_kgm2);
}

bool is_sound(const vehicle::HullTouch& touch) {
  return impact::is_sound(touch.engagement) && impact::is_positive(touch.mass_kg) && std::abs(touch.side) == 1.0 &&
         impact::is_within(touch.crushed_m, 0.0, longest_crush_m);
}

/// `led`: by a motion.
bool is_sound(const LooseBody& loose, bool led) {
  constexpr double farthest = 1e7;  // In any unit.
  const impact::Body& body = loose.body;
  const bool stands_fast = loose.model == box_model() && body.mass_kg == INFINITY &&
                           body.yaw_inertia_kgm2 == INFINITY &&
                           (led || (body.velocity_mps == Vec2(0.0) && body.yaw_rate_radps == 0.0));
  const Vec3& size_m = loose.box_size_m;
  return loose.model < vehicle_models().size() && loose.id != driver_participant &&
         impact::is_within(std::min({size_m.x, size_m.y, size_m.z}), 1e-3, farthest) &&
         impact::is_within(std::max({size_m.x, size_m.y, size_m.z}), 1e-3, farthest) &&
         (stands_fast || (impact::is_positive(body.mass_kg) && impact::is_positive(body.yaw_inertia_kgm2))) &&
         impact::is_within(glm::length(loose.up), 0.99, 1.01) && loose.up.z > 0.05 &&
         impact::is_within(loose.body.heading_rad, -farthest, farthest) &&
         impact::is_within(loose.body.yaw_rate_radps, -farthest, farthest) &&
         impact::is_within(loose.height_m, -farthest, farthest) && std::isfinite(loose.climb_mps) &&
         glm::length(loose.body.mass_centre_m) < farthest && glm::length(loose.body.velocity_mps) < farthest &&
         std::ranges::all_of(loose.hull.touches, [](const vehicle::HullTouch& touch) { return is_sound(touch); });
}

/// As no contact is told of two that are one, and none twice.
void require_sound(const Model& model, const State& state, StateReader& reader) {
  const BodiesState& bodies = state.bodies;
  for (std::size_t i = 0; i < bodies.bodies.size(); ++i) {
    const LooseBody& loose = bodies.bodies[i];
    reader.require(
        is_sound(loose, is_led(state, loose.id)) && std::ranges::count(bodies.bodies, loose.id, &LooseBody::id) == 1,
        wrong);
    if (loose.road) road::require_on_roads(reader, model.roads, *loose.road);
  }
  const auto pair = [](const BodyContact& contact) { return std::pair(contact.first, contact.second); };
  reader.require(std::ranges::is_sorted(bodies.contacts, std::ranges::less_equal{}, pair), wrong);
  for (const BodyContact& contact : bodies.contacts)
    reader.require(contact.first < contact.second && impact::is_sound(contact.engagement), wrong);
}

bool is_sound(const SolidMotion& moving) {
  const auto within = [](double value, double most) { return impact::is_within(value, -most, most); };
  const auto near = [&](const Vec3& place_m, double most_m) {
    return within(place_m.x, most_m) && within(place_m.y, most_m) && within(place_m.z, most_m);
  };
  const scene::Motion& motion = moving.motion;
  return is_solid(moving.participant) && near(moving.foot_m, 2.0 * farthest_solid_m) &&
         within(moving.heading_rad, 2.0 * std::numbers::pi) && near(motion.position_m, farthest_solid_m) &&
         motion.rotation == Quat(1.0, 0.0, 0.0, 0.0) && !motion.legs.empty() && is_motion_of_solid(motion.legs);
}

/// The record is within what its ticks allow; its numbers are told and reckoned with, and index nothing.
bool is_sound(const OpenCrash& crash, Tick now) {
  const Tick begun = crash.record.tick;
  return begun <= crash.last_push && crash.last_push <= crash.last_in_contact && crash.last_in_contact <= now &&
         crash.last_push - begun < most_pulse_ticks && crash.record.pulse_ns.size() <= crash.last_push - begun + 1;
}

void restore_effects(const Model& model, StateReader& reader, EffectsState& state) {
  transfer(reader, state);
  debris::restore_debris(reader, state.debris);
  restore_surface(reader, state);
  bool burns = false;
  transfer(reader, burns);
  transfer(reader, state.fires);
  if (burns) smoke::restore_smoke(reader, state.fires.smoke.emplace(), state.fires.track);
  const std::size_t emitters = burns ? state.fires.smoke->emitters.size() : 0;
  for (const Fire& fire : state.fires.fires) reader.require(fire.flames < emitters && fire.smoke < emitters, wrong);
  require_keyframes(state.fires.keyframes, reader);
  require_keyframes(state.published.keyframes, reader);
  reader.require(std::ranges::equal(state.published.keyframes, state.published.channels, {}, &EffectKeyframe::id,
                                    &PublishedEffect::id),
                 wrong);
  reader.require(state.ice.black.size() == state.ice.still.sheets.size(), wrong);
  for (const BlackIce& black : state.ice.black) reader.require(black.road < model.roads.roads.size(), wrong);
  if (state.surface_hint) road::require_on_roads(reader, model.roads, *state.surface_hint);
  for (const auto& [vehicle, parts] : state.crashes.parts)
    for (const debris::MountedPart& part : parts)
      reader.require(
          static_cast<int>(part.part) < debris::part_count && static_cast<int>(part.mount) < debris::mount_count,
          wrong);
  for (const StandingCrash& struck : state.crashes.struck_standing) reader.require(is_sound(struck.touch), wrong);
}

void restore_car(const Model& model, StateReader& reader, State& state) {
  transfer(reader, state);
  const auto gears = static_cast<int>(model.car.powertrain.gear_ratio.size());
  for (const int gear : {state.car.powertrain.gear, state.car.powertrain.next_gear})
    reader.require(gear >= -1 && gear <= gears, wrong);
  for (const auto& place : state.wheel_roads) road::require_on_roads(reader, model.roads, place);
  if (state.car_road) road::require_on_roads(reader, model.roads, *state.car_road);
  reader.require(std::ranges::is_sorted(state.touching), wrong);
  for (const CarImpact& running : state.impacts) reader.require(is_sound(running), wrong);
  require_sound(model, state, reader);
  for (const SolidMotion& moving : state.solid_motions)
    reader.require(is_sound(moving) && find_loose(state, moving.participant) &&
                       std::ranges::count(state.solid_motions, moving.participant, &SolidMotion::participant) == 1,
                   wrong);
  for (const OpenCrash& crash : state.open_crashes) reader.require(is_sound(crash, state.tick), wrong);
  require_sound(reader, model.roads, state.thrown);
  require_sound(reader, model, state.people);
  for (const vehicle::HullTouch& touch : state.hull.touches) reader.require(is_sound(touch), wrong);
  const std::uint32_t things = model.obstacles ? model.obstacles->things() : 0;
  reader.require(std::ranges::is_sorted(state.gone, std::ranges::less_equal{}), wrong);
  for (const std::uint32_t thing : state.gone) reader.require(thing > 0 && thing <= things, wrong);
  reader.require(std::ranges::is_sorted(state.sights, std::ranges::less_equal{}, &LimitedSight::driver), wrong);
  for (const LimitedSight& sight : state.sights)
    reader.require(impact::is_within(sight.seen_m, 0.0, farthest_sight_m), wrong);
  reader.require(std::ranges::is_sorted(state.sightings.near, std::ranges::less_equal{}, &Sighting::id), wrong);
  for (const Sighting& sighting : state.sightings.near) reader.require(sighting.since <= state.tick, wrong);
  reader.require(state.sightings.changed <= state.tick, wrong);
  reader.require(state.motion.has_value() == (model.motion != nullptr), wrong);
  reader.require(state.game.has_value() == model.scenario.game.has_value(), wrong);
  reader.require(state.examiner.has_value() != model.yield_lines.empty(), wrong);
  if (state.examiner && state.examiner->front) road::require_on_roads(reader, model.roads, *state.examiner->front);
  if (state.game) reader.require(state.game->standing.end <= GameEnd::time, wrong);
  if (state.guidance) reader.require(complete_guidance(model, *state.guidance), wrong);
}

Expected<State> refused(const std::string& what, std::string_view where, const char* remedy) {
  return failure(what, std::string(where), remedy);
}

}  // namespace

std::uint64_t hash_state(const State& state) {
  StateHash hash;
  hash_members(hash, state);
  scenario::add_to_hash(state.scenario, hash);
  state.traffic->add_to_hash(hash);
  hash_members(hash, state.effects, state.effects.fires);
  for (const std::uint32_t thing : state.gone) hash.add(thing);
  for (const SolidMotion& moving : state.solid_motions) hash_members(hash, moving);
  for (const LimitedSight& sight : state.sights) hash_members(hash, sight);
  if (state.motion) hash_members(hash, *state.motion);
  if (state.game) hash_members(hash, *state.game);
  if (state.examiner) hash_members(hash, *state.examiner);
  if (state.guidance) hash_members(hash, *state.guidance);
  if (state.faults.any()) hash_members(hash, state.faults);
  for (const CarImpact& running : state.impacts) hash_members(hash, running);
  if (!state.bodies.empty()) hash_members(hash, state.bodies);
  if (!state.people.empty()) hash_members(hash, state.people);
  for (const ThrownBody& thrown : state.thrown) hash_members(hash, thrown);
  return hash.value();
}

Expected<Bytes> save_state(const Model& model, const State& state) {
  if (!state.traffic->can_be_saved())
    return failure("the state cannot be saved: another program moves the traffic, and keeps it", "traffic",
                   "drive with Septet's own traffic");
  Bytes bytes;
  StateWriter writer(bytes);
  const Heading heading{.build = version_text(), .drive = drive_of(model)};
  transfer(writer, heading);
  transfer(writer, state);
  scenario::save_scenario(state.scenario, writer);
  state.traffic->save(writer);
  save_effects(state.effects, writer);
  const std::uint64_t state_hash = hash_state(state);
  transfer(writer, state_hash);
  const std::uint64_t bytes_hash = hash_of(bytes);
  transfer(writer, bytes_hash);
  if (bytes.size() > most_saved_bytes)
    return failure(fmt::format("the state cannot be saved: it takes {} bytes", bytes.size()), "effects", "burn less");
  return bytes;
}

namespace {

enum class ToldHash { must_agree, may_differ };

Expected<State> restore(const Model& model, std::unique_ptr<traffic::TrafficEngine> traffic,
                        std::span<const std::byte> bytes, std::string_view where, ToldHash told) {
  constexpr auto use_whole = "use an unaltered copy";
  const auto damaged = [&](const std::string& how) {
    return refused("the saved state is damaged: " + how, where, use_whole);
  };
  if (!traffic->can_be_saved())
    return refused("the state cannot be restored: another program moves the traffic", where,
                   "drive with Septet's own traffic");
  if (bytes.size() > most_saved_bytes) return damaged("it is too long");
  StateReader reader(bytes);
  Heading heading;
  transfer(reader, heading.word);
  if (!reader.ok() || heading.word != magic)
    return refused("this is no saved state", where, "give one that Septet saved");
  transfer(reader, heading.format);
  transfer(reader, heading.build);
  transfer(reader, heading.drive);
  if (!reader.ok() || heading.build.size() > longest_name) return damaged("it ends too early");
  if (heading.format != saved_state_version || heading.build != version_text())
    return refused(fmt::format("the state was saved by another build, Septet {}; this is {}", printable(heading.build),
                               version_text()),
                   where, "restore it with that one");
  if (heading.drive != drive_of(model))
    return refused("the state was saved in another drive: scenario, roads, car or seed are not the same", where,
                   "give the files of that drive");
  std::uint64_t bytes_hash = 0;
  if (reader.remaining() < sizeof bytes_hash) return damaged("it ends too early");
  StateReader(bytes.last(sizeof bytes_hash)).get(&bytes_hash, sizeof bytes_hash);
  if (bytes_hash != hash_of(bytes.first(bytes.size() - sizeof bytes_hash)))
    return damaged("its bytes are not those that were saved");

  State state;
  state.traffic = std::move(traffic);
  if (model.obstacles) state.traffic->see_walls(model.obstacles->walls());
  state.traffic->see_crossings(crossing_places(model));
  scenario::StepResult init;
  auto started = scenario::start_scenario(model.scenario, model.roads, model.driver_entity, init);
  if (!started) return tl::unexpected(started.error());
  state.scenario = std::move(*started);
  restore_car(model, reader, state);
  scenario::restore_scenario(model.scenario, model.roads, reader, state.scenario);
  state.traffic->restore(reader);
  restore_effects(model, reader, state.effects);
  std::uint64_t state_hash = 0;
  transfer(reader, state_hash);
  reader.require(reader.remaining() == sizeof bytes_hash, "it is too long");
  if (!reader.ok()) return damaged(reader.problem());
  if (told == ToldHash::must_agree && state_hash != hash_state(state))
    return damaged("it gives another state hash than was saved");
  return state;
}

}  // namespace

Expected<State> restore_state(const Model& model, std::unique_ptr<traffic::TrafficEngine> traffic,
                              std::span<const std::byte> bytes, std::string_view where) {
  return restore(model, std::move(traffic), bytes, where, ToldHash::must_agree);
}

Expected<State> restore_altered_state(const Model& model, std::unique_ptr<traffic::TrafficEngine> traffic,
                                      std::span<const std::byte> bytes, std::string_view where) {
  return restore(model, std::move(traffic), bytes, where, ToldHash::may_differ);
}

}  // namespace septet::simulation
