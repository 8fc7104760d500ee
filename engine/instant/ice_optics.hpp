#pragma once
/// Light at and in ice: Seipel and Nivfors, "Efficient Rendering of Multiple Refractions and Reflections in Natural
/// Objects" (SIGRAD 2006), equations 1 to 4, each beside its physical counterpart. The shaders' copy is
/// shaders/ice.glsl.
///
/// Vectors are unit vectors in one frame: `eye` goes from the viewer to the surface, normals point out of the ice. Pure
/// functions; any thread.

#include <optional>

#include "engine/math/rigid_transform.hpp"

namespace septet::ice {

inline constexpr double air_index = 1.0003, ice_index = 1.3091;
/// η of equation 2 where light enters the ice, 0.7641.
inline constexpr double into_ice = air_index / ice_index, out_of_ice = ice_index / air_index;
/// Share of the back face's normal in the paper's pictures.
inline constexpr double paper_back_share = 0.33;

/// Sign of the back face's normal in equation 1. The paper's text subtracts it and does not give the direction of the
/// normals in its buffer. With normals that point outwards the printed sign bends light less than the front face alone,
/// the other one more, as a lens does.
enum class BackSign : int { as_printed = -1, as_a_lens = 1 };

/// Equation 1, n_r = n_f (1 − a) − n_b a; made a unit vector, which equation 2 assumes.
Vec3 blended_normal(const Vec3& front_normal, const Vec3& back_normal, double back_share = paper_back_share,
                    BackSign sign = BackSign::as_printed);

/// Equation 2, r = η e − (η (n·e) + √(1 − η² (1 − (n·e)²))) n, for a normal against the eye vector; empty where all
/// light is reflected.
std::optional<Vec3> refraction_vector(const Vec3& eye, const Vec3& normal, double eta);

/// Equation 3, r = e − 2 (n_f·e) n_f.
Vec3 reflection_vector(const Vec3& eye, const Vec3& normal);

/// Equation 4, f = (1 − |e·n|)³: the share of reflected light.
double fresnel_share(const Vec3& eye, const Vec3& normal);

/// Share of reflected light by Fresnel's equations for unpolarised light; `eta` as in refraction_vector. 1 where all
/// light is reflected.
double exact_fresnel_share(const Vec3& eye, const Vec3& normal, double eta);

/// Absorption of clear ice at 610, 550 and 465 nm, 1/m (Warren and Brandt, "Optical constants of ice", 2008, table 1:
/// 4πk/λ).
inline constexpr Vec3 clear_ice_absorption_per_m{0.13, 0.045, 0.007};

/// Share of light that is left after a path through ice (Beer and Lambert).
Vec3 transmittance(const Vec3& absorption_per_m, double way_m);

}  // namespace septet::ice
