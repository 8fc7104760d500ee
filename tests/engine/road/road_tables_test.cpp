#include "engine/road/road_tables.hpp"

#include <sstream>

#include <doctest/doctest.h>

#include "road_files.hpp"

namespace septet::road {

TEST_CASE(
    "the table of samples has a line for each position and fifteen digits are not needed to read "
    "it") {
  const RoadNetwork network = read_or_fail(SmallRoad{}.xml());
  std::istringstream in("road_id,lane_id,s_m,lane_offset_m\na,1,10.000000,0.3\na, -1, 20,0\n");
  std::ostringstream out;
  REQUIRE(sample_table(network, in, out));
  CHECK(out.str() ==
        "road_id,lane_id,s_m,lane_offset_m,x_m,y_m,z_m,heading_rad,pitch_rad,roll_rad,lane_width_m,"
        "curvature_per_m,t_m,"
        "drive_heading_rad\n"
        "a,1,10.000000,0.3,10.00000,1.80000,0.00000,0.0000000,0.0000000,0.0000000,3.00000,0."
        "00000000,1.80000,3.1415927\n"
        "a,-1,20,0,20.00000,-1.75000,0.00000,0.0000000,0.0000000,0.0000000,3.50000,0.00000000,-1."
        "75000,0.0000000\n");
}

TEST_CASE("the table of locations answers points on the road and leaves the others empty") {
  const RoadNetwork network = read_or_fail(SmallRoad{}.xml());
  std::istringstream in("x_m,y_m\n10.5,1\n10,500\n");
  std::ostringstream out;
  REQUIRE(locate_table(network, in, out));
  CHECK(out.str() ==
        "x_m,y_m,road_id,lane_id,s_m,t_m,lane_offset_m,lane_id_any,residual_m,s_true_m,t_true_m\n"
        "10.5,1,a,1,10.50000,1.00000,-0.50000,1,0.00000,10.50000,1.00000\n"
        "10,500,,,,,,,,,\n");
}

TEST_CASE("a wrong line of a table is named") {
  const RoadNetwork network = read_or_fail(SmallRoad{}.xml());
  for (const char* line : {"a,1,10\n", "b,1,10,0\n", "a,x,10,0\n", "a,4,10,0\n", "a,1,1000,0\n", "a,1,nan,0\n"}) {
    std::istringstream in(std::string("road_id,lane_id,s_m,lane_offset_m\n") + line);
    std::ostringstream out;
    const auto done = sample_table(network, in, out);
    REQUIRE_FALSE(done.has_value());
    CHECK(done.error().where == "line 2 of the table");
  }
}

}  // namespace septet::road
