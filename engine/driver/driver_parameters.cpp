#include "engine/driver/driver_parameters.hpp"

#include <algorithm>
#include <initializer_list>

#include <fmt/core.h>

namespace septet::driver {
namespace {

/// Parameters that differ between kinds of drivers, each by its place in the structure.
constexpr auto limit_factor = [](DriverParameters& d) -> double& { return d.speed.limit_factor; };
constexpr auto time_gap = [](DriverParameters& d) -> double& { return d.speed.time_gap_s; };
constexpr auto reaction = [](DriverParameters& d) -> double& { return d.speed.reaction_time_s; };
constexpr auto distance_noise = [](DriverParameters& d) -> double& { return d.speed.distance_noise; };
constexpr auto frequency = [](DriverParameters& d) -> double& { return d.steering.natural_frequency_radps; };
constexpr auto position_noise = [](DriverParameters& d) -> double& { return d.steering.position_noise_m; };
constexpr auto position_time = [](DriverParameters& d) -> double& { return d.steering.position_noise_s; };
constexpr auto heading_noise = [](DriverParameters& d) -> double& { return d.steering.heading_noise_rad; };
constexpr auto peripheral = [](DriverParameters& d) -> double& { return d.steering.peripheral_share; };
constexpr auto eye_to_hand = [](DriverParameters& d) -> double& { return d.steering.delay_s; };
constexpr auto change_threshold = [](DriverParameters& d) -> double& { return d.lanes.threshold_mps2; };
constexpr auto signal_time = [](DriverParameters& d) -> double& { return d.lanes.signal_s; };
constexpr auto change_time = [](DriverParameters& d) -> double& { return d.lanes.duration_s; };
constexpr auto glance_interval = [](DriverParameters& d) -> double& { return d.mirrors.interval_s; };
constexpr auto glance = [](DriverParameters& d) -> double& { return d.mirrors.glance_s; };

constexpr auto ease_off = [](DriverParameters& d) -> double& { return d.course.ease_off_mps2; };
constexpr auto lead = [](DriverParameters& d) -> double& { return d.course.lead_s; };
constexpr auto accepted_wait = [](DriverParameters& d) -> double& { return d.course.gap_s; };
constexpr auto judgement = [](DriverParameters& d) -> double& { return d.course.judgement; };
constexpr auto turn_signal = [](DriverParameters& d) -> double& { return d.course.turn_signal_s; };

constexpr auto course_preview = [](DriverParameters& d) -> double& { return d.course.preview_m; };
constexpr auto at_crossings = [](DriverParameters& d) -> double& { return d.course.crossing_mps; };
constexpr auto on_snow = [](DriverParameters& d) -> double& { return d.speed.on_snow; };
constexpr auto looks_again = [](DriverParameters& d) -> double& { return d.lanes.looks_again; };
constexpr auto preview = [](DriverParameters& d) -> double& { return d.speed.preview_s; };
constexpr auto speed_noise = [](DriverParameters& d) -> double& { return d.speed.speed_noise; };
constexpr auto warned_gap = [](DriverParameters& d) -> double& { return d.speed.warned_gap_m; };
constexpr auto warns_after = [](DriverParameters& d) -> double& { return d.speed.warns_after_s; };

constexpr auto in_tracks = [](DriverParameters& d) -> double& { return d.lanes.in_tracks_within_m; };

struct Difference {
  double& (*parameter)(DriverParameters&);
  double value;
};
struct Kind {
  NamedDriver driver;
  std::initializer_list<Difference> differences;  ///< From the plain driver.
};

constexpr std::initializer_list<Difference> from_novice = {{position_noise, 0.23},
                                                           {peripheral, 0.4},
                                                           {heading_noise, 0.0026},
                                                           {eye_to_hand, 0.25},
                                                           {speed_noise, 0.04},
                                                           {time_gap, 1.4},
                                                           {reaction, 0.9},
                                                           {distance_noise, 0.10},
                                                           {preview, 6.0},
                                                           {warned_gap, 1.0},
                                                           {warns_after, 11.0},
                                                           {change_threshold, 0.35},
                                                           {signal_time, 0.5},
                                                           {looks_again, 0.4},
                                                           {on_snow, 0.85},
                                                           {change_time, 6.0},
                                                           {glance_interval, 14.0},
                                                           {glance, 0.9},
                                                           {lead, 2.5},
                                                           {ease_off, 1.8},
                                                           {course_preview, 100.0},
                                                           {judgement, 0.35},
                                                           {accepted_wait, 3.2},
                                                           {turn_signal, 1.0}};
constexpr std::initializer_list<Difference> from_experienced = {{position_noise, 0.15},
                                                                {peripheral, 0.8},
                                                                {heading_noise, 0.0014},
                                                                {speed_noise, 0.01},
                                                                {time_gap, 1.6},
                                                                {reaction, 0.6},
                                                                {distance_noise, 0.04},
                                                                {warned_gap, 7.0},
                                                                {warns_after, 2.5},
                                                                {change_threshold, 0.2},
                                                                {glance_interval, 6.0},
                                                                {glance, 0.55},
                                                                {lead, 6.0},
                                                                {ease_off, 0.8},
                                                                {course_preview, 200.0},
                                                                {at_crossings, 9.0},
                                                                {on_snow, 0.7},
                                                                {judgement, 0.05},
                                                                {accepted_wait, 3.8},
                                                                {turn_signal, 2.6}};
constexpr std::initializer_list<Difference> from_tired = {
    // Corrects late and slowly: the lane is kept loosely.
    {frequency, 0.45}, {position_noise, 0.28}, {position_time, 4.0}, {eye_to_hand, 0.30},
    {reaction, 1.2},   {distance_noise, 0.12}, {speed_noise, 0.03},  {glance_interval, 20.0},
    {lead, 3.5},       {ease_off, 1.4},        {judgement, 0.20},    {turn_signal, 1.6}};
constexpr std::initializer_list<Difference> from_escort = {
    // An experienced driver on duty: in the ambulance's tracks, through the lane that opens for it.
    {position_noise, 0.15},  {peripheral, 0.8}, {heading_noise, 0.0014}, {limit_factor, 1.05},
    {time_gap, 1.1},         {reaction, 0.6},   {distance_noise, 0.04},  {speed_noise, 0.01},
    {glance_interval, 10.0}, {glance, 0.55},    {in_tracks, 120.0}};

constexpr Kind kinds[] = {
    {{"plain", "An ordinary driver"}, {}},
    {{"novice", "Looks less far, less often and longer, keeps less distance, reacts later"}, from_novice},
    {{"experienced", "Looks far, often and shortly, keeps the lane closely, reacts early"}, from_experienced},
    {{"tired", "Corrects late and slowly, so that the lane is kept loosely"}, from_tired},
    {{"escort", "Follows an ambulance in its tracks, through the lane that opens for it"}, from_escort}};

}  // namespace

std::vector<NamedDriver> simulated_drivers() {
  std::vector<NamedDriver> drivers;
  for (const Kind& kind : kinds) drivers.push_back(kind.driver);
  return drivers;
}

DriverParameters playing(DriverParameters driver) {
  driver.lanes.follow_ambulance_mps2 *= 2.0;
  driver.lanes.threshold_mps2 *= 0.6;
  driver.lanes.keep_out_mps2 = 0.0;
  driver.lanes.pause_s = 1.5;
  driver.lanes.accepted_gap *= 0.5;
  driver.lanes.safe_braking_mps2 *= 2.0;
  driver.lanes.signal_s *= 0.6;
  driver.lanes.duration_s *= 0.8;
  driver.speed.time_gap_s *= 0.75;
  driver.speed.limit_factor = std::max(driver.speed.limit_factor, 1.1);
  return driver;
}

Expected<DriverParameters> find_driver(std::string_view name) {
  std::string known;
  for (const Kind& kind : kinds) {
    known += (known.empty() ? "" : ", ") + std::string(kind.driver.name);
    if (kind.driver.name != name) continue;
    DriverParameters driver{.name = std::string(kind.driver.name)};
    for (const Difference& difference : kind.differences) difference.parameter(driver) = difference.value;
    return driver;
  }
  return failure(fmt::format("there is no simulated driver '{}'", name), "rig, [car] driver", "use one of: " + known);
}

}  // namespace septet::driver
