// Twenty third-party OpenDRIVE files, and where esmini's road manager says that lanes lie in the
// world and points on the roads. Tolerances: the README beside the files.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/road/road_position.hpp"
#include "tests/conformance/conformance_data.hpp"
#include "tests/why_not.hpp"

namespace septet::road {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

using Row = std::map<std::string, std::string>;

std::vector<Row> read_rows(const fs::path& path) {
  std::istringstream text(read_text(path));
  std::vector<std::string> columns;
  std::vector<Row> rows;
  for (std::string line; std::getline(text, line);) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    if (columns.empty()) {
      columns = fields;
      continue;
    }
    Row row;
    for (std::size_t i = 0; i < columns.size() && i < fields.size(); ++i) row[columns[i]] = fields[i];
    rows.push_back(std::move(row));
  }
  return rows;
}

double number(const Row& row, const char* column) { return std::stod(row.at(column)); }

/// The largest error of each quantity of a file, and the row where it occurs.
class Errors {
 public:
  void add(const std::string& quantity, double error, double tolerance, const Row& row, const char* first,
           const char* second) {
    ++count_;
    if (std::abs(error) <= tolerance) return;
    if (++failed_ <= 5) MESSAGE(quantity << " off by " << error << " at " << row.at(first) << " " << row.at(second));
  }
  int failed() const { return failed_; }
  int count() const { return count_; }

 private:
  int failed_ = 0, count_ = 0;
};

template <class Check>
int for_each_file(const char* suffix, Check check) {
  int files = 0;
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(conformance_data("roads"))) {
    if (entry.path().extension() == ".xodr") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    CAPTURE(path.filename().string());
    const auto network = read_opendrive(read_text(path), path.filename().string());
    const std::string what = why_not(network);
    REQUIRE_MESSAGE(network.has_value(), what);
    const auto rows = read_rows(path.parent_path() / (path.stem().string() + suffix));
    REQUIRE_FALSE(rows.empty());
    check(*network, rows, path.stem().string());
    ++files;
  }
  CHECK(files > 0);
  return files;
}

}  // namespace

TEST_CASE("every lane of the conformance roads lies where esmini says") {
  for_each_file(".samples.csv", [](const RoadNetwork& network, const std::vector<Row>& rows, const std::string& name) {
    Errors errors;
    for (const Row& row : rows) {
      const auto road = find_road(network, row.at("road_id"));
      REQUIRE(road.has_value());
      const int lane = std::stoi(row.at("lane_id"));
      const double s = number(row, "s_m");
      const LanePoint point = evaluate_lane(network, {*road, lane, s, number(row, "lane_offset_m")});
      const auto expect = [&](const char* column, double value, double tolerance) {
        errors.add(name + " " + column, value - number(row, column), tolerance, row, "road_id", "s_m");
      };
      const auto expect_angle = [&](const char* column, double value) {
        errors.add(name + " " + column, wrap_angle(value - number(row, column)), 1e-4, row, "road_id", "s_m");
      };
      const bool cubic = !network.roads[*road].plan.cubic_knots.empty();
      expect("x_m", point.road.position_m.x, 1e-3);
      expect("y_m", point.road.position_m.y, 1e-3);
      expect("z_m", point.road.position_m.z, 1e-3);
      expect_angle("heading_rad", point.road.heading_rad);
      expect_angle("pitch_rad", point.road.pitch_rad);
      expect_angle("roll_rad", point.road.roll_rad);
      expect("lane_width_m", point.lane_width_m, 1e-3);
      expect("t_m", point.t_m, 1e-3);
      expect("curvature_per_m", point.road.curvature_per_m, cubic ? 1e-5 : 1e-6);
      if (number(row, "roll_rad") == 0.0) {
        const bool along = runs_along_s(network, {*road, lane, s, 0.0});
        const double tangent = point.road.heading_rad + std::atan(point.lane_slope);
        expect_angle("drive_heading_rad", along ? tangent : tangent + std::numbers::pi);
      }
    }
    CHECK(errors.failed() == 0);
    CHECK(errors.count() >= 9 * static_cast<int>(rows.size()));
  });
}

TEST_CASE(
    "every point of the conformance roads is located on the road and lane and station that it was "
    "made from") {
  for_each_file(".inverse.csv", [](const RoadNetwork& network, const std::vector<Row>& rows, const std::string& name) {
    Errors errors;
    int wrong_lanes = 0;
    for (const Row& row : rows) {
      const Vec2 point(number(row, "x_m"), number(row, "y_m"));
      const auto found = locate(network, point);
      REQUIRE(found.has_value());
      const bool right = network.roads[found->position.road].id == row.at("road_id") &&
                         found->lanes.lane == std::stoi(row.at("lane_id")) &&
                         found->lanes.lane_any_type == std::stoi(row.at("lane_id_any"));
      if (!right && ++wrong_lanes <= 3) {
        MESSAGE(name << ": " << point.x << " " << point.y << " is on lane " << found->lanes.lane << " of road "
                     << network.roads[found->position.road].id);
      }
      errors.add(name + " s_true", found->position.s_m - number(row, "s_true_m"), 1.1e-3, row, "x_m", "y_m");
      errors.add(name + " t_true", found->position.t_m - number(row, "t_true_m"), 1.1e-3, row, "x_m", "y_m");
      const double slack = 1.1e-3 + number(row, "residual_m");
      errors.add(name + " s", found->position.s_m - number(row, "s_m"), slack, row, "x_m", "y_m");
      errors.add(name + " t", found->position.t_m - number(row, "t_m"), slack, row, "x_m", "y_m");

      // A hint from a metre before gives the same result.
      const RoadPosition hint{found->position.road, found->position.s_m - 1.0, found->position.t_m};
      const auto hinted = locate(network, point, &hint);
      REQUIRE(hinted.has_value());
      errors.add(name + " s with a hint", hinted->position.s_m - found->position.s_m, 1e-6, row, "x_m", "y_m");
    }
    CHECK(wrong_lanes == 0);
    CHECK(errors.failed() == 0);
  });
}

}  // namespace septet::road
