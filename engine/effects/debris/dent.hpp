#pragma once
/// Dents: a vehicle's shape after a crash, what it has lost, and their encoding.
///
/// The residual crush C grows with the speed V of a test against a rigid wall, V = b0 + b1 C (Campbell 1974, Energy
/// Basis for Collision Severity, SAE 740565). b1 is the frequency of the crush (engine/world/crush.toml: a spring that
/// does not return is pressed by V/b1), b0 the speed that leaves no crush (dents.toml). Beyond the crumple zone it is
/// harder, and the crush less by the root of that, since energy goes with its square. In a crash of two bodies each
/// crushes as at a wall at the speed that it loses, for the energy available to both is shared by the other's mass
/// where stiffness goes with the own one (crash.hpp).
///
/// Vehicle frame (rigid_transform.hpp). Free of state: the same dents give the same shape on every machine.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/effects/debris/mounted_part.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::debris {

/// A dented stretch of the hull's outline in plan, from the ground up to some height.
struct Dent {
  Vec2 place_m{0.0};          ///< Middle of the stretch, on the outline before it was pushed in.
  double heading_rad = 0.0;   ///< Direction of the push, counter-clockwise from straight on.
  double depth_m = 0.0;       ///< Residual crush.
  double half_width_m = 0.1;  ///< Half width of the stretch, across the direction of the push.
  double top_m = 1.0;         ///< Height of the striking body, above the road.
};

struct DentedVehicle {
  ParticipantId vehicle = 0;
  std::vector<Dent> dents;  ///< In the order of the crashes: later ones dent the dented shape.
  Mounts torn = 0;          ///< Whose parts have been torn off.
};

inline constexpr double most_depth_m = 0.95;
inline constexpr std::size_t most_dents = 8;             ///< Limit of one vehicle's dents.
inline constexpr std::size_t most_dented_vehicles = 48;  ///< Limit of a drive's dented vehicles.

/// Residual crush of a vehicle that a crash slows by `lost_mps`; 0 up to the speed that leaves no crush.
double residual_crush_m(double lost_mps);

/// Adds a dent to a vehicle's list. One beside an earlier one of that side deepens it, as the energies of both add up;
/// where there are `most_dents`, the shallowest is replaced. Has no effect for a dent without depth, or at the limit of
/// dented vehicles.
void note_dent(ParticipantId vehicle, const Dent& dent, std::vector<DentedVehicle>& vehicles);

/// Adds what a vehicle has lost; likewise.
void note_torn(ParticipantId vehicle, Mounts torn, std::vector<DentedVehicle>& vehicles);

/// Present place of a point of the undented vehicle.
Vec3 dented(std::span<const Dent> dents, const Vec3& place_m);
/// Present direction of a normal there, as unit vector.
Vec3 dented_normal(std::span<const Dent> dents, const Vec3& place_m, const Vec3& normal);
/// True where any of the dents moves this point.
bool reaches(std::span<const Dent> dents, const Vec3& place_m);

inline constexpr std::uint16_t dent_keyframe_kind = 7;
inline constexpr std::uint32_t dent_effect_id = 0x03000002;

/// All dents of a drive, and torn parts, as one EffectKeyframe (engine/world/SNAPSHOT.md): lengths to the centimetre,
/// depths to half of one, headings to a 256th of a turn; about eight bytes a dent.
Bytes encode_dents(std::span<const DentedVehicle> vehicles);
/// Error: bytes that `encode_dents` would not write; safe on hostile bytes.
Expected<std::vector<DentedVehicle>> decode_dents(std::span<const std::byte> bytes);

}  // namespace septet::debris
