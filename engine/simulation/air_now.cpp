#include "engine/simulation/air_now.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/effects/smoke/visibility.hpp"
#include "engine/sight/air.hpp"

namespace septet::simulation {

Air air_of(const State& state) {
  const Environment& weather = state.scenario.environment;
  Air air;
  if (state.effects.fires.smoke) air.smoke = &*state.effects.fires.smoke;
  air.per_m = sight::fog_extinction_per_m(weather.visibility_m) +
              sight::fall_extinction_per_m(weather.rain_mm_per_h, weather.temperature_k);
  air.natural_lx = weather.sun_illuminance_lux * std::max(0.0, std::sin(weather.sun_elevation_rad));
  return air;
}

double depth_between(const Air& air, const Vec3& from_m, const Vec3& to_m) {
  const double depth = air.per_m * glm::distance(from_m, to_m);
  return air.smoke ? depth + smoke::optical_depth(*air.smoke, from_m, to_m) : depth;
}

sight::OpticalDepth depth_for_lamps(const Air& air, double within_m) {
  if (!air.smoke && air.per_m * within_m <= sight::shining_depth) return {};
  return [air](const Vec3& from_m, const Vec3& to_m) { return depth_between(air, from_m, to_m); };
}

bool shines(const State& state, const Participant& vehicle) {
  for (const Lamp lamp : {Lamp::low_beam, Lamp::high_beam, Lamp::rear_fog, Lamp::brake, Lamp::beacon,
                          Lamp::indicator_left, Lamp::indicator_right})
    if (vehicle.lamps.has(lamp)) return true;
  return std::ranges::any_of(state.effects.fires.fires,
                             [&](const Fire& fire) { return fire.vehicle == vehicle.id && fire.burning; });
}

bool has_beams(const Participant& vehicle) {
  return vehicle.lamps.has(Lamp::low_beam) || vehicle.lamps.has(Lamp::high_beam);
}

bool is_roofed(const road::RoadNetwork& network, const road::RoadPosition& place) {
  return road::structure_at(network.roads[place.road], place.s_m, road::RoadStructure::Kind::tunnel) != nullptr;
}

}  // namespace septet::simulation
