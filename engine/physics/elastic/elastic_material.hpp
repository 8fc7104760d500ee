#pragma once
/// Isotropic elastic material by the constants of a handbook.

namespace septet::elastic {

struct ElasticMaterial {
  double young_modulus_pa = 1e9;
  double poisson_ratio = 0.25;  ///< From 0 to one half, which is incompressible.
  double density_kgpm3 = 1000.0;
};

/// Ratios closer to one half than this count as one half: λ is over 5,000 μ there and drowns the shear in rounding.
inline constexpr double incompressible_margin = 1e-4;

inline bool is_incompressible(const ElasticMaterial& m) { return m.poisson_ratio > 0.5 - incompressible_margin; }

/// Lamé's constants. Y = μ(3λ+2μ)/(λ+μ), ν = λ/(2(λ+μ)); Servin et al. print 3λ+μ, which is a slip.
struct LameConstants {
  double lambda_pa = 0.0, mu_pa = 0.0;
};

/// Of an incompressible material λ is infinite. A hundred μ stand for it: not the material's, but the weight by which
/// held_volume.hpp finds the stress that keeps the volume.
inline LameConstants lame_constants(const ElasticMaterial& m) {
  const double mu_pa = m.young_modulus_pa / (2.0 * (1.0 + m.poisson_ratio));
  if (is_incompressible(m)) return {100.0 * mu_pa, mu_pa};
  return {m.young_modulus_pa * m.poisson_ratio / ((1.0 + m.poisson_ratio) * (1.0 - 2.0 * m.poisson_ratio)), mu_pa};
}

}  // namespace septet::elastic
