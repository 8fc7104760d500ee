#include <time.h>

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/document/chart_page.hpp"
#include "engine/document/text_file.hpp"
#include "engine/render/renderer.hpp"
#include "sim-client/ice/ice_viewer.hpp"
#include "tests/benchmarks/figures/ice_figures.hpp"

namespace septet::figures {
namespace {

using document::Range;
using document::Series;
using document::Stroke;
using ice_viewer::IceOptions;

constexpr double fifth = 0.33, full = 4.0;  // The cube covers less than its ball.

double process_time_ms() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// A method of drawing, and its frame times.
struct Way {
  std::string name;
  IceOptions options;
  std::vector<double> times_ms;
  double quartile_ms() const {
    std::vector<double> sorted = times_ms;
    std::ranges::sort(sorted);
    return sorted.empty() ? 0.0 : sorted[sorted.size() / 4];
  }
};

Way way(std::string name, double share, const char* object = "cube") {
  Way made{std::move(name), {}, {}};
  made.options.object = object;
  made.options.width_px = 1024;
  made.options.height_px = 768;
  made.options.share_of_picture = share;
  return made;
}

/// Each method draws a frame in turn, `rounds` times.
Expected<void> measure(std::vector<Way>& ways, int rounds) {
  struct Drawn {
    render::Renderer renderer;
    ice::Surface surface;
  };
  std::vector<Drawn> drawn;
  for (const Way& each : ways) {
    auto renderer =
        render::Renderer::create({each.options.width_px, each.options.height_px, render::DevicePreference::software,
                                  false, render::Antialiasing::none, nullptr});
    if (!renderer) return tl::unexpected(renderer.error());
    if (const auto uploaded = renderer->upload(scene_around(each.options.surroundings)); !uploaded)
      return tl::unexpected(uploaded.error());
    drawn.push_back({std::move(*renderer), *ice::object(each.options.object)});
  }
  for (int round = -2; round < rounds; ++round)
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const instant::FrameInput input = frame_of(drawn[i].surface, ways[i].options, 0.05 * round);
      const double start_ms = process_time_ms();
      if (const auto made = drawn[i].renderer.draw(input); !made) return tl::unexpected(made.error());
      if (const auto read = drawn[i].renderer.read_back(); !read) return tl::unexpected(read.error());
      if (round >= 0) ways[i].times_ms.push_back(process_time_ms() - start_ms);
    }
  return {};
}

Expected<void> write(const std::filesystem::path& path, const document::ChartPage& page) {
  if (auto written = document::write_text_file(path, document::to_svg(page)); !written) return written;
  fmt::print("{}\n", path.string());
  for (const std::string& line : page.lines) fmt::print("  {}\n", line);
  return {};
}

/// Figure 6: three objects, with and without their inside.
Expected<void> objects_figure(const std::filesystem::path& folder) {
  std::vector<Way> ways;
  for (const char* object : {"sphere", "cube", "teapot"})
    for (const bool clear : {true, false}) {
      ways.push_back(way(object, fifth, object));
      if (clear) ways.back().options.cracks = ways.back().options.air_planes = 0;
    }
  if (auto measured = measure(ways, 8); !measured) return measured;
  document::LineChart chart;
  chart.x_label = "triangles";
  chart.y_label = "frames a second of processor time";
  chart.series = {{"without cracks and air", {}, Stroke::line}, {"with them", {}, Stroke::line}};
  double most = 0.0, slower = 0.0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const double triangles = static_cast<double>(ice::object(ways[i].options.object)->size()) / 3.0;
    chart.series[i % 2].points.push_back({triangles, 1e3 / ways[i].quartile_ms()});
    most = std::max(most, 1e3 / ways[i].quartile_ms());
    if (i % 2 == 1) slower += (1.0 - ways[i - 1].quartile_ms() / ways[i].quartile_ms()) / 3.0;
  }
  chart.y = Range{0.0, 1.1 * most};
  const double teapot = ways[2].quartile_ms() / ways[4].quartile_ms() - 1.0;
  return write(
      folder / "ice-6-objects.svg",
      {.title = "Figure 6: frame rates of sphere, cube and teapot",
       .lines = {"Paper: the frame rate is 26 % lower with cracks and air; that of the teapot barely below the cube's",
                 fmt::format(
                     "Here: {:.0f} % lower with cracks and air; that of the teapot {:+.0f} % against the cube's",
                     100.0 * slower, 100.0 * teapot)},
       .charts = {chart},
       .notes = {}});
}

