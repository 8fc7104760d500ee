// septet-fountain FOLDER [--size N] [--samples N] [--photons N] [--nodes N]: figure 6 of Johansson et al., "Distributed
// Ray Tracing in an Open Source Environment": a fountain in the Cornell box with photons and final gather, the cost of
// its parts, and the speed-up of both passes over the number of nodes. The paper's size is 1600. Buckets of photons and
// of pixels are traced once, each with its measured cost; nodes of one speed are dealt these costs first come first
// served, as the figure states.
#include <algorithm>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <functional>
#include <queue>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "engine/core/parallel_for.hpp"
#include "engine/document/text_file.hpp"
#include "engine/image/png.hpp"
#include "engine/raytrace/displayed.hpp"
#include "tests/benchmarks/figures/fountain.hpp"
#include "tests/engine/raytrace/cornell_box.hpp"

namespace {
using namespace septet;
using namespace septet::raytrace;
namespace fs = std::filesystem;

double thread_s() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Cornell's walls and lamp alone: the cubes are the last twelve rectangles.
scene::ResolvedScene empty_box() {
  scene::ResolvedScene box = cornell_box();
  scene::SurfaceMesh& mesh = box.meshes.front();
  constexpr std::size_t rectangles = 6;
  mesh.parts.resize(rectangles);
  mesh.indices.resize(6 * rectangles);
  return box;
}

/// How many times as fast so many nodes of one speed are, each taking the next bucket when it is done with one.
double speed_up(const std::vector<double>& costs, std::size_t nodes) {
  std::priority_queue<double, std::vector<double>, std::greater<>> free_at;
  for (std::size_t n = 0; n < nodes; ++n) free_at.push(0.0);
  double all = 0.0, end = 0.0;
  for (const double cost : costs) {
    const double done = free_at.top() + cost;
    free_at.pop();
    free_at.push(done);
    all += cost, end = std::max(end, done);
  }
  return all / std::max(end, 1e-12);
}

std::string chart(const std::vector<double>& photons, const std::vector<double>& pixels,
                  const std::vector<instant::PixelRectangle>& tiles, std::uint32_t side_px, std::uint32_t samples,
                  std::size_t most_nodes) {
  const double unit = 400.0 / static_cast<double>(most_nodes);
  std::string body = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 960 540" width="960" height="540" font-family="sans-serif" font-size="13" fill="#222"><rect width="960" height="540" fill="#fff"/><text x="16" y="24" font-weight="bold">Figure 6: speed-up of photons and of rays, fountain in the Cornell box</text><text x="16" y="44">{} × {} pixels, {} samples; measured costs of {} buckets of photons and {} of pixels,</text><text x="16" y="61">dealt first come first served to nodes of one speed</text><rect x="80" y="80" width="400" height="400" fill="none" stroke="#888"/><line x1="80" y1="480" x2="480" y2="80" stroke="#999" stroke-dasharray="5 4"/>)",
      side_px, side_px, samples, photons.size(), pixels.size());
  const auto line = [&](const std::vector<double>& costs, const char* color, const char* name, int row) {
    std::string points;
    for (std::size_t n = 1; n <= most_nodes; ++n)
      points += fmt::format("{:.1f},{:.1f} ", 80.0 + unit * static_cast<double>(n), 480.0 - unit * speed_up(costs, n));
    body += fmt::format(
        R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="2"/><text x="96" y="{}" fill="{}">{}: {:.2f} on {} nodes</text>)",
        points, color, 102 + 18 * row, color, name, speed_up(costs, most_nodes), most_nodes);
  };
  line(photons, "#c05621", "photons", 0);
  line(pixels, "#2b6cb0", "rays", 1);
  for (std::size_t n = 0; n <= most_nodes; n += 5)
    body += fmt::format(
        R"(<text x="{0:.0f}" y="498" text-anchor="middle">{2}</text><text x="72" y="{1:.0f}" text-anchor="end">{2}</text>)",
        80.0 + unit * static_cast<double>(n), 484.0 - unit * static_cast<double>(n), n);
  body += R"(<text x="280" y="520" text-anchor="middle">nodes</text>)";
  double dearest = 0.0;
  const auto per_pixel = [&](std::size_t n) { return pixels[n] / (double{1} * tiles[n].width * tiles[n].height); };
  for (std::size_t n = 0; n < tiles.size(); ++n) dearest = std::max(dearest, per_pixel(n));
  const double scale = 400.0 / side_px;
  for (std::size_t n = 0; n < tiles.size(); ++n) {
    const int grey = static_cast<int>(255.0 * per_pixel(n) / std::max(dearest, 1e-12));
    body += fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="#{:02x}{:02x}{:02x}"/>)",
                        520.0 + scale * tiles[n].x, 80.0 + scale * tiles[n].y, scale * tiles[n].width + 0.3,
                        scale * tiles[n].height + 0.3, grey, grey, grey);
  }
  return body +
         fmt::format(R"(<text x="520" y="498">time a pixel: black none, white {:.1f} µs</text></svg>)", 1e6 * dearest) +
         "\n";
}

