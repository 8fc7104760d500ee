#pragma once
/// Breakable parts and their materials.
///
/// Thin parts are lattices thicker than the real sheet. Mass, stiffness and strength are those of the sheet, spread
/// over the thicker section: they, and the energy of a crack, are multiplied by the fill, the sheet's volume over the
/// lattice's. A part with a thickness of its own (`sheet_m`) has its mass from it, and bends as that sheet does
/// (engine/physics/elastic/shell.hpp). The values and their sources stand in materials.toml and parts.toml beside this file.

#include <cstdint>

#include <glm/vec3.hpp>

#include "engine/math/rigid_transform.hpp"
#include "engine/physics/elastic/elastic_material.hpp"

namespace septet::debris {

enum class Material : std::uint8_t { steel_sheet, bumper_plastic, glass, ice, rubber, concrete, tempered_glass };
inline constexpr int material_count = 7;

struct MaterialData {
  elastic::ElasticMaterial elastic;
  double strength_pa;              ///< Largest tensile stress across a face before it opens.
  double compressive_strength_pa;  ///< Unconfined: beyond it faces along the pressure open.
  double yield_pa;                 ///< Von Mises stress from which it flows; 0: it never flows.
  double friction;                 ///< On dry asphalt.
  double fracture_energy_jpm2;     ///< Energy of a crack for each square metre of its area.
  double restitution;              ///< Share of the closing speed that an impact returns.
};
const MaterialData& material_data(Material material);

enum class Part : std::uint8_t { bumper, door, lamp, windscreen, traffic_cone, barrier_post, ice_slab, side_window };
inline constexpr int part_count = 8;

/// What becomes of a part whose material gives way.
enum class Breakage : std::uint8_t {
  pieces,    ///< It falls into elastic pieces, which may break further.
  holds,     ///< Laminated: it cracks, and a film between its panes keeps it in one piece (laminate.hpp).
  crumbles,  ///< Tempered: all of it falls into rigid shards at once, for it is the edge of the tension within it.
};

struct PartRecipe {
  Material material;
  glm::ivec3 cells;      ///< Lattice cubes along x, y, z; five tetrahedra each.
  Vec3 size_m;           ///< Outer box; x forward, y left, z up, centred on the part's origin.
  double mass_kg = 0.0;  ///< Of a sheet: by its thickness.
  int splinters;         ///< Number of Voronoi cells into which it can break.
  double taper;          ///< Width of the top over that of the foot.
  Breakage breakage;
  double sheet_m = 0.0;  ///< Thickness of a sheet, across the axis along which it is one cube; 0: it is none.
};
const PartRecipe& part_recipe(Part part);

/// The material of a part's lattice: spread over its section, as above.
MaterialData spread_material(const PartRecipe& recipe);

/// The axis along which a sheet is one cube.
int axis_across(const PartRecipe& recipe);

}  // namespace septet::debris
