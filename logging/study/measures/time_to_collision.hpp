#pragma once
/// Time to collision (TTC) with the leader, and duration and integral of its shortfall.
///
/// TTC = gap / closing speed (Hayward 1972), while the driver approaches a leader in the own lane; elsewhere it is
/// undefined, which is neither 0 nor a large number. TET, time exposed, is the time with TTC ≤ τ; TIT, time integrated,
/// is ∫(τ − TTC) over that time (Minderhoud and Bovy 2001). Between two samples with the same leader TTC is linear; an
/// interval with an end at which it is undefined does not count.

#include <optional>
#include <span>

#include "logging/session/records.hpp"

namespace septet::logging {

struct TtcSettings {
  double threshold_s = 3.0;              ///< τ.
  double least_closing_speed_mps = 0.1;  ///< Below it TTC is a division by noise.
};

/// Empty if undefined.
std::optional<double> time_to_collision_s(const Sample& sample, const TtcSettings& settings = {});

struct TtcMeasures {
  std::optional<double> smallest_s;
  double exposed_s = 0.0;       ///< TET.
  double integrated_s2 = 0.0;   ///< TIT.
  std::size_t samples = 0;      ///< Samples with a TTC.
  std::size_t not_closing = 0;  ///< Samples with a leader, and no approach.
  std::size_t no_leader = 0;
};

TtcMeasures compute_time_to_collision(std::span<const Sample> samples, const TtcSettings& settings = {});

}  // namespace septet::logging
