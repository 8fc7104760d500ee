#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "engine/scenario/model/misc_object.hpp"
#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {
namespace {

Axle read_axle(const Element& axle) {
  if (!axle) return {};
  return {axle.number("maxSteering"), axle.number("wheelDiameter", 0.0), axle.number("trackWidth", 0.0),
          axle.number("positionX"), axle.number("positionZ")};
}

void read_vehicle(const Element& vehicle, Entity& entity) {
  entity.kind = EntityKind::vehicle;
  entity.category = vehicle.text("vehicleCategory");
  entity.role = vehicle.text_or("role", "none");
  const Element performance = vehicle.required("Performance");
  if (performance) {
    entity.performance = {performance.number("maxSpeed", 0.0), performance.number("maxAcceleration", 0.0),
                          performance.number("maxDeceleration", 0.0)};
  }
  const Element axles = vehicle.required("Axles");
  entity.front_axle = read_axle(axles.child("FrontAxle"));
  entity.rear_axle = read_axle(axles.child("RearAxle"));
}

Element find_object(Reading& reading, const Element& parent) {
  for (const char* kind : {"Vehicle", "Pedestrian", "MiscObject"}) {
    if (const Element found = parent.child(kind)) return with_declared_parameters(found);
  }
  const Element reference = parent.child("CatalogReference");
  if (!reference) {
    parent.error("it names no vehicle, pedestrian or misc object",
                 "add <Vehicle>, <Pedestrian>, <MiscObject> or <CatalogReference>");
    return {};
  }
  return resolve_catalog_reference(reading, parent, {"Vehicle", "Pedestrian", "MiscObject"});
}

}  // namespace

void read_object(const Element& object, Entity& entity) {
  entity.type_name = object.label("name");
  entity.mass_kg = object.number_or("mass", 0.0, 0.0);
  object.text_or("model3d", "");
  if (object.name() == "Vehicle") {
    read_vehicle(object, entity);
  } else if (object.name() == "Pedestrian") {
    entity.kind = EntityKind::pedestrian;
    entity.category = object.text("pedestrianCategory");
    entity.role = object.text_or("role", "none");
    object.text_or("model", "");
  } else {
    entity.kind = EntityKind::misc_object;
    entity.category = object.text("miscObjectCategory");
  }
  entity.box = read_bounding_box(object);
  if (object_form(entity) == ObjectForm::flat)
    object.warning(
        fmt::format("what lies flat on the road (\"{}\") is not drawn, and nobody can hit it", entity.category),
        "paint it in the road file, or give it another category");
  for (const Element& property : object.child("Properties").children("Property")) {
    entity.properties[property.label("name")] = property.label("value");
  }
}

BoundingBox read_bounding_box(const Element& parent) {
  constexpr double most_m = 1000.0;
  const Element box = parent.required("BoundingBox");
  const Element centre = box.required("Center"), dimensions = box.required("Dimensions");
  BoundingBox result;
  if (centre) {
    result.centre_m = {centre.number("x", -most_m, most_m), centre.number("y", -most_m, most_m),
                       centre.number("z", -most_m, most_m)};
  }
  if (dimensions) {
    result.length_m = dimensions.number("length", 0.0, most_m);
    result.width_m = dimensions.number("width", 0.0, most_m);
    result.height_m = dimensions.number("height", 0.0, most_m);
    if (result.length_m * result.width_m * result.height_m == 0.0)
      dimensions.warning("the box holds nothing", "give its length, width and height");
  }
  return result;
}

void read_entities(Reading& reading, const Element& entities) {
  bool too_many = false;
  for (const Element& object : entities.children("ScenarioObject")) {
    if (reading.scenario.entities.size() == most_entities) {
      // One fault, not one for each further entity, nor for each reference below.
      if (!too_many)
        object.error(fmt::format("there are more than {} entities", most_entities),
                     "leave the others to a traffic swarm");
      too_many = reading.names_are_elsewhere = true;
      object.ignore();
      continue;
    }
    Entity entity;
    entity.name = object.text("name");
    const auto index = static_cast<EntityIndex>(reading.scenario.entities.size());
    if (!reading.entities.try_emplace(entity.name, index).second) {
      object.error(fmt::format("there are two entities named \"{}\"", entity.name), "give each its own name");
      continue;
    }
    if (const Element found = find_object(reading, object)) read_object(found, entity);
    entity.model = match_vehicle_model(entity);
    reading.scenario.entities.push_back(std::move(entity));
  }
}

EntityIndex read_entity_reference(Reading& reading, const Element& element, const char* attribute) {
  const std::string name = element.text(attribute);
  if (name.empty()) return no_entity;
  const auto found = reading.entities.find(name);
  if (found != reading.entities.end()) return found->second;
  if (reading.names_are_elsewhere) return no_entity;
  element.error(fmt::format("no entity is named \"{}\"", name), "name a <ScenarioObject> of this file");
  return no_entity;
}

}  // namespace septet::scenario
