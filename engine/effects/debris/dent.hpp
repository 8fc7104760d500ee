#pragma once
/// Dents: what a crash leaves of a vehicle's shape, and how the shape is told and found from it.
///
/// The residual crush C grows with the speed V of a test against a rigid wall, V = b0 + b1 C (Campbell 1974, Energy Basis for
/// Collision Severity, SAE 740565). b1 is the frequency of the crush (engine/world/crush.toml: a spring that does not return is
/// pressed by V/b1), b0 the speed that leaves nothing behind (dents.toml). Beyond the crumple zone it is harder, and the crush
/// less by the root of that, since energy goes with its square.
/// In a crash of two bodies each crushes as at a wall at the speed that it loses, for the energy that both have to spare is
/// shared by the other's mass where stiffness goes with the own one (crash.hpp).
///
/// Vehicle frame (rigid_transform.hpp). Free of state: the same dents give the same shape on every machine.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::debris {

/// What was pushed in: a stretch of the hull's outline in plan, from the ground up to some height.
struct Dent {
  Vec2 place_m{0.0};          ///< Middle of the stretch, on the outline before it was pushed in.
  double heading_rad = 0.0;   ///< Which way it was pushed, counter-clockwise from straight on.
  double depth_m = 0.0;       ///< Residual crush.
  double half_width_m = 0.1;  ///< Of the stretch, across the way that it was pushed.
  double top_m = 1.0;         ///< Up to here what struck it reached, above the road.
};

struct DentedVehicle {
  ParticipantId vehicle = 0;
  std::vector<Dent> dents;  ///< In the order in which they came: later ones dent what is there.
};

inline constexpr double most_depth_m = 0.95;
inline constexpr std::size_t most_dents = 8;             ///< Of a vehicle.
inline constexpr std::size_t most_dented_vehicles = 48;  ///< Of a drive.

/// Residual crush of a vehicle that a crash slows by `lost_mps`; 0 up to the speed that leaves nothing behind.
double residual_crush_m(double lost_mps);

/// Adds a dent to a vehicle's. One beside an earlier one of that side deepens it, as the energies of both add up; where there are
/// `most_dents`, the shallowest gives way. Nothing happens to what has no depth, or where as many vehicles are dented as may be.
void note_dent(ParticipantId vehicle, const Dent& dent, std::vector<DentedVehicle>& vehicles);

/// Where a point of the undented vehicle is now.
Vec3 dented(std::span<const Dent> dents, const Vec3& place_m);
/// What was a normal there, as unit vector.
Vec3 dented_normal(std::span<const Dent> dents, const Vec3& place_m, const Vec3& normal);
/// Whether any of the dents moves this point.
bool reaches(std::span<const Dent> dents, const Vec3& place_m);

inline constexpr std::uint16_t dent_keyframe_kind = 7;
inline constexpr std::uint32_t dent_effect_id = 0x03000002;

/// All dents of a drive as one EffectKeyframe (engine/world/SNAPSHOT.md): lengths to the centimetre, depths to half of one, headings
/// to a 256th of a turn; about eight bytes a dent.
Bytes encode_dents(std::span<const DentedVehicle> vehicles);
/// Refuses anything that `encode_dents` would not write; safe on hostile bytes.
Expected<std::vector<DentedVehicle>> decode_dents(std::span<const std::byte> bytes);

}  // namespace septet::debris
