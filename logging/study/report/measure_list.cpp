#include "logging/study/report/measure_list.hpp"

#include <algorithm>
#include <numbers>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "logging/study/measures/order_statistics.hpp"

namespace septet::logging {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

class List {
 public:
  /// Sample counts of the next measures.
  List& of(std::size_t samples, std::size_t missing) {
    samples_ = samples;
    missing_ = missing;
    return *this;
  }
  void add(std::string key, std::string title, std::string unit, std::optional<double> value, std::string definition) {
    // Possible inputs can still give an impossible figure.
    if (value && !can_be_told(*value)) value = std::nullopt;
    measures_.push_back(
        {std::move(key), std::move(title), std::move(unit), value, samples_, missing_, std::move(definition)});
  }
  /// Undefined where there is no sample.
  void add_of_samples(std::string key, std::string title, std::string unit, double value, std::string definition) {
    add(std::move(key), std::move(title), std::move(unit), samples_ > 0 ? std::optional(value) : std::nullopt,
        std::move(definition));
  }
  std::vector<ListedMeasure> take() { return std::move(measures_); }

 private:
  std::vector<ListedMeasure> measures_;
  std::size_t samples_ = 0, missing_ = 0;
};

void list_speed(const DriveMeasures& m, const MeasureSettings& settings, List& list) {
  list.of(m.samples, 0);
  list.add_of_samples("duration_s", "Duration", "s", m.duration_s,
                      "Simulated time from sample to sample; gaps of more than a second are not in it.");
  list.add_of_samples("distance_m", "Distance", "m", m.distance_m, "Speed summed over time (trapezoidal).");
  list.add_of_samples("speed_mean_mps", "Speed, mean", "m/s", m.speed_mean_mps, "Over all samples, standing included.");
  list.add_of_samples("speed_sd_mps", "Speed, SD", "m/s", m.speed_sd_mps, "Divides by N.");
  list.add_of_samples("speed_largest_mps", "Speed, largest", "m/s", m.speed_largest_mps, "Largest sample.");
  const SpeedingMeasures& speeding = m.speeding;
  const auto limit = fmt::format(
      "Speed above the limit that OpenDRIVE gives the lane, by more than {:g} km/h; samples without a limit are "
      "counted as "
      "missing.",
      settings.speeding.tolerance_mps * 3.6);
  list.of(speeding.samples, speeding.no_limit);
  list.add_of_samples("speeding_share", "Speeding, share of time", "", speeding.share, limit);
  list.add_of_samples("speeding_episodes", "Speeding, episodes", "", static_cast<double>(speeding.episodes),
                      "Unbroken runs of such samples.");
  list.add_of_samples("speeding_largest_excess_mps", "Speeding, largest excess", "m/s", speeding.largest_excess_mps,
                      "Over the limit, of such samples; 0 without any.");
}

void list_accelerations(const DriveMeasures& m, const MeasureSettings& settings, List& list) {
  const AccelerationMeasures& a = m.accelerations;
  list.of(a.samples, a.missing);
  list.add_of_samples("acceleration_longitudinal_rms_mps2", "Acceleration along, RMS", "m/s²", a.longitudinal_rms_mps2,
                      "Of the car's origin, in the car's frame, as it is at the sample; not smoothed.");
  list.add_of_samples("acceleration_lateral_rms_mps2", "Acceleration across, RMS", "m/s²", a.lateral_rms_mps2,
                      "Likewise.");
  list.add_of_samples("acceleration_strongest_mps2", "Acceleration, strongest", "m/s²", a.strongest_mps2,
                      "Largest sample along the car.");
  list.add_of_samples("braking_strongest_mps2", "Braking, strongest", "m/s²", a.strongest_braking_mps2,
                      "Largest deceleration along the car, positive.");
  list.add_of_samples("acceleration_lateral_strongest_mps2", "Acceleration across, strongest", "m/s²",
                      a.strongest_lateral_mps2, "Largest sample to either side.");
  list.add_of_samples("hard_brakings", "Hard brakings", "", static_cast<double>(a.hard_brakings),
                      fmt::format("Unbroken runs of samples with {:g} m/s² of deceleration or more.",
                                  settings.accelerations.hard_braking_mps2));
}

void list_lane_keeping(const DriveMeasures& m, const MeasureSettings& settings, List& list) {
  const LateralPositionStatistics& position = m.lateral_position;
  const auto what = fmt::format(
      "SAE J2944 10.1.2 and 10.1.3, reference point 2: the middle of the front axle; positive to the left of the "
      "lane's centre. "
      "Missing: within {:g} s of a lane change, or off every lane.",
      settings.lateral_position.exclude_around_lane_change_s);
  list.of(position.samples, position.excluded_lane_change + position.excluded_off_lane);
  list.add_of_samples("lateral_position_mean_m", "Lateral position, mean", "m", position.mean_m, what);
  list.add_of_samples("lateral_position_sd_m", "Lateral position, SD", "m", position.sd_m,
                      "SDLP of the same samples, divides by N.");
  list.of(m.histogram.total(), m.histogram.off_lane);
  list.add_of_samples(
      "lateral_position_centre_share", "In the centre interval of 21", "",
      m.histogram.fraction(LateralPositionHistogram::bins / 2),
      "Share of the samples in the middle one of 21 equal intervals across the lane; lane changes included "
      "(Lebram, Engström and Gustavsson 2006, figure 5).");
  const std::size_t in_lanes = m.histogram.total();
  list.of(in_lanes, m.samples - std::min(m.samples, in_lanes));
  list.add_of_samples("lane_changes", "Lane changes", "", static_cast<double>(m.lane_changes.size()),
                      fmt::format("Dated where the reference point crosses the line; counted once it is {:g} m beyond.",
                                  settings.lane_changes.hysteresis_m));
  list.add("between_lane_changes_s", "Time between lane changes", "s", m.between_lane_changes_s,
           "Simulated time over the number of lane changes.");
  list.of(m.head_is_known ? m.samples : 0, m.head_is_known ? 0 : m.samples);
  list.add_of_samples("mirror_glances", "Mirror glances", "", static_cast<double>(m.glances.size()),
                      fmt::format("From the head's heading at 10 Hz; at least {:g} s inside a mirror's area. Undefined "
                                  "where nothing told the head's heading.",
                                  settings.glances.minimum_s));
  list.add("between_glances_s", "Time between glances", "s", m.between_glances_s,
           "Simulated time over the number of mirror glances.");
  const TlcMeasures& tlc = m.tlc;
  const auto missing = tlc.missing + tlc.excluded_lane_change + tlc.over_line;
  const auto add_tlc = [&](const std::string& key, const std::string& name, const TlcStatistics& statistics,
                           const std::string& definition) {
    list.of(statistics.samples, missing);
    list.add(
        "tlc_" + key + "_smallest_s", "TLC " + name + ", smallest", "s", statistics.smallest_s,
        definition +
            fmt::format(" From the side of the car, {:g} m from its middle; van Winsum et al. 1998, 2000. Missing: {} "
                        "over the line, {} within {:g} s of a lane change, {} without a derivative.",
                        tlc.half_width_m, tlc.over_line, tlc.excluded_lane_change,
                        settings.tlc.exclude_around_lane_change_s, tlc.missing));
    list.add("tlc_" + key + "_minimum_median_s", "TLC " + name + ", median of minima", "s", statistics.minimum_median_s,
             fmt::format("Of {} local minima up to {:g} s.", statistics.minima, settings.tlc.longest_s));
    list.add_of_samples("tlc_" + key + "_short_share", "TLC " + name + ", share of time short", "",
                        statistics.short_share, fmt::format("Below {:g} s.", settings.tlc.short_s));
  };
  add_tlc("trigonometric", "trigonometric", tlc.trigonometric,
          "Arc of the car's path to the line over the speed; path and line are circles.");
  add_tlc("simple", "simple", tlc.simple, "Distance over speed towards the line.");
  add_tlc("van_winsum", "van Winsum", tlc.van_winsum,
          "Distance over the sum of speed and acceleration (of one second) towards the line.");
}

void list_following(const DriveMeasures& m, const MeasureSettings& settings, List& list) {
  const FollowingMeasures& f = m.following;
  const auto cut_off = fmt::format("SAE J2944 8.1.4, while following: time headway at most {:g} s, above {:g} m/s.",
                                   settings.following.longest_s, settings.following.least_speed_mps);
  const auto add = [&](const std::string& key, const std::string& name, const FollowingStatistics& statistics,
                       const std::string& what) {
    list.of(f.samples, f.no_leader + f.farther + f.too_slow);
    list.add(key + "_median_s", name + ", median", "s", statistics.median_s, what + " " + cut_off);
    list.add(key + "_smallest_s", name + ", smallest", "s", statistics.smallest_s, "Of the same samples.");
    list.add_of_samples(key + "_close_share", name + ", share of following short", "", statistics.close_share,
                        fmt::format("Below {:g} s.", settings.following.close_s));
  };
  add("time_headway", "Time headway", f.headway, "Front bumper to front bumper over own speed.");
  add("time_gap", "Time gap", f.gap, "Front bumper to the leader's rear bumper over own speed.");
  const TtcMeasures& ttc = m.ttc;
  list.of(ttc.samples, ttc.no_leader + ttc.not_closing);
  list.add("ttc_smallest_s", "TTC, smallest", "s", ttc.smallest_s,
           fmt::format("Gap over closing speed, where the leader is approached with {:g} m/s or more (Hayward 1972); "
                       "elsewhere it is "
                       "undefined, here: {} not closing in, {} without a leader.",
                       settings.ttc.least_closing_speed_mps, ttc.not_closing, ttc.no_leader));
  list.add_of_samples(
      "ttc_exposed_s", "TTC, time exposed (TET)", "s", ttc.exposed_s,
      fmt::format("Time with TTC of {:g} s or less (Minderhoud and Bovy 2001).", settings.ttc.threshold_s));
  list.add_of_samples("ttc_integrated_s2", "TTC, time integrated (TIT)", "s²", ttc.integrated_s2,
                      fmt::format("Integral of {:g} s − TTC over that time.", settings.ttc.threshold_s));
}

void list_steering(const DriveMeasures& m, const MeasureSettings& settings, List& list) {
  const auto add = [&](const std::string& key, const std::string& title, const ReversalRate& rate,
                       const ReversalSettings& options) {
    list.of(rate.samples, rate.left_out);
    list.add(key, title, "1/min", rate.per_minute,
             fmt::format("Markkula and Engström 2006: second-order Butterworth, {:g} Hz, forwards and backwards; "
                         "swings of more than "
                         "{:g}°, up and down; from samples at 10 Hz.",
                         options.cut_off_hz, options.gap_rad * degrees));
  };
  add("steering_reversals_visual_pmin", "Steering reversals, visual load", m.reversals_visual,
      settings.reversals_visual);
  add("steering_reversals_cognitive_pmin", "Steering reversals, cognitive load", m.reversals_cognitive,
      settings.reversals_cognitive);
  const SteeringEntropy& entropy = m.steering_entropy;
  list.of(entropy.errors, entropy.left_out);
  list.add(
      "steering_entropy", "Steering entropy (1999)", "", entropy.entropy,
      fmt::format("Nakayama, Futami, Nakamura and Boer 1999: 150 ms, second-order Taylor prediction, nine bins; α {}.",
                  settings.steering_entropy.alpha_rad
                      ? std::string("given")
                      : fmt::format("of the drive's own first {:g} s", settings.steering_entropy.baseline_s)));
  list.add("steering_entropy_alpha_rad", "Steering entropy, α", "rad", entropy.alpha_rad,
           "90th percentile of the prediction errors in the baseline.");
}

void list_incidents(const DriveMeasures& m, const MeasureSettings& settings, List& list) {
  const auto& collisions = m.collisions;
  std::optional<double> largest_mps;
  std::size_t unknown = 0;
  for (const Collision& collision : collisions)
    if (!collision.closing_speed_mps)
      ++unknown;
    else
      largest_mps = std::max(largest_mps.value_or(0.0), *collision.closing_speed_mps);
  list.of(collisions.size(), 0);
  list.add("collisions", "Collisions", "",
           m.samples > 0 || !collisions.empty() ? std::optional(static_cast<double>(collisions.size())) : std::nullopt,
           "Contacts of the car with vehicles, people, objects or what stands beside the road, each when it began.");
  list.of(collisions.size() - unknown, unknown);
  list.add("collision_closing_speed_largest_mps", "Collisions, largest closing speed", "m/s", largest_mps,
           "Of the two bodies towards each other, as the log's event has it.");
  std::optional<double> delta_v_mps;
  std::size_t measured = 0;
  for (const Collision& collision : collisions) {
    if (!collision.crash || !collision.crash->of_first.delta_v_mps) continue;
    ++measured;
    delta_v_mps = std::max(delta_v_mps.value_or(0.0), glm::length(*collision.crash->of_first.delta_v_mps));
  }
  list.of(measured, collisions.size() - measured);
  list.add("collision_delta_v_largest_mps", "Collisions, largest ΔV", "m/s", delta_v_mps,
           "Change of the velocity of the car's mass centre from the touch to the last push, wheels included but where "
           "it met a person or a two-wheeler, as the log's record of the crash has it.");
  std::vector<double> times_s;
  std::size_t already = 0, censored = 0;
  for (const BrakeReaction& reaction : m.brake_reactions) {
    if (reaction.response == BrakeResponse::braked) times_s.push_back(reaction.time_s);
    already += reaction.response == BrakeResponse::braking_already;
    censored += reaction.response == BrakeResponse::censored;
  }
  list.of(times_s.size(), already + censored);
  list.add("brake_reaction_median_s", "Brake reaction, median", "s", median(times_s),
           settings.braking_event
               ? fmt::format("SAE J2944 6.5.2: from the event {} to the brake pedal beyond {:g} of its travel. {} "
                             "braked already, {} "
                             "had not braked within {:g} s (censored).",
                             settings.braking_event->kind + (settings.braking_event->detail_holds.empty()
                                                                 ? ""
                                                                 : ":" + settings.braking_event->detail_holds),
                             settings.brake_reaction.pressed, already, censored, settings.brake_reaction.longest_s)
               : std::string("No event is named to react to (--brake-event)."));
}

void list_hazards(const DriveMeasures& m, const MeasureSettings& settings, List& list) {
  std::vector<double> times_s;
  std::size_t without = 0, uncounted = 0;
  for (const HazardReaction& reaction : m.hazard_reactions) {
    if (!reaction.counts())
      ++uncounted;
    else if (reaction.response == HazardResponse::censored)
      ++without;
    else
      times_s.push_back(reaction.time_s);
  }
  list.of(times_s.size() + without, uncounted);
  list.add_of_samples(
      "hazards_without_reaction", "Hazards without a reaction", "", static_cast<double>(without),
      fmt::format("Within {:g} s of the first moment at which the driver could see it, or until the log ends.",
                  settings.hazard_reaction.longest_s));
  list.of(times_s.size(), without + uncounted);
  list.add("hazard_reaction_median_s", "Hazard reaction, median", "s", median(times_s),
           fmt::format("From the first moment at which the hazard could be seen to the brake pedal beyond {:g} of its "
                       "travel, or to half "
                       "of the accelerator given back. Missing: no reaction, never in sight, or the car stood.",
                       settings.hazard_reaction.pressed));
}

}  // namespace

std::vector<ListedMeasure> list_measures(const DriveMeasures& measures, const MeasureSettings& settings) {
  List list;
  list_speed(measures, settings, list);
  list_accelerations(measures, settings, list);
  list_lane_keeping(measures, settings, list);
  list_following(measures, settings, list);
  list_steering(measures, settings, list);
  list_incidents(measures, settings, list);
  list_hazards(measures, settings, list);
  return list.take();
}

}  // namespace septet::logging
