#pragma once
/// A manoeuvre as text: figures as JSON, time series as CSV, both as a plot in SVG.

#include <string>

#include "engine/physics/vehicle/manoeuvre.hpp"

namespace septet::server {

std::string figures_json(const std::string& vehicle, const vehicle::ManoeuvreReport& report);
/// One header line with units in the names, one line per sample.
std::string series_csv(const vehicle::ManoeuvreReport& report);
/// Four panels chosen for the manoeuvre, and the figures beside them.
std::string manoeuvre_svg(const std::string& vehicle, const vehicle::ManoeuvreReport& report);

}  // namespace septet::server
