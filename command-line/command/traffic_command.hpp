#pragma once
/// `septet traffic diagram`: the fundamental diagram of Septet's traffic, figures and a plot.

#include <cstdint>
#include <filesystem>

#include "engine/core/expected.hpp"

namespace septet::server {

struct TrafficDiagramOptions {
  std::filesystem::path out;  ///< Folder for traffic-diagram.json, .csv, .svg; empty writes nothing.
  std::uint64_t seed = 1;
  int lanes = 3;
};

/// Prints flow, speed and its deviation for each density, and writes the files.
Expected<int> run_traffic_diagram(const TrafficDiagramOptions& options);

}  // namespace septet::server
