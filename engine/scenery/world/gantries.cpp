#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/roadside/obstacle_profile.hpp"
#include "engine/roadside/obstacles.hpp"
#include "engine/roadside/signals.hpp"
#include "engine/scenery/world/sign_faces.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;

constexpr float beam_low_m = 7.15f, beam_high_m = 8.05f;

void add_bar(MeshBuilder& builder, Ground ground, const glm::vec3& low, const glm::vec3& high) {
  builder.material = index_of(ground);
  builder.append(geometry::box(low, high), glm::mat4(1.0f), true);
}

/// Two legs, one in the central reserve, and a lattice beam over all lanes. x along the road.
geometry::PolygonMesh frame_mesh(double width_m) {
  MeshBuilder builder;
  const auto half_width = static_cast<float>(width_m / 2);
  constexpr auto half_leg_m = static_cast<float>(roadside::profile_of(ObstacleKind::gantry_leg).radius_m);
  for (const double leg : roadside::gantry_legs_m(width_m)) {
    const auto y = static_cast<float>(leg);
    add_bar(builder, Ground::metal, {-half_leg_m, y - 0.2f, -1.5f}, {half_leg_m, y + 0.2f, beam_high_m});
  }
  for (const float x : {-0.45f, 0.45f})
    for (const float z : {beam_low_m, beam_high_m - 0.14f})
      add_bar(builder, Ground::metal, {x - 0.07f, -half_width, z}, {x + 0.07f, half_width, z + 0.14f});
  const int bays = static_cast<int>(half_width * 2 / 2.4f);
  builder.material = index_of(Ground::metal);
  for (int i = 0; i < bays; ++i) {
    const float y0 = -half_width + 2 * half_width * static_cast<float>(i) / static_cast<float>(bays),
                y1 = -half_width + 2 * half_width * static_cast<float>(i + 1) / static_cast<float>(bays);
    const float low = i % 2 == 0 ? beam_low_m : beam_high_m, high = i % 2 == 0 ? beam_high_m : beam_low_m;
    for (const float x : {-0.45f, 0.45f}) {
      // Flat diagonals, seen from both sides.
      builder.patch({x, y0, low - 0.05f}, {x, y1, high - 0.05f}, {x, y1, high + 0.05f}, {x, y0, low + 0.05f});
      builder.patch({x, y1, high - 0.05f}, {x, y0, low - 0.05f}, {x, y0, low + 0.05f}, {x, y1, high + 0.05f});
    }
  }
  return builder.take();
}

/// Board in the (y, z) plane that faces −x (oncoming traffic of the right-hand carriageway), its picture as material 0,
/// grey behind it as material 1.
geometry::PolygonMesh board_mesh(float width, float height) {
  MeshBuilder builder;
  builder.material = 0;
  const float w = width / 2, h = height / 2;
  builder.patch({-0.08f, w, -h}, {-0.08f, -w, -h}, {-0.08f, -w, h}, {-0.08f, w, h});
  builder.material = 1;
  builder.patch({0.0f, -w, -h}, {0.0f, w, -h}, {0.0f, w, h}, {0.0f, -w, h});
  builder.patch({-0.08f, w, h}, {-0.08f, -w, h}, {0.0f, -w, h}, {0.0f, w, h});
  builder.patch({0.0f, w, -h}, {0.0f, -w, -h}, {-0.08f, -w, -h}, {-0.08f, w, -h});
  builder.patch({-0.08f, w, -h}, {-0.08f, w, h}, {0.0f, w, h}, {0.0f, w, -h});
  builder.patch({0.0f, -w, -h}, {0.0f, -w, h}, {-0.08f, -w, h}, {-0.08f, -w, -h});
  geometry::PolygonMesh mesh = builder.take();
  mesh.default_edge_crease = geometry::crease_sharp;
  return mesh;
}

class SignMaker {
 public:
  explicit SignMaker(const WorldContext& world) : world_(world) {}

  /// Places a board with this face; equal boards share their mesh, equal names their face.
  void place_board(const std::string& name, const image::Image& face, bool shines, float width, float height,
                   const RigidTransform& world_from_board, float until_m) {
    auto& shape = boards_[name];
    if (shape.geometry == scene::no_node) {
      scene::MaterialParameters material;
      material.base_color = shines ? glm::vec3(0.08f) : glm::vec3(0.85f);
      material.base_color_bitmap = world_.builder.add_bitmap("sign/" + name, face.width, face.height, face.rgba);
      material.roughness = 0.7f;
      if (shines)
        material.emission = glm::vec3(1.6f), scene::shine_by_picture(material);
      else
        material.retroreflection = 180.0f;  // Sheeting of class RA2 (EN 12899-1), cd per lx and m².
      const scene::NodeId painted = world_.builder.add_material("sign/" + name, material);
      shape = add_shape(world_.builder, "sign/" + name, board_mesh(width, height),
                        {painted, world_.palette[index_of(Ground::metal_dark)]});
    }
    Placement placement;
    placement.parent_from_object = world_from_board;
    placement.visible_to_m = until_m;
    place(world_.builder, "sign/" + name, shape, placement);
  }

