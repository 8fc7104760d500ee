#pragma once
/// Isotropic elastic material by the constants of a handbook.

namespace septet::elastic {

struct ElasticMaterial {
  double young_modulus_pa = 1e9;
  double poisson_ratio = 0.25;  ///< Must be below one half: at exactly one half the primal form has no limit.
  double density_kgpm3 = 1000.0;
};

/// Lamé's constants. Y = μ(3λ+2μ)/(λ+μ), ν = λ/(2(λ+μ)); Servin et al. print 3λ+μ, which is a slip.
struct LameConstants {
  double lambda_pa = 0.0, mu_pa = 0.0;
};

inline LameConstants lame_constants(const ElasticMaterial& m) {
  return {m.young_modulus_pa * m.poisson_ratio / ((1.0 + m.poisson_ratio) * (1.0 - 2.0 * m.poisson_ratio)),
          m.young_modulus_pa / (2.0 * (1.0 + m.poisson_ratio))};
}

}  // namespace septet::elastic
