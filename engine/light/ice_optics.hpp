#ifndef SEPTET_LIGHT_ICE_OPTICS_HPP
#define SEPTET_LIGHT_ICE_OPTICS_HPP
/// Light at and in ice: Seipel and Nivfors, "Efficient Rendering of Multiple Refractions and Reflections in Natural Objects"
/// (SIGRAD 2006), equations 1 to 4, and beside them what physics says (fresnel.hpp).
///
/// Vectors are unit vectors in one frame: `eye` goes from the viewer to the surface, normals point out of the ice.

#include "engine/light/language.hpp"

LIGHT_BEGIN

LIGHT_CONST float air_index = 1.0003f;
LIGHT_CONST float ice_index = 1.3091f;
/// η of equation 2 where light enters the ice, 0.7641, and where it leaves it.
LIGHT_CONST float into_ice = air_index / ice_index;
LIGHT_CONST float out_of_ice = ice_index / air_index;
/// Share of the back face's normal in the paper's pictures.
LIGHT_CONST float paper_back_share = 0.33f;

/// Absorption of clear ice at 610, 550 and 465 nm, 1/m (Warren and Brandt, "Optical constants of ice", 2008, table 1: 4πk/λ).
LIGHT_CONST vec3 clear_ice_absorption_per_m = vec3(0.13f, 0.045f, 0.007f);

/// Equation 1, n_r = n_f (1 − a) − n_b a; made a unit vector, which equation 2 takes for granted. `front_share` is 1 − a, `back_share` −a as
/// printed. The paper does not say which way the normals of its buffer pointed: with normals that point outwards the printed sign bends light less
/// than the front face alone, +a bends it more, as a lens does. Where the two cancel, the front face's.
LIGHT_FN vec3 blended_normal(vec3 front_normal, vec3 back_normal, float front_share, float back_share) {
  const vec3 sum = front_share * front_normal + back_share * back_normal;
  return dot(sum, sum) > 1e-6f ? normalize(sum) : front_normal;
}

/// Equation 2, r = η e − (η (n·e) + √(1 − η² (1 − (n·e)²))) n, for a normal against the eye vector; of length 0 where all light is reflected.
LIGHT_FN vec3 refracted(vec3 eye, vec3 normal, float eta) {
  const float cosine = dot(normal, eye), square = 1.0f - eta * eta * (1.0f - cosine * cosine);
  return square < 0.0f ? vec3(0.0f) : eta * eye - (eta * cosine + sqrt(max(square, 0.0f))) * normal;
}

/// Equation 3, r = e − 2 (n_f·e) n_f.
LIGHT_FN vec3 mirrored_way(vec3 eye, vec3 normal) { return eye - 2.0f * dot(normal, eye) * normal; }

/// Equation 4, f = (1 − |e·n|)³: the share of reflected light. `cosine`: |e·n|.
LIGHT_FN float paper_fresnel(float cosine) {
  const float grazing = 1.0f - cosine;
  return grazing * grazing * grazing;
}

/// Share of light that is left after a way through a body (Beer and Lambert).
LIGHT_FN vec3 transmittance(vec3 absorption_per_m, float way_m) { return exp(-absorption_per_m * way_m); }

LIGHT_END

#endif
