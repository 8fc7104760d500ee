#include "engine/effects/debris/breakable_part.hpp"

#include <array>

namespace septet::debris {

const MaterialData& material_data(Material material) {
  // Young's modulus, Poisson's ratio, density; tensile, compressive strength, yield; friction;
  // energy of a crack; restitution. The sources are in DEBRIS.md, "Materials".
  static constexpr std::array<MaterialData, material_count> table{{
      {{210e9, 0.30, 7850}, 310e6, 310e6, 180e6, 0.45, 250e3, 0.20},
      {{1.5e9, 0.40, 950}, 25e6, 30e6, 18e6, 0.40, 10e3, 0.40},
      {{70e9, 0.20, 2500}, 45e6, 1000e6, 0, 0.40, 7.7, 0.40},
      {{9e9, 0.33, 917}, 1.4e6, 10e6, 0, 0.10, 1.1, 0.30},
      {{10e6, 0.45, 1100}, 15e6, 100e6, 0, 0.80, 10e3, 0.60},
      {{33e9, 0.20, 2400}, 2.9e6, 38e6, 0, 0.60, 140, 0.20},
  }};
  return table[static_cast<std::size_t>(material)];
}

const PartRecipe& part_recipe(Part part) {
  static const std::array<PartRecipe, part_count> table{{
      {Material::bumper_plastic, {1, 12, 2}, {0.08, 1.70, 0.30}, 4.5, 8, 1.0, false},
      {Material::steel_sheet, {6, 1, 5}, {1.10, 0.06, 0.90}, 18.0, 6, 1.0, false},
      {Material::bumper_plastic, {2, 3, 2}, {0.15, 0.35, 0.18}, 1.2, 10, 1.0, false},
      {Material::glass, {1, 10, 6}, {0.03, 1.40, 0.80}, 12.0, 60, 1.0, true},
      {Material::bumper_plastic, {2, 2, 5}, {0.28, 0.28, 0.50}, 2.5, 6, 0.25, false},
      {Material::concrete, {2, 2, 8}, {0.20, 0.20, 1.00}, 96.0, 10, 1.0, false},
      {Material::ice, {8, 5, 1}, {2.00, 1.20, 0.08}, 176.0, 24, 1.0, false},
  }};
  return table[static_cast<std::size_t>(part)];
}

MaterialData spread_material(const PartRecipe& recipe) {
  MaterialData data = material_data(recipe.material);
  const double mean_width = 0.5 * (1.0 + recipe.taper);
  const double area_factor = recipe.taper == 1.0
                                 ? 1.0
                                 : mean_width * mean_width +
                                       (1.0 - recipe.taper) * (1.0 - recipe.taper) / 12.0;
  const double density = recipe.mass_kg / (recipe.size_m.x * recipe.size_m.y * recipe.size_m.z * area_factor);
  const double fill = density / data.elastic.density_kgpm3;
  data.elastic.density_kgpm3 = density;
  data.elastic.young_modulus_pa *= fill;
  data.strength_pa *= fill;
  data.compressive_strength_pa *= fill;
  data.yield_pa *= fill;
  data.fracture_energy_jpm2 *= fill;
  return data;
}

}  // namespace septet::debris
