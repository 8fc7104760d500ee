#include "tests/benchmarks/figures/smoke_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/document/chart_page.hpp"
#include "engine/document/text_file.hpp"
#include "engine/effects/smoke/attraction.hpp"
#include "tests/engine/effects/smoke/bias_texture.hpp"
#include "tests/engine/effects/smoke/smoke_fixtures.hpp"

namespace septet::figures {
namespace {

using document::LineChart;
using document::Point;
using document::Range;
using document::Series;
using document::Stroke;

/// Seen obliquely: y goes back, to the right and up.
Point oblique(double x, double y, double z) { return {x + 0.4 * y, z + 0.3 * y}; }

LineChart empty_chart(std::string title, std::string x_label, std::string y_label, Range x, Range y) {
  LineChart chart;
  chart.title = std::move(title), chart.x_label = std::move(x_label), chart.y_label = std::move(y_label);
  chart.x = x, chart.y = y;
  return chart;
}

/// Samples of the pattern that are that many cells away along some axis, around the particle.
LineChart pattern_figure(const std::string& title, int away) {
  LineChart chart = empty_chart(title, "x + 0.4 y, cells", "z + 0.3 y", {-5.0, 5.0}, {-4.0, 4.0});
  Series samples{"samples", {}, Stroke::dots}, particle{"particle", {{0.0, 0.0}}, Stroke::dots};
  for (const smoke::SampleOffset& s : smoke::sample_pattern())
    if (std::max({std::abs(s.x), std::abs(s.y), std::abs(s.z)}) == away)
      samples.points.push_back(oblique(s.x, s.y, s.z));
  chart.series = {samples, particle};
  chart.title += fmt::format(", {} samples", chart.series.front().points.size());
  return chart;
}

/// A level layer of cells: those that the samples read, and where the particle is drawn to from a crowd to its left.
LineChart hybrid_figure() {
  LineChart chart = empty_chart("Figure 2: particle and grid, one layer", "x, cells", "y", {-4.0, 4.0}, {-4.0, 4.0});
  smoke::State state = smoke::make_smoke(smoke::make_grid({}, 1.0, 15, 15, 15, 0), {{}}, 1);
  Series crowd{"cells of a crowd", {}, Stroke::dots}, read{"cells that are read", {}, Stroke::dots};
  for (int y = -1; y <= 1; ++y) {
    state.density[static_cast<std::size_t>(state.grid.index(6, 7 + y, 7))] = 10;
    crowd.points.push_back({-1.0, double(y)});
  }
  for (const smoke::SampleOffset& s : smoke::sample_pattern())
    if (s.z == 0) read.points.push_back({double(s.x), double(s.y)});
  const auto table = smoke::attraction_table(state.parameters);
  const Vec3 way = smoke::mean_sample(state, table, 7, 7, 7, 1.0);
  chart.series = {read, crowd, {"mean sample, times ten", {{0.0, 0.0}, {10.0 * way.x, 10.0 * way.y}}, Stroke::line}};
  return chart;
}

LineChart sigmoid_figure() {
  LineChart chart = empty_chart("Figure 6: attraction of a cell", "particles in it", "f", {0.0, 12.0}, {-1.1, 1.1});
  for (const double steepness : {0.5, 1.0, 2.0}) {
    smoke::Parameters parameters;
    parameters.steepness = steepness;
    Series line{fmt::format("k = {}{}", steepness, steepness == 1.0 ? ", used" : ""), {}, Stroke::line};
    for (int n = 0; n <= 120; ++n) line.points.push_back({0.1 * n, smoke::attraction(0.1 * n, parameters)});
    chart.series.push_back(std::move(line));
  }
  return chart;
}

LineChart bias_figure() {
  LineChart chart = empty_chart("Figure 7: rows of the bias texture", "sample", "bias", {0.0, 46.0}, {0.9, 1.6});
  const smoke::BiasTexture texture = smoke::bias_texture(11, 0.5);
  for (const std::size_t row : {0u, 3u, 6u, 10u}) {
    Series dots{fmt::format("row {}", row), {}, Stroke::dots};
    for (std::size_t n = 0; n < texture[row].size(); ++n) dots.points.push_back({double(n) + 0.5, texture[row][n]});
    chart.series.push_back(std::move(dots));
  }
  return chart;
}

constexpr double room_m = 24.0, room_height_m = 16.0;

LineChart density_figure(const smoke::State& state, const std::string& title) {
  LineChart chart = empty_chart(title, "x, m", "z", {0.0, room_m}, {0.0, room_height_m});
  std::array<Series, 3> bands{Series{"1 to 4", {}, Stroke::dots}, Series{"5 to 9", {}, Stroke::dots},
                              Series{"10 and more in a cell", {}, Stroke::dots}};
  const smoke::Grid& grid = state.grid;
  for (int k = 0; k < grid.nz; ++k)
    for (int i = 0; i < grid.nx; ++i)
      if (const int count = state.density[static_cast<std::size_t>(grid.index(i, grid.ny / 2, k))]; count > 0)
        bands[count < 5 ? 0 : count < 10 ? 1 : 2].points.push_back({i + 0.5, k + 0.5});
  chart.series.assign(bands.begin(), bands.end());
  return chart;
}

/// Every eighth particle, from the side.
LineChart room_figure(const smoke::State& state, const std::string& title) {
  LineChart chart = empty_chart(fmt::format("{}: mean height {:.2f}", title, smoke::layers_of(state).mean), "x, m",
                                "z, m", {0.0, room_m}, {0.0, room_height_m});
  Series dots{"", {}, Stroke::dots};
  for (std::size_t n = 0; n < state.particles.size(); ++n)
    if (state.particles.number[n] % 8 == 0) dots.points.push_back({state.particles.x[n], state.particles.z[n]});
  chart.series = {dots};
  return chart;
}

}  // namespace

Expected<void> draw_smoke_sampling(const std::filesystem::path& folder) {
  const document::ChartPage page{
      .title = "Smoke: what a particle samples",
      .lines =
          {"Paper: 26, 14 and 6 samples; f is 1 in an empty cell, 0 at 5 particles and −1 at 10.",
           "Here: the pattern, function and texture that Septet's tests use; the paper gives no numbers of the bias."},
      .charts = {hybrid_figure(), pattern_figure("Figure 3: first level", 1),
                 pattern_figure("Figure 4: second level", 2), pattern_figure("Figure 5: third level", 3),
                 sigmoid_figure(), bias_figure()},
      .notes = {}};
  return document::write_text_file(folder / "smoke-sampling.svg", document::to_svg(page));
}

Expected<void> draw_smoke_room(const std::filesystem::path& folder) {
  smoke::State published = smoke::paper_room(), ours = smoke::paper_room();
  published.parameters.most_in_cell = 65535;
  document::ChartPage page{
      .title = "Smoke: a closed room of 24 × 24 × 16 m, 18,432 particles in 25 s",
      .lines =
          {"Paper: hot smoke rises fast, gathers under the ceiling and fills the room from above to a uniform cloud.",
           "Here: on the left the update as published, on the right Septet's; every eighth particle. Heights are",
           "shares of the room's; figure 9 is the layer of cells through the fire."},
      .charts = {},
      .notes = {}};
  const std::array<std::pair<int, int>, 4> instants{{{10, 1}, {11, 10}, {12, 25}, {13, 50}}};
  int tick = 0;
  for (const auto& [figure, at_s] : instants) {
    for (; tick < 60 * at_s; ++tick) {
      if (tick == 60 * 25) published.emitters[0].rate_per_s = ours.emitters[0].rate_per_s = 0.0;
      smoke::advance_smoke_literally(published, smoke::step_s);
      smoke::advance_smoke(ours, Vec3(0.0), {}, smoke::step_s);
    }
    if (at_s == 10) {
      page.charts.insert(page.charts.begin(), density_figure(ours, "Figure 9: density, 10 s, Septet's"));
      page.charts.insert(page.charts.begin(), density_figure(published, "Figure 9: density, 10 s, published"));
    }
    page.charts.push_back(room_figure(published, fmt::format("Figure {}, {} s, published", figure, at_s)));
    page.charts.push_back(room_figure(ours, fmt::format("Figure {}, {} s, Septet's", figure, at_s)));
  }
  return document::write_text_file(folder / "smoke-room.svg", document::to_svg(page));
}

}  // namespace septet::figures
