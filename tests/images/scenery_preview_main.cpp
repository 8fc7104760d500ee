/// Draws the vehicles and the road world to PNG files, for people to judge.
///
///     scenery_preview OUT vehicles [MODEL…]              turntables; of the pedestrian also the phases of a step
///     scenery_preview OUT eyes [MODEL…]                  out of the eyes of who drives, rides or walks: ahead, down,
///                                                        left and right; glass of mirrors is blank
///     scenery_preview OUT road ROAD.xodr [ROAD@]S:T[:HEADING_DEG[:HEIGHT_M[:PITCH_DEG[:TRAFFIC]]]]…
///
/// S and T place the eye on the road of that id, else on the first one; the view is 44° × 30°, that of one screen of
/// the rig.
///
/// Prints the submission time of each picture, and the size of the scene on the wire.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/image/draw.hpp"
#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/road/road_position.hpp"
#include "engine/scene/command_codec.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/vehicles/cockpit.hpp"
#include "engine/scenery/vehicles/eye_point.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "engine/world/paint.hpp"

namespace septet {
namespace {

constexpr double degree_rad = std::numbers::pi / 180.0;
constexpr std::uint32_t width = 960, height = 640;

/// `picture` with its upper left corner at (x, y); it lies within the sheet.
void put(image::Image& sheet, const image::Image& picture, std::uint32_t x, std::uint32_t y) {
  for (std::uint32_t row = 0; row < picture.height; ++row)
    for (std::uint32_t column = 0; column < picture.width; ++column)
      sheet.set(x + column, y + row, picture.at(column, row));
}

template <class T>
T value_of(Expected<T> result) {
  if (result) return std::move(*result);
  fmt::print(stderr, "{}\n", describe(result.error()));
  std::exit(1);
}
void must(const Expected<void>& result) {
  if (result) return;
  fmt::print(stderr, "{}\n", describe(result.error()));
  std::exit(1);
}

image::Image drawn(render::Renderer& renderer, const instant::FrameInput& input) {
  must(renderer.draw(input));
  return value_of(renderer.read_back());
}

instant::FrameInput frame(const RigidTransform& world_from_camera, double horizontal_deg) {
  instant::FrameInput input;
  input.simulated_time_s = 20.0;
  const double horizontal = horizontal_deg * degree_rad;
  const double vertical = 2.0 * std::atan(std::tan(horizontal / 2.0) * height / width);
  instant::FrameView view;
  view.projection = instant::symmetric_view(Vec3(0.0), 0.0, 0.0, horizontal, vertical);
  view.world_from_car = world_from_camera;
  view.viewport = {0, 0, width, height};
  input.views.push_back(view);
  return input;
}

RigidTransform camera(const Vec3& eye_m, double heading_rad, double pitch_up_rad) {
  return {eye_m, orientation_from_angles(heading_rad, -pitch_up_rad, 0.0)};
}

std::uint32_t prototype_of(const scene::ResolvedScene& scene, std::string_view name) {
  for (std::uint32_t i = 0; i < scene.prototypes.size(); ++i)
    if (scene.prototypes[i].name == name || scene.prototypes[i].name == "model/" + std::string(name)) return i;
  fmt::print(stderr, "no prototype {}\n", name);
  std::exit(1);
}

instant::DrawnParticipant vehicle(const scene::ResolvedScene& scene, std::string_view model, const RigidTransform& pose,
                                  const glm::vec3& paint) {
  instant::DrawnParticipant participant;
  participant.prototype = prototype_of(scene, model);
  participant.world_from_vehicle = pose;
  participant.paint = paint;
  participant.wheel_spin_rad = 0.4;
  return participant;
}

/// Four sides of a model, near, and one from each further level of detail.
void turntable(render::Renderer& renderer, const scene::ResolvedScene& scene, const VehicleModel& model,
               const std::filesystem::path& out) {
  image::Image sheet(width, height);
  const double reach = std::max(model.length_m * 1.45, model.height_m * 2.6);
  constexpr double azimuths[]{32, 148, 90, 35}, elevations[]{12, 16, 4, 14}, distances[]{1, 1, 1, 1};
  for (int i = 0; i < 4; ++i) {
    const double distance = i == 3 ? 75.0 : reach * distances[i];
    const Vec3 middle(model.centre_x_m(), 0, model.height_m * 0.45);
    const double a = azimuths[i] * degree_rad, e = elevations[i] * degree_rad;
    const Vec3 eye = middle + distance * Vec3(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
    const double angle = 2.0 * std::atan(reach * std::tan(24.0 * degree_rad) / distance) / degree_rad;
    auto input = frame(camera(eye, a + std::numbers::pi, -e), angle);
    auto participant = vehicle(scene, model.name, {}, {0.30f, 0.035f, 0.03f});
    if (i == 1) participant.lamps.set(Lamp::brake, true);
    if (i != 2) participant.lamps.set(Lamp::low_beam, true);
    participant.lamps.set(Lamp::beacon, true);
    if (i == 0) participant.front_steer_rad = 0.35;
    if (i != 1) participant.speed_mps = 1.4;  // People walk, except one.
    if (i == 2) participant.wheel_spin_rad = 1.6;
    input.participants.push_back(participant);
    put(sheet, image::resize(drawn(renderer, input), width / 2, height / 2), (i % 2) * width / 2, (i / 2) * height / 2);
  }
  must(image::write_png(out / fmt::format("{}.png", model.name), sheet, image::PngEffort::fast));
  fmt::print("{}: {} triangles, {} draws at 75 m\n", model.name, renderer.statistics().triangles,
             renderer.statistics().draws);
}

/// Eight pictures of one step at 10 m, each in a jacket of its own, and one who lies on his back.
void steps(render::Renderer& renderer, const scene::ResolvedScene& scene, const std::filesystem::path& out) {
  constexpr double away_m = 10.0, apart_m = 0.95;
  auto input = frame(camera({0.0, 0.0, 1.5}, 0.0, -0.04), 30.0);
  for (int i = 0; i < 9; ++i) {
    RigidTransform pose{{away_m, (4 - i) * apart_m, 0.0}, orientation_from_angles(-0.5 * std::numbers::pi, 0.0, 0.0)};
    if (i == 8)
      pose = {{away_m - 1.5, 0.5, 0.13}, orientation_from_angles(0.5 * std::numbers::pi, -0.5 * std::numbers::pi, 0.0)};
    auto walker = vehicle(scene, "pedestrian", pose, body_color(static_cast<std::uint8_t>(i)));
    walker.wheel_spin_rad = 2.0 * std::numbers::pi * i / 8;
    walker.speed_mps = i == 8 ? 0.0 : 1.4;
    if (i == 8) walker.thrown_rad = {0.6, -0.1, 1.1, 0.3};
    input.participants.push_back(walker);
  }
  must(image::write_png(out / "pedestrian-steps.png", drawn(renderer, input), image::PngEffort::fast));
}

/// Ahead, down, left and right, out of a model's eyes; a car and a walker stand ahead.
void eyes(render::Renderer& renderer, const scene::ResolvedScene& scene, const VehicleModel& model,
          const std::filesystem::path& out) {
  if (!scenery::is_driven(model)) return;
  image::Image sheet(width, height);
  constexpr double headings_deg[]{0, 0, 60, -60}, pitches_deg[]{-8, -55, -10, -10};
  for (std::uint32_t i = 0; i < 4; ++i) {
    auto input = frame(camera(scenery::eye_in(model), headings_deg[i] * degree_rad, pitches_deg[i] * degree_rad), 90.0);
    auto inside = vehicle(scene, "interior/" + std::string(model.name), {}, {0.30f, 0.035f, 0.03f});
    inside.speed_mps = 1.4;
    input.participants.push_back(inside);
    for (const auto& [name, left_m] : {std::pair{"saloon", 3.0}, std::pair{"pedestrian", -3.0}})
      input.participants.push_back(
          vehicle(scene, name, {{model.front_m() + 8.0, left_m, 0.0}, Quat(1, 0, 0, 0)}, {0.02f, 0.06f, 0.20f}));
    put(sheet, image::resize(drawn(renderer, input), width / 2, height / 2), (i % 2) * width / 2, (i / 2) * height / 2);
  }
  must(image::write_png(out / fmt::format("{}.png", model.name), sheet, image::PngEffort::fast));
}

/// Some traffic ahead of and beside the camera, so that scale can be judged.
void add_traffic(instant::FrameInput& input, const scene::ResolvedScene& scene, const road::RoadNetwork& network,
                 double s) {
  constexpr const char* models[]{"saloon", "estate",     "lorry",  "hatchback", "ambulance", "suv",
                                 "van",    "motorcycle", "saloon", "lorry",     "estate",    "hatchback"};
  constexpr double ahead[]{28, 14, 60, 75, 45, 110, 140, 22, 180, 240, 210, 300};
  constexpr int lanes[]{-5, -3, -7, -4, -6, -5, -7, -4, -3, -7, -6, -5};
  const glm::vec3 paints[]{
      {0.32f, 0.03f, 0.03f}, {0.02f, 0.06f, 0.20f}, {0.6f, 0.6f, 0.6f}, {0.04f, 0.05f, 0.05f}, {0.7f, 0.7f, 0.68f}};
  for (int k = 0; k < 12; ++k)
    for (const int side : {1, -1}) {
      const double at = s + ahead[k] * side + (side < 0 ? 15 : 0);
      const int lane = lanes[k] * (side < 0 && k % 2 == 1 ? -1 : 1);
      if (at < 0 || at > network.roads[0].length_m) continue;
      const auto point = road::evaluate_lane(network, {0, lane, at, 0.0});
      auto participant = vehicle(scene, models[k], road::world_from_lane(point), paints[(k + (side > 0 ? 0 : 2)) % 5]);
      participant.lamps.set(Lamp::low_beam, true);
      participant.lamps.set(Lamp::brake, k == 0);
      participant.lamps.set(Lamp::beacon, true);
      input.participants.push_back(participant);
    }
}

const char* name_of(scene::NodeType type) {
  constexpr const char* names[]{"object", "geometry", "material", "bitmap"};
  return static_cast<int>(type) < 4 ? names[static_cast<int>(type)] : "other";
}

/// Bytes of the commands that build the store, in all and by the names of nodes.
std::size_t wire_bytes(const scene::Store& store, bool table) {
  std::map<std::string, std::pair<std::size_t, std::size_t>> by_name;
  std::size_t all = 0;
  for (const auto& [id, node] : store.nodes()) {
    auto& [count, bytes] = by_name[std::string(name_of(node.type())) + " " + node.name.substr(0, node.name.find('/'))];
    ++count;
    scene::describe_node(node, [&](const scene::Command& command) {
      Bytes encoded;
      scene::encode(command, encoded);
      bytes += encoded.size();
      all += encoded.size();
    });
  }
  if (table)
    for (const auto& [name, size] : by_name) fmt::print("  {:9} bytes {:6} {}\n", size.second, size.first, name);
  return all;
}

void vehicles(const std::filesystem::path& out, const std::vector<std::string>& names, bool from_eyes) {
  scene::Store store;
  scene::SceneBuilder builder(store);
  scenery::build_vehicles(builder);
  fmt::print("vehicles: {} nodes, {} bytes on the wire\n", store.nodes().size(), wire_bytes(store, false));
  const scene::ResolvedScene scene = scene::resolve(store);
  auto renderer = value_of(render::Renderer::create({.width = width, .height = height}));
  must(renderer.upload(scene));
  for (const VehicleModel& model : vehicle_models())
    if (names.empty() || std::find(names.begin(), names.end(), model.name) != names.end())
      (from_eyes ? eyes : turntable)(renderer, scene, model, out);
  if (from_eyes) return;
  if (names.empty() || std::find(names.begin(), names.end(), "pedestrian") != names.end()) steps(renderer, scene, out);
}

void road_views(const std::filesystem::path& out, const std::vector<std::string>& words) {
  std::ifstream file(words.at(0));
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const road::RoadNetwork network = value_of(road::read_opendrive(text, words.at(0)));
  scene::Store store;
  scene::SceneBuilder builder(store);
  scenery::build_vehicles(builder);
  scenery::build_road_world(builder, network, 1);
  fmt::print("world: {} nodes, {} bytes on the wire\n", store.nodes().size(), wire_bytes(store, true));
  const scene::ResolvedScene scene = scene::resolve(store);
  auto renderer = value_of(render::Renderer::create({.width = width, .height = height}));
  must(renderer.upload(scene));
  for (std::size_t i = 1; i < words.size(); ++i) {
    // Stations and angles as on the command line; all but the first two are optional.
    double values[6]{0, -8, 0, 1.2, 0, 1};
    const std::size_t at = words[i].find('@');
    const std::optional<road::RoadIndex> named =
        at == std::string::npos ? std::nullopt : road::find_road(network, words[i].substr(0, at));
    std::size_t from = at == std::string::npos ? 0 : at + 1;
    for (double& value : values) {
      if (from > words[i].size()) break;
      const std::size_t to = std::min(words[i].find(':', from), words[i].size());
      value = std::stod(words[i].substr(from, to - from));
      from = to + 1;
    }
    const auto point = road::evaluate(network, {named.value_or(0), values[0], values[1]});
    auto input = frame(camera(point.position_m + Vec3(0, 0, values[3]), point.heading_rad + values[2] * degree_rad,
                              values[4] * degree_rad),
                       44.0);
    if (values[5] > 0.0 && !named) add_traffic(input, scene, network, values[0]);
    must(image::write_png(out / fmt::format("road-{}.png", words[i]), drawn(renderer, input), image::PngEffort::fast));
    const auto& cost = renderer.statistics();
    fmt::print("{}: {} triangles ({} in shadows), {} draws, {} instances\n", words[i], cost.triangles,
               cost.shadow_triangles, cost.draws, cost.instances);
  }
}

}  // namespace
}  // namespace septet

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 2 || (words[1] == "road" && words.size() < 4)) {
    fmt::print(stderr,
               "scenery_preview OUT vehicles [MODEL…] | OUT eyes [MODEL…] | OUT road ROAD.xodr "
               "[ROAD@]S:T[:HEADING_DEG[:HEIGHT_M[:PITCH_DEG[:TRAFFIC]]]]…\n");
    return 2;
  }
  std::filesystem::create_directories(words[0]);
  const std::vector<std::string> rest(words.begin() + 2, words.end());
  if (words[1] == "vehicles" || words[1] == "eyes")
    septet::vehicles(words[0], rest, words[1] == "eyes");
  else
    septet::road_views(words[0], rest);
}