int draw(const fs::path& folder, std::uint32_t side_px, std::uint32_t samples, std::uint32_t photons,
         std::size_t nodes) {
  const scene::ResolvedScene scene = empty_box();
  auto tracer = RayTracer::create(scene);
  if (!tracer) return fmt::print(stderr, "{}\n", describe(tracer.error())), 1;
  instant::Instant instant = before_cornell_box(side_px);
  instant.exposure = instant::exposure_of_scale(2.0f);
  TraceSettings settings{.samples = samples, .paths = {.longest = 16, .roulette_from = 6}};
  settings.photons = {.caustic = photons, .global = photons, .nearest = 60};
  settings.photons.caustic_reach_m = 0.04f, settings.photons.global_reach_m = 0.1f;
  tracer->begin(instant, settings, fountain(192));

  const auto photon_buckets = tracer->photon_buckets();
  std::vector<std::vector<Photon>> brought(photon_buckets.size());
  std::vector<double> photon_costs(photon_buckets.size());
  parallel_for(photon_buckets.size(), [&](std::size_t n) {
    const double begun_s = thread_s();
    brought[n] = tracer->trace_photons(photon_buckets[n]);
    photon_costs[n] = thread_s() - begun_s;
  });
  tracer->set_photons(brought);

  // The paper's buckets of pixels: 81, or as many as their tiles make.
  const auto tiles = buckets_of(side_px, side_px, std::max(1u, (side_px + 8) / 9));
  std::vector<double> costs(tiles.size());
  std::vector<Bucket> traced(tiles.size());
  parallel_for(tiles.size(), [&](std::size_t n) {
    const double begun_s = thread_s();
    traced[n] = tracer->trace(tiles[n]);
    costs[n] = thread_s() - begun_s;
  });
  TracedPicture picture(side_px, side_px);
  for (const Bucket& bucket : traced) picture.put(bucket);
  fs::create_directories(folder);
  if (const auto written =
          image::write_png(folder / "distributed-6-fountain.png", displayed(picture, instant.exposure));
      !written)
    return fmt::print(stderr, "{}\n", describe(written.error())), 1;
  if (const auto written = document::write_text_file(folder / "distributed-6-fountain.svg",
                                                     chart(photon_costs, costs, tiles, side_px, samples, nodes));
      !written)
    return fmt::print(stderr, "{}\n", describe(written.error())), 1;
  double photon_s = 0.0, pixel_s = 0.0;
  for (const double cost : photon_costs) photon_s += cost;
  for (const double cost : costs) pixel_s += cost;
  fmt::print("{}: photons {:.1f} s, rays {:.1f} s of a processor; {} samples were no number\n",
             (folder / "distributed-6-fountain.svg").string(), photon_s, pixel_s, picture.bad_samples);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Figure 6: a fountain in the Cornell box");
  fs::path folder;
  std::uint32_t side_px = 1600, samples = 16, photons = 200'000;
  std::size_t nodes = 15;
  app.add_option("folder", folder)->required();
  app.add_option("--size", side_px)->check(CLI::Range(9u, 8192u))->capture_default_str();
  app.add_option("--samples", samples)->check(CLI::Range(1u, 65536u))->capture_default_str();
  app.add_option("--photons", photons)->check(CLI::Range(1u, 20'000'000u))->capture_default_str();
  app.add_option("--nodes", nodes)->check(CLI::Range(1u, 1000u))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return draw(folder, side_px, samples, photons, nodes);
}
