#pragma once
/// Demands of the road ahead beside the lane: slower in bends and for limits, yielding where others have right of way,
/// indicating before turns.
///
/// Lights come from the snapshot, approaching vehicles that the driver knows of are seen to continue as they do (engine/traffic/yield_line.hpp).
/// Their arrival is judged with an error; the driver waits for any that would arrive sooner than his own time to the
/// line plus a gap. Before a give-way line whose junction walls, or vehicles higher than his eyes,
/// hide he stays able to stop, until it is in view (engine/traffic/network/approach_view.hpp). A line that would need full braking is passed.

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/random.hpp"
#include "engine/driver/driver_parameters.hpp"
#include "engine/driver/driver_view.hpp"
#include "engine/driver/pedals.hpp"
#include "engine/driver/perception.hpp"
#include "engine/traffic/network/approach_view.hpp"
#include "engine/traffic/yield_line.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::driver {

/// Along a corridor: x as there.
struct CourseLine {
  double x_m = 0.0;
  traffic::YieldLine line;
  std::optional<traffic::ApproachView> view;  ///< Empty: nobody beyond it has right of way.
  int lane = 0;                               ///< On a route: the lane in which it leads over the line.
};
struct CourseTurn {
  double begins_m = 0.0, ends_m = 0.0;
  int side = 0;  ///< 1: to the left.
};

struct CourseState {
  std::vector<CourseLine> lines;  ///< Ascending.
  std::vector<CourseTurn> turns;  ///< Ascending.
  WanderingError judgement;       ///< Relative, of others' arrival.
  ReactionDelay<std::optional<double>> eyes;
  double speed_mps = std::numeric_limits<double>::infinity();  ///< Allowed by bends and limits ahead.
  std::optional<double> waits_at_m;                            ///< The line to stop at, as seen a reaction time ago.

  bool stands_at_line(const OwnPlace& own) const { return waits_at_m && own.speed_mps < 0.3; }
};

/// Features along a corridor that the driver has just found. `views`: of the network.
CourseState read_course(const road::RoadNetwork& network, const traffic::Corridor& corridor,
                        std::span<const traffic::ApproachView> views = {});

/// A look ahead, `dt_s` after the last one, with an eye on those `around`, the driver's own car among them.
void look_at_course(CourseState& state, const DriverParameters& driver, const road::RoadNetwork& network,
                    const traffic::Corridor& corridor, const Snapshot& snapshot, std::span<const Participant> around,
                    const OwnPlace& own, double now_s, double dt_s, Random& random);

/// The line to stop at, as a standing obstacle.
std::optional<Obstacle> line_ahead(const CourseState& state, const OwnPlace& own, const SpeedParameters& speed);

IndicatorStalk turn_indicator(const CourseState& state, const CourseParameters& course, const OwnPlace& own);

}  // namespace septet::driver
