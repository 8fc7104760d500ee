#include "engine/simulation/effects/effects_stage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/core/hash.hpp"
#include "engine/effects/debris/debris_keyframe.hpp"
#include "engine/effects/debris/melt.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/effects/debris/save_debris.hpp"
#include "engine/effects/ice/still_ice.hpp"
#include "engine/simulation/effects/effect_surroundings.hpp"
#include "engine/world/breakable_names.hpp"

namespace septet::simulation {
namespace {

static_assert(breakable_names.size() == debris::part_count);

Vec3 place_of(const debris::Piece& piece) { return debris::from_eigen(piece.body.position_m.front()); }

/// Removes debris that is far from the driver, has fallen off the world or is over the limit.
void retire(const EffectsWorld& world, debris::State& debris) {
  const auto driver = std::ranges::find(world.participants, world.driver, &Participant::id);
  if (driver == world.participants.end()) return;
  const Vec3 eye = driver->world_from_vehicle.position_m;
  const auto distance = [&](const Vec3& place) { return glm::length(place - eye); };
  std::erase_if(debris.pieces,
                [&](const debris::Piece& piece) { return !(distance(place_of(piece)) < debris_reach_m); });
  std::erase_if(debris.shards,
                [&](const debris::Shard& shard) { return !(distance(shard.position_m) < debris_reach_m); });
  while (debris.pieces.size() > most_pieces)
    debris.pieces.erase(std::ranges::max_element(
        debris.pieces, {}, [&](const debris::Piece& piece) { return distance(place_of(piece)); }));
}

std::vector<EffectOffer> debris_offers(const debris::State& debris) {
  std::vector<EffectOffer> offers;
  const auto still = [](const debris::Shard& shard) { return shard.velocity_mps == Vec3(0.0); };
  if (!debris.shards.empty())
    offers.push_back({debris::first_effect_id, debris::keyframe_kind, 6, std::ranges::all_of(debris.shards, still),
                      [&debris] { return debris::encode(debris::keyframe_of(debris.shards)); }});
  for (const debris::Piece& piece : debris.pieces)
    offers.push_back({debris::first_effect_id + (piece.id & 0xffffff), debris::keyframe_kind, 4, piece.asleep,
                      [&piece] { return debris::encode(debris::keyframe_of(piece)); }});
  return offers;
}

}  // namespace

std::optional<debris::Part> part_of_name(std::string_view name) {
  const auto found = std::ranges::find(breakable_names, name);
  if (found == breakable_names.end()) return std::nullopt;
  return static_cast<debris::Part>(found - breakable_names.begin());
}

std::span<const std::string_view> part_names() { return breakable_names; }

EffectsState initial_effects(const scenario::Scenario& scenario, const scenario::ScenarioState& storyboard,
                             std::uint64_t seed) {
  EffectsState state;
  state.random = Random(seed, 2);
  for (std::size_t i = 0; i < scenario.entities.size(); ++i) {
    const scenario::Entity& entity = scenario.entities[i];
    const auto part = part_of_name(entity.type_name);
    if (entity.kind != scenario::EntityKind::misc_object || !part || !storyboard.entities[i].active) continue;
    stand_part(*part, storyboard.entities[i].world_from_entity, state);
  }
  return state;
}

void stand_part(debris::Part part, const RigidTransform& feet, EffectsState& state) {
  RigidTransform place = feet;
  const double half = 0.5 * debris::part_recipe(part).size_m.z;
  place.position_m += place.orientation * Vec3(0.0, 0.0, half + 0.002);
  debris::spawn_part(state.debris, part, place, Vec3(0.0), Vec3(0.0), state.random);
  state.debris.pieces.back().asleep = true;
}

std::vector<LyingPiece> lying_pieces(const EffectsState& state) {
  std::vector<LyingPiece> pieces;
  for (const debris::Piece& piece : state.debris.pieces)
    pieces.push_back({piece.id, breakable_names[static_cast<std::size_t>(piece.part)], place_of(piece)});
  return pieces;
}

bool remove_piece(std::uint32_t id, EffectsState& state) {
  return std::erase_if(state.debris.pieces, [&](const debris::Piece& piece) { return piece.id == id; }) > 0;
}

void spill(const scenario::EffectAction& action, const scenario::Entity& entity, const scenario::EntityState& from,
           ParticipantId vehicle, EffectsState& state) {
  const auto part = part_of_name(action.part);
  if (!part || !from.active) return;
  const double whole_m = debris::part_recipe(*part).size_m.z, roof = entity.box.centre_m.z + 0.5 * entity.box.height_m;
  double left = 1.0;
  if (*part == debris::Part::ice_slab) left = release_slab(vehicle, {action.x_m, action.y_m}, whole_m, state.ice);
  if (left < debris::least_height_left) return;
  const double half = 0.5 * left * whole_m;
  const Quat& turn = from.world_from_entity.orientation;
  const Vec3 place = from.world_from_entity * Vec3(action.x_m, action.y_m, roof + half + 0.02);
  debris::spawn_part(state.debris, *part, {place, turn},
                     from.velocity_mps + turn * Vec3(-action.slide_mps, action.side_mps, 0.0),
                     from.angular_velocity_radps, state.random, left);
}

bool effects_are_still(const EffectsState& state) {
  return state.debris.pieces.empty() && state.debris.shards.empty() && state.published.keyframes.empty() &&
         state.crashes.struck_vehicles.empty() && state.crashes.struck_standing.empty() && !state.fires.smoke &&
         state.ice.still.empty() && state.ice.keyframe.data.empty() && state.ice.panes.empty();
}

EffectsReport advance_effects(const EffectsWorld& world, EffectsState& state) {
  EffectsReport report;
  const double step_s = static_cast<double>(effects_step_ticks) * world.tick_s;
  retire(world, state.debris);
  debris::ContactWorld contacts;
  contacts.ground = [&](double x_m, double y_m) {
    return surface_below(world.roads, world.ground_friction, x_m, y_m, state);
  };
  const double towards = world.environment.wind_direction_rad;
  contacts.wind_mps = world.environment.wind_speed_mps * Vec3(std::cos(towards), std::sin(towards), 0.0);
  contacts.melted_m = ice::melted_m(ice::degree_hours(world.environment.temperature_k, step_s));
  int driver_box = -1;
  report.crashes =
      advance_crashes(world.participants, world.driver, contacts, state.crashes, state.debris, state.random);
  contacts.boxes = vehicle_boxes(world, state.debris, driver_box);
  const std::vector<debris::Box> standing = standing_boxes(world.obstacles, world.gone, moving_places(state.debris));
  contacts.boxes.insert(contacts.boxes.end(), standing.begin(), standing.end());
  const debris::StepReport stepped = debris::advance_debris(state.debris, contacts, step_s);
  report.fractures = stepped.fractures;
  report.bad_numbers = stepped.bad_numbers;
  report.impulse_on_driver_ns = report.crashes.impulse_on_driver_ns;
  if (driver_box >= 0) report.impulse_on_driver_ns += contacts.boxes[static_cast<std::size_t>(driver_box)].impulse_ns;

  advance_fires(world.participants, world.environment, world.tick, static_cast<double>(world.tick) * world.tick_s,
                step_s, state.fires);

  for (const ShakenGlass& glass : report.crashes.glass) shake_glass(glass, state.ice);
  advance_dents(report.crashes.dents, report.crashes.torn, world.participants, world.tick + effects_step_ticks,
                state.dents);
  const auto driver = std::ranges::find(world.participants, world.driver, &Participant::id);
  const double driver_speed_mps = driver != world.participants.end() ? glm::length(driver->velocity_mps) : 0.0;
  advance_ice({world.environment.temperature_k, driver_speed_mps}, step_s, world.tick + effects_step_ticks, state.ice);

  StateHash hash;
  hash.add(state.hash);
  // Hashes the smoke's new keyframes, which follow wholly from it.
  for (const EffectKeyframe& keyframe : state.fires.keyframes)
    if (keyframe.tick == world.tick) hash.add_bytes(keyframe.data);
  for (const ice::Pane& pane : state.ice.panes) {
    hash.add(pane.vehicle);
    for (const double glass_k : pane.frost.glass_k) hash.add(glass_k);
    for (const double melted : pane.frost.melted_kgpm2) hash.add(melted);
    for (const ice::Star& star : pane.stars) hash.add(star.seed);
  }
  debris::add_to_hash(state.debris, hash);
  hash_members(hash, state.random);
  state.hash = hash.value();

  report.published = publish(debris_offers(state.debris), world.tick + effects_step_ticks, {}, state.published);
  return report;
}

std::vector<EffectKeyframe> effect_keyframes(const EffectsState& state) {
  std::vector<EffectKeyframe> keyframes = state.fires.keyframes;
  keyframes.insert(keyframes.end(), state.published.keyframes.begin(), state.published.keyframes.end());
  for (const EffectKeyframe& keyframe : {state.ice.keyframe, state.ice.glass_keyframe, state.dents.keyframe})
    if (!keyframe.data.empty()) keyframes.push_back(keyframe);
  return keyframes;
}

void show_damage(const EffectsState& state, std::vector<Participant>& participants) {
  if (state.crashes.parts.empty()) return;
  for (Participant& participant : participants) {
    const auto parts = state.crashes.parts.find(participant.id);
    if (parts == state.crashes.parts.end()) continue;
    const auto has_lamp = [&](double side) {
      return std::ranges::any_of(parts->second, [&](const debris::MountedPart& mounted) {
        return mounted.part == debris::Part::lamp && side * mounted.box_from_part.position_m.x > 0.0;
      });
    };
    if (!has_lamp(1.0))
      for (const Lamp lamp : {Lamp::low_beam, Lamp::high_beam}) participant.lamps.set(lamp, false);
    if (!has_lamp(-1.0))
      for (const Lamp lamp : {Lamp::brake, Lamp::reverse}) participant.lamps.set(lamp, false);
  }
}

double obstacle_height_m(const EffectsState& state, const Vec3& surface_point_m) {
  // Half a tyre's width; the height that a tyre climbs without the rim.
  constexpr double patch_m = 0.12, climbed_m = 0.10;
  const auto highest = debris::highest_debris_m(state.debris, surface_point_m.x, surface_point_m.y, patch_m);
  if (!highest) return 0.0;
  const double height = *highest - surface_point_m.z;
  return height > 1.0 ? 0.0 : std::clamp(height, 0.0, climbed_m);  // Debris in the air is no obstacle.
}

}  // namespace septet::simulation