/// Figure 7: two-sided or not, surroundings redrawn or not.
Expected<void> two_sided_figure(const std::filesystem::path& folder) {
  std::vector<Way> ways;
  for (const bool kept : {false, true})
    for (const bool two_sided : {false, true}) {
      ways.push_back(way("", fifth));
      ways.back().options.surroundings_kept = kept;
      ways.back().options.look.two_sided = two_sided;
    }
  if (auto measured = measure(ways, 8); !measured) return measured;
  document::LineChart chart;
  chart.x_label = "1: one-sided, 2: two-sided";
  chart.y_label = "frames a second of processor time";
  chart.series = {{"surroundings drawn anew", {}, Stroke::line}, {"surroundings kept", {}, Stroke::line}};
  double most = 0.0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    chart.series[i / 2].points.push_back({1.0 + static_cast<double>(i % 2), 1e3 / ways[i].quartile_ms()});
    most = std::max(most, 1e3 / ways[i].quartile_ms());
  }
  chart.y = Range{0.0, 1.1 * most};
  const auto slower = [&](std::size_t one, std::size_t two) {
    return 100.0 * (1.0 - ways[one].quartile_ms() / ways[two].quartile_ms());
  };
  return write(folder / "ice-7-two-sided.svg",
               {.title = "Figure 7: frame rates without and with two-sided refraction",
                .lines = {"Paper: two-sided refraction costs about 10 %",
                          fmt::format("Here: {:.1f} % with surroundings drawn anew, {:.1f} % with those that are kept",
                                      slower(0, 1), slower(2, 3))},
                .charts = {chart},
                .notes = {}});
}

/// Costs in the text, in one run.
Expected<void> cost_table(const std::filesystem::path& folder) {
  std::vector<Way> ways;
  for (const double share : {fifth, full}) {
    const char* place = share == fifth ? "a fifth" : "full";
    const auto add = [&](const char* what) -> IceOptions& {
      ways.push_back(way(fmt::format("{}, {}", place, what), share));
      return ways.back().options;
    };
    add("all");
    add("one-sided").look.two_sided = false;
    IceOptions& clear = add("no cracks, no air");
    clear.cracks = clear.air_planes = 0;
    add("no cracks").cracks = 0;
    add("no air").air_planes = 0;
    add("quality").look.mode = ice::Mode::quality;
  }
  if (auto measured = measure(ways, 10); !measured) return measured;
  document::ChartPage page{.title = "Costs of ice", .lines = {}, .charts = {}, .notes = {}};
  for (const Way& each : ways) page.lines.push_back(fmt::format("{}: {:.1f} ms", each.name, each.quartile_ms()));
  const auto over = [&](std::size_t a, std::size_t b) { return ways[a].quartile_ms() / ways[b].quartile_ms(); };
  page.lines.push_back(fmt::format("full screen over a fifth: {:.2f} (paper 2.2)", over(6, 0)));
  page.lines.push_back(fmt::format("two-sided: {:+.1f} % of a fifth, {:+.1f} % of all (paper 10 %)",
                                   100 * over(0, 1) - 100, 100 * over(6, 7) - 100));
  page.lines.push_back(
      fmt::format("cracks and air: {:+.1f} % of a fifth, {:+.1f} % of all (paper's frame rate -26 %, +35 %)",
                  100 * over(0, 2) - 100, 100 * over(6, 8) - 100));
  return write(folder / "ice-costs.svg", page);
}

}  // namespace

Expected<void> draw_ice_times(const std::filesystem::path& folder) {
  for (const auto& figure : {cost_table, objects_figure, two_sided_figure})
    if (auto drawn = figure(folder); !drawn) return drawn;
  return {};
}

}  // namespace septet::figures
