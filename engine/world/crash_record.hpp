#pragma once
/// What one crash came to, the same for the driver's car and for others: told when its impact is over.
///
/// Two bodies in plan: the first is a vehicle, the second another one or something that stands. World frame, SI units,
/// angles counter-clockwise. What was not measured is missing, never 0. As text it is the detail of the log's event
/// `crash` (logging/FORMAT.md, where each key has its meaning).

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/math/plane_vector.hpp"
#include "engine/world/snapshot.hpp"

namespace septet {

struct CrashedBody {
  std::optional<double> mass_kg, yaw_inertia_kgm2;
  std::optional<double> mass_centre_ahead_m;  ///< Of the vehicle's origin, along its heading.
  std::optional<double> mass_centre_above_m;  ///< Its height over the origin.
  // At the touch: velocity of the mass centre.
  std::optional<Vec2> before_mps;
  std::optional<double> yaw_rate_before_radps;
  /// Changes from the touch to the last push, wheels and all.
  std::optional<Vec2> delta_v_mps;
  std::optional<double> delta_yaw_rate_radps;
  /// Whence the blow came, seen from the vehicle: 0 from straight ahead, π/2 from the left. Opposite to delta_v_mps.
  std::optional<double> principal_direction_rad;
  std::optional<double> crush_m;  ///< Along the normal.
  bool operator==(const CrashedBody&) const = default;
};

/// Energies, J, each reckoned by itself: kinetic ones in plan from masses, velocities and yaw rates; crush and friction
/// as work of the contact's force along the normal and across it; debris as work on the pieces that broke off. Wheels:
/// kinetic energy that both lost by other ways, wheels and further contacts. The first less the second is the sum of the
/// others.
struct CrashLedger {
  double kinetic_before_j = 0.0, kinetic_after_j = 0.0;
  double crush_j = 0.0, friction_j = 0.0, debris_j = 0.0, wheels_j = 0.0;
  bool operator==(const CrashLedger&) const = default;
};

struct CrashRecord {
  Tick tick = 0;            ///< Of the touch.
  std::uint32_t ticks = 0;  ///< From it to the last push of the impact, which lasts a second at most.
  /// From it to the last push before the two parted: longer than the impact where one pushes the other along. Who have
  /// not parted `told_within_s` after the touch have the time until then.
  std::optional<double> contact_s;
  ParticipantId first = 0;              ///< The lesser number.
  std::optional<ParticipantId> second;  ///< Empty: what stands.
  std::string stands;  ///< "guard rail", "tree", …; of a second that is a solid, its name or nothing.
  Vec3 point_m{0.0};
  double normal_rad = 0.0;            ///< Its direction, from the first to the second.
  double closing_speed_mps = 0.0;     ///< Of the surfaces, along the normal.
  std::optional<double> sliding_mps;  ///< Of the first's along the second's, to the normal's left.
  /// Width on which both meet, seen along their approach, and its share of the narrower one.
  std::optional<double> overlap_m, overlap_share;
  /// How far their whole outlines came into each other, by their poses: the least way that parts them, its greatest at
  /// the end of a tick, until that of the last push.
  std::optional<double> depth_m;
  CrashedBody of_first, of_second;
  std::optional<CrashLedger> ledger;
  std::optional<double> pieces_kinetic_j;  ///< Kinetic energy with which pieces flew off.
  std::vector<Vec2> pulse_ns;              ///< Impulse on the second in each tick, from the touch on.
  bool is_unfinished = false;              ///< The drive ended before its impact was over.
  bool operator==(const CrashRecord&) const = default;
};

inline constexpr std::string_view crash_event = "crash";
inline constexpr int crash_record_version = 1;
inline constexpr std::size_t most_pulse_ticks = 240;
/// No impact is recorded for longer: from here on a contact is a push that lasts, and words tell how long.
inline constexpr double lasting_contact_s = 1.0;
/// Two have parted after this time without a push. A crash is told then, and at the latest `told_within_s` after its
/// touch: who drives, teaches or listens does not wait for the end of a push.
inline constexpr double parted_s = 0.25, told_within_s = 2.0;

/// Sum of the pulse: the impulse on the second; empty where there is no pulse.
std::optional<Vec2> impulse_ns(const CrashRecord& crash);
/// How long a contact lasted: "1.2 s", "2 s or longer".
std::string contact_text(double contact_s);
/// By how much the ledger fails to close, as a share of the kinetic energy that was lost.
double share_missing(const CrashLedger& ledger);

/// The detail of the event, whose participant is the first.
std::string text_of(const CrashRecord& crash);
/// Empty: it is no record of this version. A number that is none, or beyond all bounds, is missing.
std::optional<CrashRecord> read_crash(ParticipantId first, std::string_view detail);

}  // namespace septet
