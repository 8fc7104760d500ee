#pragma once
/// What a changed drive comes to, beside the logged one.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/simulation/state.hpp"
#include "engine/world/snapshot.hpp"
#include "logging/session/participants.hpp"

namespace septet::server {

/// A collision of the driver's car.
struct MetCollision {
  Tick tick = 0;
  std::optional<ParticipantId> other;  ///< Empty: what stands beside the road.
  std::string with;                    ///< "3 van (van)", "wall".
  double closing_speed_mps = 0.0;      ///< Along the normal.
  double delta_v_mps = 0.0;            ///< Of the driver's car.
  bool operator==(const MetCollision&) const = default;
};

/// The first collision among the events of a tick.
std::optional<MetCollision> collision_among(std::span<const simulation::Event> events, const Snapshot& snapshot,
                                            const logging::ParticipantNames& names);

/// The collision that a drive is changed for, as it was logged.
struct LoggedCollision {
  MetCollision met;
  RigidTransform world_from_car;  ///< The driver's car at its tick.
};

struct VariantOutcome {
  std::optional<MetCollision> collision;  ///< The first one that is not passed over.
  /// Begin of the driver's car's last standstill, which lasts at the end (simulated).
  std::optional<double> stopped_s;
  /// Least distance in plan between the car and whoever it hit in the logged drive; 0 where they touch. Empty: the
  /// logged drive hit nobody, or he was not there.
  std::optional<double> least_gap_m;
  /// Of a car that stands at the end: how far it is before the place at which it stood at the logged collision, along
  /// its heading there; negative: beyond.
  std::optional<double> before_place_m;
  Tick last_tick = 0;
  std::uint64_t state_hash = 0;  ///< Of that tick.
  bool operator==(const VariantOutcome&) const = default;
};

/// Follows a drive tick by tick.
class OutcomeWatch {
 public:
  /// `names` and `logged` (may be null) outlive it. Collisions before the simulated second `from_s` are passed over.
  OutcomeWatch(const logging::ParticipantNames& names, const LoggedCollision* logged, double from_s)
      : names_(names), logged_(logged), from_s_(from_s) {}
  void see(const Snapshot& snapshot, std::span<const simulation::Event> events);
  bool has_collided() const { return outcome_.collision.has_value(); }
  VariantOutcome outcome() const;

 private:
  const logging::ParticipantNames& names_;
  const LoggedCollision* logged_;
  double from_s_;
  VariantOutcome outcome_;
  RigidTransform world_from_car_;
};

/// The outcome in a sentence that goes on from "brake:-0.5s: ": "stopped at 12.90 s, 3.02 m before 3 van (van)".
std::string outcome_text(const VariantOutcome& outcome, const LoggedCollision* logged);
/// The collision in words: "hit 3 van (van) at 12.41 s with 38 km/h".
std::string collision_text(const MetCollision& collision);

}  // namespace septet::server
