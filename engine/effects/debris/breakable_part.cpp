#include "engine/effects/debris/breakable_part.hpp"

#include "engine/core/check.hpp"

namespace septet::debris {

const MaterialData& material_data(Material material) {
  switch (material) {
#define SEPTET_ENTRY(name, ...)                     \
  case Material::name: {                            \
    static constexpr MaterialData data __VA_ARGS__; \
    return data;                                    \
  }
#include "engine/effects/debris/materials.toml.inc"
  }
  SEPTET_CHECK(false, "material {}", static_cast<int>(material));
}

int axis_across(const PartRecipe& recipe) { return recipe.cells.x == 1 ? 0 : recipe.cells.y == 1 ? 1 : 2; }

namespace {

PartRecipe with_mass(PartRecipe recipe) {
  if (!(recipe.sheet_m > 0.0)) return recipe;
  const double area_m2 = recipe.size_m.x * recipe.size_m.y * recipe.size_m.z / recipe.size_m[axis_across(recipe)];
  recipe.mass_kg = material_data(recipe.material).elastic.density_kgpm3 * area_m2 * recipe.sheet_m;
  return recipe;
}

}  // namespace

const PartRecipe& part_recipe(Part part) {
  switch (part) {
#define SEPTET_ENTRY(name, ...)                                       \
  case Part::name: {                                                  \
    static const PartRecipe data = with_mass(PartRecipe __VA_ARGS__); \
    return data;                                                      \
  }
#include "engine/effects/debris/parts.toml.inc"
  }
  SEPTET_CHECK(false, "part {}", static_cast<int>(part));
}

MaterialData spread_material(const PartRecipe& recipe) {
  MaterialData data = material_data(recipe.material);
  const double mean_width = 0.5 * (1.0 + recipe.taper);
  const double area_factor =
      recipe.taper == 1.0 ? 1.0 : mean_width * mean_width + (1.0 - recipe.taper) * (1.0 - recipe.taper) / 12.0;
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
