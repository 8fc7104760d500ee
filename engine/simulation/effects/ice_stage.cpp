#include "engine/simulation/effects/ice_stage.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/effects/debris/breakable_part.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/roadside/bridge_shape.hpp"
#include "engine/roadside/tunnel_shape.hpp"

namespace septet::simulation {
namespace {

/// Gap between a roof and the slab on it, as in spill().
constexpr double over_roof_m = 0.02;

bool overlap(const ice::LyingSlab& a, const ice::LyingSlab& b) {
  return a.vehicle == b.vehicle && std::abs(a.foot_m.x - b.foot_m.x) < 0.5 * (a.size_m.x + b.size_m.x) &&
         std::abs(a.foot_m.y - b.foot_m.y) < 0.5 * (a.size_m.y + b.size_m.y);
}

/// Skips a slab that finds no room on the roof: it appears when it is spilled.
void lay(const scenario::EffectAction& action, const scenario::Entity& entity, ParticipantId vehicle,
         ice::StillIce& still) {
  ice::LyingSlab slab;
  slab.vehicle = vehicle;
  slab.size_m = debris::part_recipe(debris::Part::ice_slab).size_m;
  slab.foot_m = {action.x_m, action.y_m, entity.box.centre_m.z + 0.5 * entity.box.height_m + over_roof_m};
  const auto on_roof = [](double at, double middle, double length, double size) {
    return std::abs(at - middle) + 0.5 * size <= 0.5 * length + 0.1;
  };
  if (!on_roof(action.x_m, entity.box.centre_m.x, entity.box.length_m, slab.size_m.x) ||
      !on_roof(action.y_m, entity.box.centre_m.y, entity.box.width_m, slab.size_m.y))
    return;
  if (std::ranges::none_of(still.slabs, [&](const ice::LyingSlab& other) { return overlap(slab, other); }))
    still.slabs.push_back(slab);
}

/// Hangs icicles along the edge from `from_m` to `to_m`, in rows of some metres, as screens choose their detail by
/// distance.
void hang(const Vec3& from_m, const Vec3& to_m, double longest_m, std::uint64_t seed, ice::StillIce& still) {
  constexpr double row_m = 4.0;
  const double length_m = glm::length(to_m - from_m);
  const int rows = std::max(1, static_cast<int>(std::lround(length_m / row_m)));
  for (int i = 0; i < rows && still.rows.size() < ice::most_rows; ++i)
    still.rows.push_back({from_m + (to_m - from_m) * (static_cast<double>(i) / rows),
                          from_m + (to_m - from_m) * (static_cast<double>(i + 1) / rows), longest_m,
                          static_cast<std::uint32_t>(seed * 7919 + still.rows.size())});
}

void hang_at_tunnel(const road::RoadNetwork& roads, road::RoadIndex index, const road::RoadStructure& tunnel,
                    std::uint64_t seed, ice::StillIce& still) {
  using namespace roadside::tunnel_shape;
  for (const double outwards : {-1.0, 1.0}) {
    const double mouth = outwards < 0 ? tunnel.s_m : tunnel.s_m + tunnel.length_m;
    const road::RoadExtent extent = road::road_extent(roads.roads[index], mouth);
    const auto at = [&](double t_m) {
      return road::evaluate(roads, {index, mouth + outwards * (portal_before_m + 0.03), t_m}).position_m +
             Vec3(0.0, 0.0, ceiling_m);
    };
    hang(at(extent.left_t_m + wall_clear_m - haunch_width_m), at(middle_wall_m), 0.9, seed, still);
    hang(at(-middle_wall_m), at(extent.right_t_m - wall_clear_m + haunch_width_m), 0.9, seed, still);
  }
}

void hang_at_bridge(const road::RoadNetwork& roads, road::RoadIndex index, const road::RoadStructure& bridge,
                    std::uint64_t seed, ice::StillIce& still) {
  using namespace roadside::bridge_shape;
  constexpr double step_m = 16.0;
  const int steps = std::clamp(static_cast<int>(std::lround(bridge.length_m / step_m)), 1, 64);
  for (const double side : {1.0, -1.0})
    for (int i = 0; i < steps; ++i) {
      const auto at = [&](int k) {
        const double s_m = bridge.s_m + bridge.length_m * k / steps;
        const road::RoadExtent extent = road::road_extent(roads.roads[index], s_m);
        const double t_m = side > 0 ? extent.left_t_m + overhang_m : extent.right_t_m - overhang_m;
        const road::RoadPoint point = road::evaluate(roads, {index, s_m, t_m});
        return point.position_m + road::world_from_road(point).orientation * Vec3(0.0, 0.0, edge_foot_m);
      };
      hang(at(i), at(i + 1), 0.6, seed + (side > 0 ? 1 : 2), still);
    }
}

/// Frost of the scenario's Init, its last value, 0 to 1.
double frost_asked_for(const scenario::Scenario& scenario) {
  double share = 0.0;
  for (const scenario::InitAction& action : scenario.init)
    if (const auto* environment = std::get_if<scenario::EnvironmentAction>(&action.what))
      share = environment->frost.value_or(share);
  return share;
}

void renew(EffectKeyframe& keyframe, std::uint32_t id, std::uint16_t kind, Bytes data, Tick shows) {
  if (data != keyframe.data) keyframe = {id, kind, std::move(data), shows};
}

/// Renews the keyframes of panes; one that has been non-empty also shows that its panes are gone.
void tell_panes(Tick shows, IceState& state) {
  if (!state.panes.empty() || !state.glass_keyframe.data.empty())
    renew(state.glass_keyframe, ice::glass_effect_id, ice::glass_keyframe_kind, ice::encode_glass(state.panes), shows);
}
void tell_still_ice(Tick shows, IceState& state) {
  if (!state.still.empty() || !state.keyframe.data.empty())
    renew(state.keyframe, ice::effect_id, ice::keyframe_kind, ice::encode(state.still), shows);
}

}  // namespace

IceState initial_ice(const road::RoadNetwork& roads, const scenario::Scenario& scenario,
                     const scenario::ScenarioState& storyboard, scenario::EntityIndex driver, ParticipantId driver_id,
                     ParticipantId first_id, std::uint64_t seed) {
  IceState state;
  for (const scenario::Story& story : scenario.stories)
    for (const scenario::Act& act : story.acts)
      for (const scenario::ManeuverGroup& group : act.groups)
        for (const scenario::Maneuver& maneuver : group.maneuvers)
          for (const scenario::Event& event : maneuver.events)
            for (const scenario::Action& action : event.actions)
              if (const auto* effect = std::get_if<scenario::EffectAction>(&action.what);
                  effect && effect->kind == scenario::EffectAction::Kind::spill && effect->part == "ice-slab")
                lay(*effect, scenario.entities[effect->entity],
                    effect->entity == driver ? driver_id : first_id + effect->entity, state.still);
  if (const double air_k = storyboard.environment.temperature_k; air_k < ice::freezing_k) {
    ice::Frost frost = ice::morning_frost(air_k, static_cast<std::uint32_t>(seed));
    frost.thickness_kgpm2 *= frost_asked_for(scenario);
    if (frost.thickness_kgpm2 > 0.0) state.panes.push_back({driver_id, frost, {}});
    for (road::RoadIndex i = 0; i < roads.roads.size(); ++i)
      for (const road::RoadStructure& structure : roads.roads[i].structures)
        (structure.kind == road::RoadStructure::Kind::tunnel ? hang_at_tunnel : hang_at_bridge)(roads, i, structure,
                                                                                                seed, state.still);
  }
  // The world may stand at its first instant until the driver is ready: its ice is shown then, too.
  tell_panes(0, state);
  tell_still_ice(0, state);
  return state;
}

void freeze(const road::RoadNetwork& roads, const scenario::EffectAction& action, IceState& state) {
  const auto road = road::find_road(roads, action.road);
  if (!road || state.black.size() >= ice::most_sheets) return;
  const BlackIce black{*road, action.lane, action.s_m, action.length_m, action.thickness_m};
  ice::Sheet sheet = sheet_of(roads, black);
  if (sheet.left_m.size() < 2) return;
  // From now on the ice has its stated thickness, whatever has thawed before.
  sheet.thickness_m += ice::melted_m(state.still.thawed_kh);
  state.black.push_back(black);
  state.black.back().thickness_m = sheet.thickness_m;
  state.still.sheets.push_back(std::move(sheet));
}

double release_slab(ParticipantId vehicle, const Vec2& place_m, double thickness_m, IceState& state) {
  std::erase_if(state.still.slabs, [&](const ice::LyingSlab& slab) {
    return slab.vehicle == vehicle && std::abs(slab.foot_m.x - place_m.x) < 1e-3 &&
           std::abs(slab.foot_m.y - place_m.y) < 1e-3;
  });
  return ice::left_m(thickness_m, state.still.thawed_kh) / thickness_m;
}

void shake_glass(const ShakenGlass& glass, IceState& state) {
  auto pane = std::ranges::find(state.panes, glass.vehicle, &ice::Pane::vehicle);
  if (glass.gone) {
    if (pane != state.panes.end()) state.panes.erase(pane);
    return;
  }
  if (!(glass.closing_mps >= ice::least_starring_mps)) return;
  if (pane == state.panes.end()) {
    if (state.panes.size() >= ice::most_panes) return;
    pane = state.panes.insert(pane, ice::Pane{glass.vehicle, {}, {}});
  }
  if (pane->stars.size() >= ice::most_stars) return;
  const std::uint64_t seed = std::bit_cast<std::uint64_t>(glass.closing_mps) ^ glass.vehicle;
  pane->stars.push_back(ice::star_of_blow(glass.across, glass.closing_mps, seed));
}

void advance_ice(const IceWeather& weather, double step_s, Tick shows, IceState& state) {
  if (!state.panes.empty() || !state.glass_keyframe.data.empty()) {
    for (ice::Pane& pane : state.panes) ice::warm(pane.frost, weather.temperature_k, weather.driver_speed_mps, step_s);
    std::erase_if(state.panes,
                  [](const ice::Pane& pane) { return pane.stars.empty() && !(pane.frost.thickness_kgpm2 > 0.0); });
    tell_panes(shows, state);
  }
  if (state.still.empty() && state.keyframe.data.empty()) return;
  state.still.thawed_kh += ice::degree_hours(weather.temperature_k, step_s);
  tell_still_ice(shows, state);
}

}  // namespace septet::simulation