 private:
  const WorldContext& world_;
  std::map<std::string, Shape> boards_;
};

RigidTransform turned_round(const RigidTransform& pose) {
  return pose * RigidTransform{Vec3(0.0), glm::angleAxis(std::numbers::pi, Vec3(0, 0, 1))};
}

/// Picture of a board. Distances count down along the road from the network's first station, and up against it.
image::Image face_for(double station_km, bool against, std::size_t number) {
  const auto rounded = [](double km) { return std::max(1, static_cast<int>(std::lround(km))); };
  if (against)
    return direction_sign("E7", {{"Malmö", rounded(96.0 + station_km)}, {"Hässleby", rounded(21.0 + station_km)}});
  if (number % 2 == 0)
    return direction_sign("E7", {{"Lindköping", rounded(24.0 - station_km)},
                                 {"Norrbro", rounded(63.0 - station_km)},
                                 {"Stockholm", rounded(218.0 - station_km)}});
  return direction_sign("E7", {{"Lindköping", rounded(24.0 - station_km)}, {"Norrbro", rounded(63.0 - station_km)}});
}

}  // namespace

void build_gantries(const WorldContext& world) {
  SignMaker signs(world);
  std::map<int, Shape> frames;
  double road_start_km = 0.0;
  std::size_t number = 0;
  for (road::RoadIndex index = 0; index < world.roads.network().roads.size(); ++index) {
    const road::Road& road = world.roads.road(index);
    const auto pose = [&](double s, double t, double up) {
      road::RoadPoint p = world.roads.at(index, s, t);
      p.position_m.z += up;
      return RigidTransform{p.position_m, orientation_from_angles(p.heading_rad, 0.0, 0.0)};
    };
    for (const road::RoadObject& object : road.objects) {
      if (object.type != "gantry") continue;
      Shape& frame = frames[static_cast<int>(std::lround(object.width_m * 10))];
      if (frame.geometry == scene::no_node) {
        geometry::PolygonMesh mesh = frame_mesh(object.width_m);
        mesh.default_edge_crease = geometry::crease_sharp;
        frame = add_shape(world.builder, "gantry", mesh, world.palette);
      }
      Placement placement;
      placement.parent_from_object = pose(object.s_m, object.t_m, 0.0);
      placement.visible_to_m = 2500.0f;
      place(world.builder, "gantry", frame, placement);
      const double km = road_start_km + object.s_m / 1000.0;
      const bool rest_area_ahead = km > 5.0 && km < 6.1;
      const std::string name = "direction " + std::to_string(number);
      const image::Image ahead = rest_area_ahead
                                     ? rest_area_sign(static_cast<int>(std::lround((6.3 - km) * 10.0)) * 100)
                                     : face_for(km, false, number);
      const double board_up = beam_low_m + 1.05;
      signs.place_board(name, ahead, false, 7.4f, 3.0f,
                        pose(object.s_m, -11.4, board_up) * RigidTransform{Vec3(-0.62, 0, 0), Quat(1, 0, 0, 0)},
                        900.0f);
      signs.place_board(
          name + " back", face_for(km, true, number), false, 7.4f, 3.0f,
          turned_round(pose(object.s_m, 11.4, board_up)) * RigidTransform{Vec3(-0.62, 0, 0), Quat(1, 0, 0, 0)}, 900.0f);
      ++number;
    }
    for (const road::Signal& signal : road.signals) {
      if (roadside::form_of(signal) != roadside::SignalForm::display) continue;
      const auto limit = static_cast<int>(std::lround(signal.value));
      const RigidTransform at = pose(signal.s_m, signal.t_m, signal.z_offset_m);
      const RigidTransform facing = signal.orientation == road::Orientation::against ? turned_round(at) : at;
      const auto size = static_cast<float>(signal.width_m > 0 ? signal.width_m : 1.2);
      signs.place_board("limit " + std::to_string(limit), speed_display(limit), true, size, size,
                        facing * RigidTransform{Vec3(-0.55, 0, 0), Quat(1, 0, 0, 0)}, 700.0f);
    }
    if (road.length_m > 500.0) road_start_km += road.length_m / 1000.0;
  }
}

}  // namespace septet::scenery
