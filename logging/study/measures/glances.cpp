#include "logging/study/measures/glances.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "logging/study/measures/sample_steps.hpp"

namespace septet::logging {
namespace {

std::optional<Glance> finish(GlanceDetector& detector, double end_s) {
  std::optional<Glance> glance;
  std::swap(glance, detector.current);
  if (!glance) return std::nullopt;
  glance->duration_s = end_s - glance->start_s;
  // Sums of 0.1 s steps fall short of 0.1 s by rounding.
  return glance->duration_s >= detector.settings.minimum_s - 1e-6 ? glance : std::nullopt;
}

}  // namespace

std::vector<GlanceArea> left_hand_drive_mirrors() {
  constexpr double degree = std::numbers::pi / 180.0;
  return {{"left mirror", 25 * degree, 75 * degree},
          {"inside mirror", -45 * degree, -20 * degree},
          {"right mirror", -80 * degree, -45 * degree}};
}

std::vector<GlanceArea> glance_areas(const rig::Rig& rig) {
  std::vector<GlanceArea> areas;
  for (const rig::Mirror& mirror : rig.mirrors) areas.push_back({mirror.name, mirror.from_rad, mirror.to_rad});
  return areas.empty() ? left_hand_drive_mirrors() : areas;
}

std::optional<Glance> advance(GlanceDetector& detector, const Sample& sample) {
  const auto area = std::ranges::find_if(detector.settings.areas, [&](const GlanceArea& a) {
    return a.from_rad <= sample.gaze_heading_rad && sample.gaze_heading_rad < a.to_rad;
  });
  const bool inside = area != detector.settings.areas.end();
  if (detector.current && inside && detector.current->area == area->name) return std::nullopt;
  const auto ended = finish(detector, sample.simulated_time_s);
  if (inside) detector.current = Glance{.tick = sample.tick, .start_s = sample.simulated_time_s, .area = area->name};
  return ended;
}

bool is_head_known(std::span<const Sample> samples) {
  return std::ranges::any_of(samples, [](const Sample& sample) {
    return std::isfinite(sample.gaze_heading_rad) && sample.gaze_heading_rad != 0.0;
  });
}

std::vector<Glance> find_glances(std::span<const Sample> samples, const GlanceSettings& settings) {
  GlanceDetector detector;
  detector.settings = settings;
  std::vector<Glance> glances;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0 && is_gap(samples[i - 1], samples[i]))
      if (const auto glance = finish(detector, samples[i - 1].simulated_time_s)) glances.push_back(*glance);
    if (const auto glance = advance(detector, samples[i])) glances.push_back(*glance);
  }
  if (!samples.empty())
    if (const auto glance = finish(detector, samples.back().simulated_time_s)) glances.push_back(*glance);
  return glances;
}

}  // namespace septet::logging
