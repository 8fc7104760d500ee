#pragma once
/// Bodies of cars, vans and ambulances as control cages.
///
/// A cage is a grid: stations along the car, and on each station a ring of points from one sill over the roof to the
/// other. The shape's numbers place the few lines that distinguish the kinds of cars. Vehicle frame
/// (rigid_transform.hpp), metres.

#include "engine/geometry/polygon_mesh.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::scenery {

/// Lines of a car in side view. x is measured as the names say, z from the ground.
struct CarShape {
  float ground_m = 0.17f;         ///< Height of the sill.
  float belt_front_m = 0.93f;     ///< Lower edge of the side windows at the windscreen…
  float belt_rear_m = 0.97f;      ///< …and at the rear window.
  float hood_rear_m = 0.97f;      ///< Bonnet at the windscreen.
  float hood_front_m = 0.78f;     ///< Bonnet above the radiator.
  float deck_m = 0.98f;           ///< Boot lid, or the foot of a hatch's rear window.
  float tail_m = 0.88f;           ///< Upper edge of the tail.
  float cowl_m = 0.60f;           ///< Foot of the windscreen, behind the front axle.
  float roof_front_m = 1.45f;     ///< Head of the windscreen, behind the front axle.
  float roof_rear_m = 1.15f;      ///< Head of the rear window, before the tail.
  float backlight_m = 0.48f;      ///< Foot of the rear window, before the tail.
  float roof_half_width = 0.66f;  ///< Share of half the width, as are the next two.
  float nose_half_width = 0.74f;
  float tail_half_width = 0.84f;
  float roof_arch_m = 0.045f;  ///< Height of the roof's middle over its rails.
  bool third_window = false;   ///< True for estates, which have one behind the rear doors.
  float roof_below_m = 0.0f;   ///< Roof below the vehicle's height, where a box behind the cab is higher.
};

/// Shape of a model of the catalogue; lorry, motorcycle and pedestrian have no such shape (checked).
CarShape car_shape(const VehicleModel& model);

/// Control cage. After `subdivision_level` steps its bounds are those of the model, its top those of the shape's roof.
geometry::PolygonMesh car_body_cage(const VehicleModel& model, const CarShape& shape, std::uint32_t subdivision_level);

/// Body of a few dozen polygons with its windows, for far away; materials are Finish indices.
geometry::PolygonMesh car_body_far(const VehicleModel& model, const CarShape& shape);

}  // namespace septet::scenery
