#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/geometry/mesh_builder.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/roadside/signals.hpp"
#include "engine/scenery/world/sign_paint.hpp"
#include "engine/scenery/world/world_context.hpp"
#include "engine/scenery/world/world_finish.hpp"

namespace septet::scenery {
namespace {

using geometry::MeshBuilder;
using roadside::SignalForm;
using roadside::StandingSignal;

/// Sheet of a sign's shape that faces −x, from 0 to 1 in y and z around its middle: its picture as material 0, its back
/// as material 1.
geometry::PolygonMesh sheet(const std::vector<glm::vec2>& outline) {
  MeshBuilder builder;
  const auto at = [](const glm::vec2& p, float x) { return glm::vec3(x, 0.5f - p.x, 0.5f - p.y); };
  for (const bool front : {true, false}) {
    builder.material = front ? 0 : 1;
    const float x = front ? -0.012f : 0.0f;
    const std::uint32_t middle = builder.vertex(at(glm::vec2(0.5f), x));
    std::vector<std::uint32_t> rim;
    rim.reserve(outline.size());
    for (const glm::vec2& corner : outline) rim.push_back(builder.vertex(at(corner, x)));
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const std::size_t next = (i + 1) % rim.size();
      if (front)  // Counter-clockwise for a viewer who looks along x.
        builder.triangle(middle, rim[next], rim[i], {{glm::vec2(0.5f), outline[next], outline[i], {}}});
      else
        builder.triangle(middle, rim[i], rim[next]);
    }
  }
  geometry::PolygonMesh mesh = builder.take();
  mesh.default_edge_crease = geometry::crease_sharp;
  return mesh;
}

/// Key that distinguishes two faces.
std::string key_of(const SignFace& face) {
  return fmt::format("sign {}-{}{}{}{}", static_cast<int>(face.style), static_cast<int>(face.symbol),
                     face.yellow ? "y" : "", face.text.empty() ? "" : " ", face.text);
}

class SignalWorks {
 public:
  explicit SignalWorks(const WorldContext& world) : world_(world) {}

  void add(const StandingSignal& standing) {
    if (standing.form == SignalForm::board)
      add_board(standing);
    else
      add_light(standing);
    if (standing.has_post) add_post(standing);
  }

  void finish() {
    for (auto& [road, builder] : posts_) {
      geometry::PolygonMesh mesh = builder.mesh.take();
      Placement placement;
      placement.parent_from_object = builder.world_from_posts;
      placement.visible_to_m = 500.0f;
      place(world_.builder, "sign posts", add_shape(world_.builder, "sign posts", mesh, world_.palette), placement);
    }
  }

 private:
  struct Posts {
    MeshBuilder mesh;
    RigidTransform world_from_posts;
  };

  void add_board(const StandingSignal& standing) {
    const SignFace face = sign_face(*standing.signal);
    const std::string name = key_of(face);
    Shape& shape = faces_[name];
    if (shape.geometry == scene::no_node) {
      const image::Image picture = paint_sign(face);
      scene::MaterialParameters material;
      material.base_color = glm::vec3(0.85f);
      material.base_color_bitmap =
          world_.builder.add_bitmap("sign/" + name, picture.width, picture.height, picture.rgba);
      material.roughness = 0.7f;
      material.retroreflection = 180.0f;  // Sheeting of class RA2 (EN 12899-1), cd per lx and m².
      const scene::NodeId painted = world_.builder.add_material("sign/" + name, material);
      shape = add_shape(world_.builder, "sign/" + name, sheet(sign_outline(face.style)),
                        {painted, world_.palette[index_of(Ground::metal_dark)]});
    }
    Placement placement;
    placement.parent_from_object =
        standing.world_from_signal *
        RigidTransform{Vec3(-0.06, 0.0, standing.bottom_m + 0.5 * standing.height_m), Quat(1, 0, 0, 0)};
    placement.scale = {1.0f, static_cast<float>(standing.width_m), static_cast<float>(standing.height_m)};
    placement.visible_to_m = 400.0f;
    place(world_.builder, "sign", shape, placement);
  }

  /// Places a head of lamps: amber lit, as a light out of service. Lenses of switched lights are put in front of these
  /// by the prototypes "traffic light" and "pedestrian light".
  void add_light(const StandingSignal& standing) {
    const bool walkers = standing.form == SignalForm::pedestrian_light;
    Shape& shape = lights_[walkers];
    const auto height = static_cast<float>(standing.height_m), half = static_cast<float>(standing.width_m / 2);
    if (shape.geometry == scene::no_node) {
      MeshBuilder builder;
      builder.material = index_of(Ground::metal_dark);
      builder.append(geometry::box({-0.16f, -half, 0.0f}, {0.0f, half, height}, 0.02f), glm::mat4(1.0f), true);
      const int lamps = walkers ? 2 : 3;
      constexpr Ground lenses[]{Ground::lamp_red, Ground::lamp_amber, Ground::lamp_green};
      for (int i = 0; i < lamps; ++i) {
        const float z = height * (static_cast<float>(lamps - i) - 0.5f) / static_cast<float>(lamps);
        builder.material = index_of(walkers && i == 1 ? Ground::lamp_green : lenses[i]);
        add_lens(builder, z, 0.1f);
        builder.material = index_of(Ground::metal_dark);
        add_hood(builder, z, 0.115f);
      }
      geometry::PolygonMesh mesh = builder.take();
      mesh.default_edge_crease = geometry::crease_sharp;
      shape = add_shape(world_.builder, "traffic light", mesh, world_.palette);
    }
    Placement placement;
    placement.parent_from_object =
        standing.world_from_signal * RigidTransform{Vec3(-0.06, 0.0, standing.bottom_m), Quat(1, 0, 0, 0)};
    placement.visible_to_m = 500.0f;
    place(world_.builder, "traffic light", shape, placement);
    if (std::exchange(has_lenses_[walkers], true)) return;
    add_lenses(walkers, height);
  }

