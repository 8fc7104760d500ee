#pragma once
/// Buildings of a town: walls with windows under a saddle roof, with doors, shop fronts, dormers; towers with a spire.

#include <compare>
#include <cstddef>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/roadside/standing_objects.hpp"
#include "engine/scenery/world/house_shape.hpp"

namespace septet::scenery {

inline constexpr std::size_t town_walls = 8;

struct TownBuilding {
  roadside::BuildingUse use = roadside::BuildingUse::house;
  double length_m = 10.0, width_m = 9.0, height_m = 8.0;  ///< Length along the street, which lies towards −y.
  std::size_t variant = 0;  ///< Chooses wall, roof and shop; those of neighbours should differ.

  bool operator==(const TownBuilding&) const = default;
  auto operator<=>(const TownBuilding&) const = default;
};

HouseLook look_of(const TownBuilding& building);

/// Its middle at the origin.
geometry::PolygonMesh town_building(const TownBuilding& building);

}  // namespace septet::scenery
