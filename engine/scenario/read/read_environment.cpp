#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {
namespace {

constexpr double most_mm_per_h = 1e4;

void read_weather(const Element& weather, EnvironmentAction& action) {
  if (weather.has("fractionalCloudCover")) {
    action.cloud_cover = weather.word<double>("fractionalCloudCover",
                                              {{"zeroOktas", 0.0},
                                               {"oneOktas", 0.125},
                                               {"twoOktas", 0.25},
                                               {"threeOktas", 0.375},
                                               {"fourOktas", 0.5},
                                               {"fiveOktas", 0.625},
                                               {"sixOktas", 0.75},
                                               {"sevenOktas", 0.875},
                                               {"eightOktas", 1.0},
                                               {"nineOktas", 1.0}},
                                              0.0);
  } else if (weather.has("cloudState")) {
    // OpenSCENARIO 1.0 and 1.1.
    action.cloud_cover = weather.word<double>(
        "cloudState", {{"free", 0.0}, {"cloudy", 0.5}, {"overcast", 1.0}, {"rainy", 1.0}, {"skyOff", 0.0}}, 0.0);
  }
  action.temperature_k = weather.optional_number("temperature", 0.0, 1000.0);
  if (const Element sun = weather.child("Sun")) {
    action.sun_azimuth_rad = sun.number("azimuth");
    action.sun_elevation_rad = sun.number("elevation");
    action.sun_illuminance_lux = sun.optional_number("illuminance", 0.0, 1e9);
    // Versions 1.0 and 1.1 wrote intensity and meant lux.
    if (!action.sun_illuminance_lux) action.sun_illuminance_lux = sun.optional_number("intensity", 0.0, 1e9);
  }
  if (const Element fog = weather.child("Fog")) action.visibility_m = fog.number("visualRange", 0.0);
  if (const Element precipitation = weather.child("Precipitation")) {
    const double mm_per_h = precipitation.number_or(
        "precipitationIntensity", precipitation.number_or("intensity", 0.0, 0.0, most_mm_per_h), 0.0, most_mm_per_h);
    enum class Kind { dry, rain, snow };
    const Kind kind = precipitation.word<Kind>(
        "precipitationType", {{"dry", Kind::dry}, {"rain", Kind::rain}, {"snow", Kind::snow}}, Kind::dry);
    action.rain_mm_per_h = kind == Kind::rain ? mm_per_h : 0.0;
    action.snow_mm_per_h = kind == Kind::snow ? mm_per_h : 0.0;
  }
  if (const Element wind = weather.child("Wind")) {
    action.wind_direction_rad = wind.number("direction");
    action.wind_speed_mps = wind.number("speed", 0.0, 200.0);
  }
}

}  // namespace

EnvironmentAction read_environment_action(Reading& reading, const Element& element) {
  Element environment = element.child("Environment");
  environment = environment ? with_declared_parameters(environment)
                            : resolve_catalog_reference(reading, element, {"Environment"});
  if (!environment) {
    if (!element.child("CatalogReference")) element.error("it has no environment", "add <Environment>");
    return {};
  }
  return read_environment(environment);
}

EnvironmentAction read_environment(const Element& environment) {
  EnvironmentAction action;
  action.name = environment.label("name");
  // The sun is given by its angles; a fixed time of day adds nothing to the picture.
  if (const Element time = environment.child("TimeOfDay")) {
    time.ignore();
    if (time.boolean_or("animation", false) || !environment.child("Weather").child("Sun")) {
      time.warning("the time of day does not move the sun",
                   "give the sun's angles in <Sun>, and new ones when they change");
    }
  }
  if (const Element weather = environment.child("Weather")) read_weather(weather, action);
  if (const Element road = environment.child("RoadCondition")) {
    action.friction_scale = road.number("frictionScaleFactor", 0.0, 100.0);
    // The standard has falling precipitation, but no lying snow or frost, on the road or on a windscreen.
    for (const Element& property : road.child("Properties").children("Property"))
      if (const std::string name = property.text("name"); name == "septet:snowCover")
        action.snow_cover = std::clamp(property.number("value", 0.0), 0.0, 1.0);
      else if (name == "septet:frost")
        action.frost = std::clamp(property.number("value", 0.0), 0.0, 1.0);
    if (road.has("wetness")) {
      action.road_wetness = road.word<double>(
          "wetness",
          {{"dry", 0.0}, {"moist", 0.25}, {"wetWithPuddles", 0.6}, {"lowFlooded", 0.9}, {"highFlooded", 1.0}}, 0.0);
    }
  }
  return action;
}

TrafficSwarmAction read_traffic_swarm(Reading& reading, const Element& element) {
  TrafficSwarmAction action;
  action.inner_radius_m = element.number("innerRadius", 0.0);
  action.semi_major_axis_m = element.number("semiMajorAxis", 0.0);
  action.semi_minor_axis_m = element.number("semiMinorAxis", 0.0);
  action.offset_m = element.number("offset");
  action.vehicle_count =
      static_cast<std::uint32_t>(element.integer("numberOfVehicles", 0, static_cast<int>(most_swarm_vehicles)));
  // Version 1.0 names the entity in an attribute `entityRef` of <CentralObject> as well.
  if (const Element central = element.required("CentralObject"))
    action.central = read_entity_reference(reading, central);
  if (const Element speeds = element.child("InitialSpeedRange")) {
    action.lowest_initial_speed_mps = speeds.number("lowerLimit", 0.0);
    action.highest_initial_speed_mps = speeds.number("upperLimit", action.lowest_initial_speed_mps);
  }
  if (const Element directions = element.child("DirectionOfTravelDistribution")) {
    action.same_direction_weight = directions.number("same", 0.0);
    action.opposite_direction_weight = directions.number("opposite", 0.0);
  }
  if (const Element definition = element.child("TrafficDefinition")) {
    definition.label("name");
    for (const Element& entry :
         definition.child("VehicleCategoryDistribution").children("VehicleCategoryDistributionEntry")) {
      action.categories.push_back({entry.text("category"), entry.number("weight", 0.0)});
    }
    // Septet's own traffic drives every vehicle of a swarm; other controllers are reported.
    for (const Element& entry : definition.child("ControllerDistribution").children("ControllerDistributionEntry")) {
      entry.number("weight", 0.0);
      const Element controller = entry.child("Controller");
      if (controller && controller.label("name") == "septet-traffic") controller.ignore();
    }
  }
  return action;
}

}  // namespace septet::scenario
