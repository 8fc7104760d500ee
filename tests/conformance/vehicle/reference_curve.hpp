#pragma once
/// Curves of the CommonRoad multi-body model: read, and looked up.

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/physics/vehicle/manoeuvre.hpp"
#include "tests/conformance/conformance_data.hpp"
#include "tests/engine/physics/vehicle/car.hpp"

namespace septet::vehicle {

/// Columns by name.
using Curve = std::map<std::string, std::vector<double>>;

inline Curve read_curve(const std::string& file) {
  const std::filesystem::path path = conformance_data("vehicle") / file;
  std::ifstream in(path);
  Curve curve;
  std::vector<std::string> names;
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    std::size_t column = 0;
    const bool header = names.empty();
    for (std::string field; std::getline(fields, field, ','); ++column)
      if (header)
        names.push_back(field);
      else
        curve[names.at(column)].push_back(std::stod(field));
  }
  REQUIRE_MESSAGE(!curve.empty(), "no curve in " << path.string());
  return curve;
}

/// y at the first place where x rises through `at`.
inline double where(const std::vector<double>& x, double at, const std::vector<double>& y) {
  for (std::size_t i = 1; i < x.size(); ++i)
    if (x[i - 1] < at && x[i] >= at) return y[i - 1] + (at - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
  FAIL("the curve never reaches " << at);
  return 0.0;
}

template <class Quantity>
std::vector<double> column(const ManoeuvreReport& report, Quantity quantity) {
  std::vector<double> values;
  for (const ManoeuvreSample& sample : report.series) values.push_back(quantity(sample));
  return values;
}

struct ReferenceCar {
  const char* vehicle;
  const char* curve;
};
inline constexpr ReferenceCar reference_cars[] = {
    {"commonroad-escort", "Escort"}, {"commonroad-bmw-320i", "BMW320i"}, {"commonroad-vanagon", "Vanagon"}};

}  // namespace septet::vehicle
