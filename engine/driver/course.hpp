#pragma once
/// What the road ahead asks of the driver besides its lane: slower in bends and for limits, waiting where others have right of way, indicating where
/// one turns.
///
/// Lights are seen as the snapshot tells them, who comes as anybody sees it: going on as he does (engine/traffic/yield_line.hpp). When
/// he will be there is judged with an error; who would come sooner than the driver's own time to the line and a gap beyond is waited for.
/// A line that could only be kept by stamping on the pedal is passed.

#include <limits>
#include <optional>
#include <vector>

#include "engine/core/random.hpp"
#include "engine/driver/driver_parameters.hpp"
#include "engine/driver/driver_view.hpp"
#include "engine/driver/pedals.hpp"
#include "engine/driver/perception.hpp"
#include "engine/traffic/yield_line.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::driver {

/// Along a corridor: x as there.
struct CourseLine {
  double x_m = 0.0;
  traffic::YieldLine line;
};
struct CourseTurn {
  double begins_m = 0.0, ends_m = 0.0;
  int side = 0;  ///< 1: to the left.
};

struct CourseState {
  std::vector<CourseLine> lines;  ///< Ascending.
  std::vector<CourseTurn> turns;  ///< Ascending.
  WanderingError judgement;       ///< Relative, of when others will be there.
  ReactionDelay<std::optional<double>> eyes;
  double speed_mps = std::numeric_limits<double>::infinity();  ///< What bends and limits ahead allow.
  std::optional<double> waits_at_m;                            ///< The line that is kept, as seen a reaction time ago.

  bool stands_at_line(const OwnPlace& own) const { return waits_at_m && own.speed_mps < 0.3; }
};

/// What lies along a corridor that the driver has just found.
CourseState read_course(const road::RoadNetwork& network, const traffic::Corridor& corridor);

/// A look ahead, `dt_s` after the last one. `wished_mps` is what the driver would drive here.
void look_at_course(CourseState& state, const DriverParameters& driver, const road::RoadNetwork& network,
                    const traffic::Corridor& corridor, const Snapshot& snapshot, const OwnPlace& own, double now_s,
                    double dt_s, Random& random);

/// The line to be kept, as something that stands there.
std::optional<Obstacle> line_ahead(const CourseState& state, const OwnPlace& own, const SpeedParameters& speed);

IndicatorStalk turn_indicator(const CourseState& state, const CourseParameters& course, const OwnPlace& own);

}  // namespace septet::driver
