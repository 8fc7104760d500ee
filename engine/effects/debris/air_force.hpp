#pragma once
/// Force of the air on debris: that on a flat plate, face by face on a piece, as its mean over all attitudes on a shard.
///
/// A plate of area A in a wind w at the angle of attack α between them is pressed along its normal with
///     N = C_N(α) ½ρw²A,   C_N = 1.7 α/40° up to 40°, where the flow parts, and 1.15 beyond,
/// at a place before its middle by c(α) of its length along the wind:
///     c = 0.3 − 0.22 α/38° up to 38°,   0.08 cos 2(α − 38°) up to 82.5°,   0 beyond
/// (J. D. Holmes, C. W. Letchford and N. Lin, "Investigations of plate-type windborne debris, part II", J. Wind Eng.
/// Ind. Aerodyn. 94, 2006; P. J. Richards et al., "Numerical calculation of the three-dimensional motion of wind-borne
/// debris", the same 96, 2008; after ESDU 70015; the values were not checked against their texts). Drag is
/// N sin α and lift N cos α. How far that carries a plate of mass m is told by its Tachikawa number ρw²A/2mg
/// (M. Tachikawa, "Trajectories of flat plates in uniform flow", the same 14, 1983): 0.5 for 80 mm of ice at 25 m/s, 4
/// for 10 mm.
///
/// A plate's two faces bear half of N each. Each triangle of a surface has the wind past its own middle, so that a turn
/// is damped. A block is met by its front and its back, with 1.15; its sides, along the wind, bear nothing.
///
/// Shards turn about all their axes, and their lift points everywhere in turn. The mean of a plate's drag over all
/// attitudes, with the sine u of the angle of attack even between 0 and 1, is that of its mean shade ½A at
///     C = 2 ∫ C_N u du = 1.7 (sin 80°/(4·40°) − ½ cos 80°) + 1.15 cos² 40° = 1.127, 40° in radians.
/// World frame of Septet; pure functions.

#include "engine/effects/debris/piece.hpp"

namespace septet::debris {

inline constexpr double air_density_kgpm3 = 1.2;  ///< At 20 °C and sea level.

/// C_N of a plate, of the sine of its angle of attack, 0 to 1.
double plate_normal_coefficient(double sine_of_attack);

/// c of a plate: how far before its middle it is pressed, as a share of its length along the wind.
double plate_pressure_offset(double sine_of_attack);

/// C of a body that turns about all its axes, above.
inline constexpr double tumbling_coefficient = 1.127;

/// Velocity past the air of a tumbling body of this mass after `step_s` in which only the drag acts: exact, so that no
/// step is too long. `shade_m2`: mean area of its shade over all attitudes.
Vec3 slowed_by_air_mps(const Vec3& past_air_mps, double shade_m2, double mass_kg, double step_s);

/// Sets the body's `force_n` to the air's, in a wind of this velocity.
void feel_air(Piece& piece, const Eigen::Vector3d& wind_mps);

}  // namespace septet::debris
