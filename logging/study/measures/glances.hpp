#pragma once
/// Glances at the mirrors, from the head's direction.
///
/// A glance at an area begins with the first sample inside the area and ends with the first one outside (ISO 15007
/// counts likewise, with eye tracking); those shorter than `minimum_s` do not count: on its path to the right mirror
/// the head passes through the inside mirror's area in less than a tenth of a second, which one sample of the 10 Hz can
/// hit. A duration is known to 0.1 s.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/rig/rig.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

/// A range of head headings, radians, positive to the left: from ≤ heading < to.
struct GlanceArea {
  std::string name;
  double from_rad = 0.0, to_rad = 0.0;
};

/// The mirrors of a left-hand-drive car with the eye point 0.37 m left of its middle: from the
/// mirrors' places (door mirrors 0.95 m from the middle and 0.6 m ahead of the eyes, inside mirror
/// in the middle, 0.45 m ahead) they lie at 44° left, 39° right and 66° right. Heads turn less than
/// eyes, so that each area reaches well towards the front.
std::vector<GlanceArea> left_hand_drive_mirrors();

/// Areas of the rig's mirrors; for a rig without named mirrors those of a left-hand-drive car.
std::vector<GlanceArea> glance_areas(const rig::Rig& rig);

struct Glance {
  Tick tick = 0;  ///< Tick of its first sample.
  double start_s = 0.0, duration_s = 0.0;
  std::string area;
  bool operator==(const Glance&) const = default;
};

struct GlanceSettings {
  std::vector<GlanceArea> areas = left_hand_drive_mirrors();
  double minimum_s = 0.15;
};

struct GlanceDetector {
  GlanceSettings settings;
  std::optional<Glance> current;
};

/// Takes the next sample; returns the glance that ended with it.
std::optional<Glance> advance(GlanceDetector& detector, const Sample& sample);

/// True if the head's direction was measured: without a source it never moves.
bool is_head_known(std::span<const Sample> samples);

/// A glance that lasts until the last sample counts with its duration so far.
std::vector<Glance> find_glances(std::span<const Sample> samples, const GlanceSettings& settings = {});

}  // namespace septet::logging