  /// Adds the lenses of a head whose state is known: dark unless they are lit.
  void add_lenses(bool walkers, float height) {
    struct Lens {
      const char* name;
      scene::PartRole role;
      glm::vec3 color, emission;
    };
    const std::array lenses{
        Lens{"signal red", scene::PartRole::signal_red, {0.10f, 0.010f, 0.008f}, {3.4f, 0.12f, 0.05f}},
        Lens{"signal amber", scene::PartRole::signal_amber, {0.10f, 0.05f, 0.006f}, {3.4f, 1.4f, 0.08f}},
        Lens{"signal green", scene::PartRole::signal_green, {0.008f, 0.055f, 0.040f}, {0.12f, 2.8f, 1.35f}}};
    const scene::NodeId root = world_.builder.add_prototype(walkers ? "pedestrian light" : "traffic light");
    const int lamps = walkers ? 2 : 3;
    for (int i = 0; i < lamps; ++i) {
      const Lens& lens = lenses[static_cast<std::size_t>(walkers && i == 1 ? 2 : i)];
      scene::MaterialParameters look;
      look.base_color = lens.color;
      look.emission = lens.emission;
      look.roughness = 0.4f;
      MeshBuilder builder;
      add_lens(builder, height * (static_cast<float>(lamps - i) - 0.5f) / static_cast<float>(lamps), 0.102f, 0.008f);
      Placement placement;
      placement.role = lens.role;
      placement.visible_to_m = 500.0f;
      placement.casts_shadow = false;
      place(world_.builder, lens.name,
            add_shape(world_.builder, lens.name, builder.take(), {world_.builder.add_material(lens.name, look)}),
            placement, root);
    }
  }

  static void add_lens(MeshBuilder& builder, float z, float radius, float before = 0.0f) {
    const std::uint32_t middle = builder.vertex({-0.175f - before, 0.0f, z});
    constexpr int sides = 12;
    std::uint32_t first = 0, last = 0;
    for (int i = 0; i <= sides; ++i) {
      const float angle = 6.2831853f * static_cast<float>(i) / sides;
      const std::uint32_t v =
          i < sides ? builder.vertex({-0.162f - before, radius * std::cos(angle), z + radius * std::sin(angle)})
                    : first;
      if (i == 0) first = v;
      if (i > 0) builder.triangle(middle, v, last);
      last = v;
    }
  }

  /// Adds half a tube over the lens, seen from below and above.
  static void add_hood(MeshBuilder& builder, float z, float radius) {
    constexpr int sides = 6;
    for (int i = 0; i < sides; ++i) {
      const float a = 3.1415927f * static_cast<float>(i) / sides, b = 3.1415927f * static_cast<float>(i + 1) / sides;
      const glm::vec3 p(-0.16f, radius * std::cos(a), z + radius * std::sin(a)),
          q(-0.16f, radius * std::cos(b), z + radius * std::sin(b)), out(-0.14f, 0.0f, 0.0f);
      builder.patch(p, p + out, q + out, q);
      builder.patch(q, q + out, p + out, p);
    }
  }

  void add_post(const StandingSignal& standing) {
    const double top = standing.bottom_m + standing.height_m;
    if (const gltf::Model* own = world_.own.find("sign-post")) {
      Placement placement;
      placement.parent_from_object = standing.world_from_signal;
      placement.scale.z = static_cast<float>(top) / std::max(own->most_m.z, 0.1f);
      placement.visible_to_m = 500.0f;
      world_.own.place("sign-post", placement);
      return;
    }
    auto [found, fresh] = posts_.try_emplace(standing.road);
    Posts& posts = found->second;
    if (fresh) posts.world_from_posts.position_m = standing.world_from_signal.position_m;
    const glm::vec3 foot(standing.world_from_signal.position_m - posts.world_from_posts.position_m);
    posts.mesh.material = index_of(Ground::metal);
    glm::mat4 to(1.0f);
    to[3] = glm::vec4(foot, 1.0f);
    posts.mesh.append(
        geometry::cylinder(static_cast<float>(roadside::signal_post_radius_m), -0.4f, static_cast<float>(top), 8), to,
        true);
  }

  const WorldContext& world_;
  std::map<std::string, Shape> faces_;
  std::map<bool, Shape> lights_;
  std::array<bool, 2> has_lenses_{};  ///< For vehicles, for pedestrians.
  std::map<road::RoadIndex, Posts> posts_;
};

}  // namespace

void build_signals(const WorldContext& world) {
  SignalWorks works(world);
  for (const StandingSignal& standing : roadside::standing_signals(world.roads)) works.add(standing);
  works.finish();
}

}  // namespace septet::scenery
