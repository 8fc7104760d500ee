/// How many come out of a minor road, and into a roundabout, in an hour, beside the Highway Capacity Manual.
/// Sources: Highway Capacity Manual (Transportation Research Board, 2010), equation 19-32 with tables 19-10 and 19-11
/// (two-lane major street); 6th edition (2016), equation 22-1 (one circulating lane).

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/engine/traffic/crossing_cars.hpp"
#include "tests/engine/traffic/crossing_road.hpp"
#include "tests/engine/traffic/flow_sources.hpp"
#include "tests/engine/traffic/roundabout_road.hpp"

namespace septet::traffic {
namespace {

constexpr double hour_s = 3600.0, settles_s = 300.0;

/// Vehicles an hour that find gaps in a flow of `major` an hour, by critical headway and follow-up headway.
double potential_capacity(double major, double critical_s, double follow_up_s) {
  return major * std::exp(-major * critical_s / hour_s) / (1.0 - std::exp(-major * follow_up_s / hour_s));
}
double roundabout_capacity(double circulating) { return 1380.0 * std::exp(-0.00102 * circulating); }

struct Measured {
  double major = 0.0, minor = 0.0;  ///< Vehicles an hour.
  double longest_stand_s = 0.0, hard_s = 0.0;
};

/// A queue on the western arm, whose vehicles all go to the arm `to`, beside `major` vehicles an hour that have right of
/// way over it: from the left alone, or half from each side.
Measured minor_road(Posted posted, const std::string& to, bool from_both, double major) {
  const road::RoadNetwork network = crossing(false, posted);
  const LaneGraph graph = build_lane_graph(network);
  FlowRun run(network, graph, 1);
  const auto route = [&](const std::string& from, const std::string& towards) {
    return std::vector<WayIndex>{way_of_road(network, graph, from, true),
                                 way_of_road(network, graph, from + "-" + towards, true),
                                 way_of_road(network, graph, towards, false)};
  };
  run.add({route("west", to), 120.0, 0.0});
  run.add({route("north", "south"), 10.0, from_both ? 0.5 * major : major});
  if (from_both) run.add({route("south", "north"), 10.0, 0.5 * major});
  run.drive(settles_s);
  const std::size_t minor_line = run.count_on(way_of_road(network, graph, "west-" + to, true));
  std::vector<std::size_t> major_lines{run.count_on(way_of_road(network, graph, "north-south", true)),
                                       run.count_on(way_of_road(network, graph, "south-north", true))};
  run.drive(hour_s);
  Measured measured{0.0, static_cast<double>(run.counted(minor_line)), run.longest_stand_s(), run.hard_s()};
  for (const std::size_t line : major_lines) measured.major += static_cast<double>(run.counted(line));
  return measured;
}

/// A queue on the southern arm that goes on to the north, beside those who come from the west and leave to the east.
Measured roundabout_entry(double circulating) {
  const road::RoadNetwork network = roundabout();
  LaneGraph graph = build_lane_graph(network);
  for (Way& way : graph.ways) way.goes_on = true;  // Beyond the arms' ends: who waits long chooses them as well.
  FlowRun run(network, graph, 1);
  const auto way = [&](const std::string& road, bool along_s = true) {
    return way_of_road(network, graph, road, along_s);
  };
  run.add({{way("south"), way("south-in"), way("south-next"), way("east-past"), way("east-next"), way("north-out"),
            way("north", false)},
           80.0,
           0.0});
  if (circulating > 0.0)
    run.add({{way("west"), way("west-in"), way("west-next"), way("south-past"), way("south-next"), way("east-out"),
              way("east", false)},
             10.0,
             circulating});
  run.drive(settles_s);
  const std::size_t in = run.count_on(way("south-in")), past = run.count_on(way("south-past"));
  run.drive(hour_s);
  return {static_cast<double>(run.counted(past)), static_cast<double>(run.counted(in)), run.longest_stand_s(),
          run.hard_s()};
}

void check_near(const Measured& measured, double expected) {
  MESSAGE(measured.major << " an hour: " << measured.minor << " of " << expected << " ("
                         << std::round(100.0 * (measured.minor / expected - 1.0)) << " %), longest stand "
                         << measured.longest_stand_s << " s, braking above 4 m/s² " << measured.hard_s << " s");
  CHECK(measured.minor > 0.8 * expected);
  CHECK(measured.minor < 1.2 * expected);
}

constexpr double flows[] = {300.0, 600.0, 900.0};

}  // namespace

TEST_CASE("out of a minor road come as many as the Highway Capacity Manual says, within a fifth") {
  struct Movement {
    const char* to;
    bool from_both;
    double critical_s, follow_up_s;
  };
  for (const Posted posted : {Posted::signs, Posted::stop_signs})
    for (const Movement& movement :
         {Movement{"south", false, 6.2, 3.3}, Movement{"east", true, 6.5, 4.0}, Movement{"north", true, 7.1, 3.5}})
      for (const double flow : flows) {
        const std::string sign = posted == Posted::signs ? "give way" : "stop", to = movement.to;
        CAPTURE(sign);
        CAPTURE(to);
        const Measured measured = minor_road(posted, movement.to, movement.from_both, flow);
        check_near(measured, potential_capacity(measured.major, movement.critical_s, movement.follow_up_s));
      }
}

TEST_CASE("into a roundabout of one lane come as many as the Highway Capacity Manual says, within a fifth") {
  for (const double flow : flows) {
    const Measured measured = roundabout_entry(flow);
    check_near(measured, roundabout_capacity(measured.major));
  }
}

}  // namespace septet::traffic
