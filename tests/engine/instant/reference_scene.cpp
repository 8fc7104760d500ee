#include "tests/engine/instant/reference_scene.hpp"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/core/random.hpp"

namespace septet::instant {
namespace {

using scene::PartRole;
using scene::ResolvedScene;
using scene::SurfaceMaterial;
using scene::SurfaceMesh;
using scene::SurfaceVertex;

void add_quad(SurfaceMesh& mesh, const std::array<glm::vec3, 4>& corners, const glm::vec2& uv0, const glm::vec2& uv1) {
  const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[3] - corners[0]));
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::array<glm::vec2, 4> uv{glm::vec2(uv0.x, uv1.y), uv1, glm::vec2(uv1.x, uv0.y), uv0};
  for (std::size_t i = 0; i < 4; ++i) mesh.vertices.push_back({corners[i], normal, uv[i]});
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
}

void add_box(SurfaceMesh& mesh, const glm::vec3& low, const glm::vec3& high) {
  const glm::vec3 a = low, b = high;
  const glm::vec2 o(0), i(1);
  add_quad(mesh, {{{b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z}}}, o, i);
  add_quad(mesh, {{{a.x, b.y, a.z}, {a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}}}, o, i);
  add_quad(mesh, {{{b.x, b.y, a.z}, {a.x, b.y, a.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}}}, o, i);
  add_quad(mesh, {{{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}}}, o, i);
  add_quad(mesh, {{{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}}}, o, i);
  add_quad(mesh, {{{a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, a.y, a.z}, {a.x, a.y, a.z}}}, o, i);
}

/// A cylinder along y.
void add_wheel(SurfaceMesh& mesh, float radius, float half_width) {
  constexpr int sides = 20;
  for (int i = 0; i < sides; ++i) {
    const float a = 6.2831853f * i / sides, b = 6.2831853f * (i + 1) / sides;
    const glm::vec3 p(radius * std::cos(a), 0, radius * std::sin(a)), q(radius * std::cos(b), 0, radius * std::sin(b));
    const glm::vec3 w(0, half_width, 0);
    add_quad(mesh, {p - w, p + w, q + w, q - w}, glm::vec2(0), glm::vec2(1));
    for (const float side : {1.0f, -1.0f}) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const glm::vec3& corner : {glm::vec3(0), p, q})
        mesh.vertices.push_back({corner + side * w, {0, side, 0}, {}});
      for (const std::uint32_t k : {0u, side > 0 ? 2u : 1u, side > 0 ? 1u : 2u}) mesh.indices.push_back(first + k);
    }
  }
}

/// Finishes the mesh: one part more, from where the last one ended.
void end_part(SurfaceMesh& mesh, std::uint32_t material) {
  std::uint32_t first = 0;
  for (const scene::MeshPart& part : mesh.parts) first = part.first_index + part.index_count;
  mesh.parts.push_back({first, static_cast<std::uint32_t>(mesh.indices.size()) - first, material});
}

std::uint32_t add_mesh(ResolvedScene& scene, SurfaceMesh mesh) {
  mesh.revision = 1;
  mesh.bounds_min_m = glm::vec3(1e9f);
  mesh.bounds_max_m = glm::vec3(-1e9f);
  for (const SurfaceVertex& vertex : mesh.vertices) {
    mesh.bounds_min_m = glm::min(mesh.bounds_min_m, vertex.position_m);
    mesh.bounds_max_m = glm::max(mesh.bounds_max_m, vertex.position_m);
  }
  scene.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

std::uint32_t add_material(ResolvedScene& scene, const SurfaceMaterial& material) {
  scene.materials.push_back(material);
  scene.materials.back().revision = 1;
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

scene::TextureImage asphalt(Random& random) {
  // 18.75 m across (five lanes of 3.75 m), 12 m along: markings between lanes, dashes of 4 m.
  scene::TextureImage image{1, 512, 512, true, {}};
  for (std::uint32_t y = 0; y < 512; ++y)
    for (std::uint32_t x = 0; x < 512; ++x) {
      const float across = 18.75f * (x + 0.5f) / 512.0f, along = 12.0f * y / 512.0f;
      float level = 70.0f + 26.0f * static_cast<float>(random.uniform(0.0, 1.0));
      for (int lane = 0; lane <= 5; ++lane) {
        const float centre = lane == 0 ? 0.15f : lane == 5 ? 18.6f : 3.75f * lane;
        const bool painted = lane == 0 || lane == 5 || along < 4.0f;
        if (painted && std::abs(across - centre) < 0.09f) level = 225.0f;
      }
      const auto byte = static_cast<std::uint8_t>(level);
      image.rgba.insert(image.rgba.end(), {byte, byte, static_cast<std::uint8_t>(level * 1.01f), 255});
    }
  return image;
}

scene::TextureImage grass(Random& random) {
  scene::TextureImage image{1, 128, 128, true, {}};
  for (int i = 0; i < 128 * 128; ++i) {
    const float level = static_cast<float>(random.uniform(0.7, 1.1));
    image.rgba.insert(image.rgba.end(), {static_cast<std::uint8_t>(92 * level), static_cast<std::uint8_t>(112 * level),
                                         static_cast<std::uint8_t>(52 * level), 255});
  }
  return image;
}

scene::TextureImage leaves(Random& random) {
  constexpr int side = 128;
  scene::TextureImage image{1, side, side, true, std::vector<std::uint8_t>(side * side * 4, 0)};
  for (int leaf = 0; leaf < 900; ++leaf) {
    const double angle = random.uniform(0.0, 6.283), radius = 0.47 * std::sqrt(random.uniform(0.0, 1.0));
    const double cx = side * (0.5 + radius * std::cos(angle)), cy = side * (0.5 + radius * std::sin(angle));
    const double level = random.uniform(0.55, 1.05);
    for (int y = -3; y <= 3; ++y)
      for (int x = -3; x <= 3; ++x) {
        const int px = static_cast<int>(cx) + x, py = static_cast<int>(cy) + y;
        if (x * x + y * y > 9 || px < 0 || py < 0 || px >= side || py >= side) continue;
        std::uint8_t* pixel = &image.rgba[static_cast<std::size_t>(py * side + px) * 4];
        pixel[0] = static_cast<std::uint8_t>(70 * level);
        pixel[1] = static_cast<std::uint8_t>(98 * level);
        pixel[2] = static_cast<std::uint8_t>(38 * level);
        pixel[3] = 255;
      }
  }
  return image;
}

void add_instance(ResolvedScene& scene, std::uint32_t mesh, const Vec3& at_m, double heading = 0.0, float scale = 1.0f,
                  float to_m = 1e9f, bool casts_shadow = true) {
  scene::Instance instance;
  instance.mesh = mesh;
  instance.world_from_object = {at_m, orientation_from_angles(heading, 0.0, 0.0)};
  instance.scale = glm::vec3(scale);
  instance.visible_to_m = to_m;
  instance.casts_shadow = casts_shadow;
  scene.instances.push_back(instance);
}

SurfaceMesh hills(std::uint32_t material) {
  SurfaceMesh mesh;
  const auto height = [](float x, float y) {
    const float away = std::max(0.0f, std::abs(y) - 60.0f) / 600.0f;
    return away * (60.0f + 45.0f * std::sin(x / 310.0f + y / 470.0f) + 30.0f * std::sin(x / 140.0f - y / 230.0f)) -
           0.05f;
  };
  constexpr float cell = 50.0f;
  for (int iy = -16; iy < 16; ++iy)
    for (int ix = -8; ix < 40; ++ix) {
      const float x0 = ix * cell, y0 = iy * cell, x1 = x0 + cell, y1 = y0 + cell;
      add_quad(
          mesh,
          {{{x0, y0, height(x0, y0)}, {x1, y0, height(x1, y0)}, {x1, y1, height(x1, y1)}, {x0, y1, height(x0, y1)}}},
          {0, 0}, {12, 12});
    }
  for (SurfaceVertex& v : mesh.vertices) {
    const float x = v.position_m.x, y = v.position_m.y;
    v.normal =
        glm::normalize(glm::vec3(height(x - 5, y) - height(x + 5, y), height(x, y - 5) - height(x, y + 5), 10.0f));
  }
  end_part(mesh, material);
  return mesh;
}

void add_car(ReferenceScene& reference) {
  ResolvedScene& scene = reference.scene;
  SurfaceMaterial paint, glass, rubber, lamp;
  paint.takes_paint = true;
  paint.base_color = glm::vec3(1.0f);
  paint.roughness = 0.28f;
  glass.base_color = glm::vec3(0.02f);
  glass.roughness = 0.05f;
  glass.opacity = 0.75f;
  rubber.base_color = glm::vec3(0.03f);
  rubber.roughness = 0.9f;
  const std::uint32_t painted = add_material(scene, paint), see_through = add_material(scene, glass),
                      black = add_material(scene, rubber);
  const auto lamp_material = [&](const glm::vec3& color) {
    lamp.base_color = glm::mix(color, glm::vec3(0.4f), 0.3f);
    lamp.emission = color * 6.0f;
    return add_material(scene, lamp);
  };
  SurfaceMesh body;
  add_box(body, {-1.0f, -0.88f, 0.25f}, {3.7f, 0.88f, 0.85f});
  add_box(body, {-0.6f, -0.75f, 1.36f}, {1.7f, 0.75f, 1.42f});
  end_part(body, painted);
  add_box(body, {-0.8f, -0.78f, 0.85f}, {2.1f, 0.78f, 1.36f});
  end_part(body, see_through);
  scene::Prototype prototype;
  prototype.name = "model/saloon";
  const auto add_part = [&](std::uint32_t mesh, const Vec3& at_m, PartRole role) {
    scene::Instance part;
    part.mesh = mesh;
    part.world_from_object.position_m = at_m;
    part.role = role;
    prototype.parts.push_back(part);
  };
  add_part(add_mesh(scene, body), {0, 0, 0}, PartRole::fixed);
  SurfaceMesh wheel;
  add_wheel(wheel, 0.32f, 0.11f);
  end_part(wheel, black);
  const std::uint32_t wheel_mesh = add_mesh(scene, wheel);
  add_part(wheel_mesh, {2.77, 0.81, 0.32}, PartRole::wheel_front_left);
  add_part(wheel_mesh, {2.77, -0.81, 0.32}, PartRole::wheel_front_right);
  add_part(wheel_mesh, {0, 0.81, 0.32}, PartRole::wheel_rear_left);
  add_part(wheel_mesh, {0, -0.81, 0.32}, PartRole::wheel_rear_right);
  const auto lamp_mesh = [&](const glm::vec3& color) {
    SurfaceMesh mesh;
    add_box(mesh, {-0.03f, -0.14f, -0.07f}, {0.03f, 0.14f, 0.07f});
    end_part(mesh, lamp_material(color));
    return add_mesh(scene, mesh);
  };
  const std::uint32_t red = lamp_mesh({1.0f, 0.03f, 0.01f}), white = lamp_mesh({1.0f, 0.95f, 0.8f}),
                      amber = lamp_mesh({1.0f, 0.35f, 0.0f}), blue = lamp_mesh({0.02f, 0.1f, 1.0f});
  for (const double y : {0.65, -0.65}) {
    add_part(red, {-1.01, y, 0.68}, PartRole::lamp_brake);
    add_part(white, {3.71, y, 0.62}, PartRole::lamp_head);
    add_part(blue, {0.5, y * 0.6, 1.48}, PartRole::beacon);
    add_part(amber, {-1.01, y, 0.5}, y > 0 ? PartRole::lamp_indicator_left : PartRole::lamp_indicator_right);
  }
  scene.prototypes.push_back(prototype);
}

}  // namespace

ReferenceScene reference_scene(const ReferenceOptions& options) {
  ReferenceScene reference;
  ResolvedScene& scene = reference.scene;
  scene.revision = 1;
  Random random(7);
  scene.images = {asphalt(random), grass(random), leaves(random)};
  SurfaceMaterial road, meadow, steel, concrete, bark, crown, sign;
  road.base_color = glm::vec3(1.0f);
  road.base_color_image = 0;
  road.roughness = 0.85f;
  road.wettable = true;
  meadow.base_color = glm::vec3(1.0f);
  meadow.base_color_image = 1;
  meadow.roughness = 1.0f;
  steel.base_color = glm::vec3(0.55f);
  steel.metallic = 0.8f;
  steel.roughness = 0.45f;
  concrete.base_color = glm::vec3(0.35f, 0.34f, 0.32f);
  concrete.roughness = 0.9f;
  concrete.share_of_sky = 0.0f;
  bark.base_color = glm::vec3(0.08f, 0.06f, 0.04f);
  bark.roughness = 1.0f;
  crown.base_color = glm::vec3(1.0f);
  crown.base_color_image = 2;
  crown.roughness = 1.0f;
  sign.base_color = glm::vec3(0.02f, 0.08f, 0.35f);
  sign.roughness = 0.6f;
  const std::uint32_t road_id = add_material(scene, road), meadow_id = add_material(scene, meadow),
                      steel_id = add_material(scene, steel), concrete_id = add_material(scene, concrete),
                      bark_id = add_material(scene, bark), crown_id = add_material(scene, crown),
                      sign_id = add_material(scene, sign);
  SurfaceMaterial lamp;
  lamp.base_color = glm::vec3(0.5f);
  lamp.emission = glm::vec3(2.2f, 1.9f, 1.3f);
  lamp.share_of_sky = 0.0f;
  const std::uint32_t lamp_id = add_material(scene, lamp);
  SurfaceMaterial road_inside = road;
  road_inside.share_of_sky = 0.0f;
  const std::uint32_t road_inside_id = add_material(scene, road_inside);

  const Vec3& o = options.origin_m;
  for (const bool inside : {false, true}) {
    SurfaceMesh strip;
    for (int i = 0; i < 10; ++i)
      add_quad(strip,
               {{{i * 12.0f, -9.375f, 0},
                 {i * 12.0f + 12.0f, -9.375f, 0},
                 {i * 12.0f + 12.0f, 9.375f, 0},
                 {i * 12.0f, 9.375f, 0}}},
               {0, 0}, {1, 1});
    // The image's rows run along the road, its columns across.
    for (SurfaceVertex& v : strip.vertices) v.uv = {(v.position_m.y + 9.375f) / 18.75f, v.position_m.x / 12.0f};
    end_part(strip, inside ? road_inside_id : road_id);
    const std::uint32_t mesh = add_mesh(scene, strip);
    for (int i = -1; i < 12; ++i)
      if (inside == (options.tunnel && i >= 1 && i < 3))
        add_instance(scene, mesh, o + Vec3(i * 120.0, 0, 0.02), 0.0, 1.0f, 1e9f, false);
  }
  add_instance(scene, add_mesh(scene, hills(meadow_id)), o, 0.0, 1.0f, 1e9f, false);

  SurfaceMesh rail;
  add_box(rail, {0, -0.05f, 0.45f}, {4.0f, 0.05f, 0.75f});
  add_box(rail, {0, -0.06f, 0}, {0.1f, 0.06f, 0.7f});
  end_part(rail, steel_id);
  const std::uint32_t rail_mesh = add_mesh(scene, rail);
  for (int i = -10; i < 100; ++i)
    for (const double y : {10.2, -10.2}) add_instance(scene, rail_mesh, o + Vec3(i * 4.0, y, 0), 0.0, 1.0f, 220.0f);

  SurfaceMesh gantry;
  add_box(gantry, {-0.2f, -11.2f, 0}, {0.2f, -10.8f, 7.0f});
  add_box(gantry, {-0.2f, 10.8f, 0}, {0.2f, 11.2f, 7.0f});
  add_box(gantry, {-0.2f, -11.2f, 6.6f}, {0.2f, 11.2f, 7.2f});
  end_part(gantry, steel_id);
  add_box(gantry, {-0.35f, -6.0f, 5.2f}, {-0.25f, 2.0f, 7.6f});
  end_part(gantry, sign_id);
  add_instance(scene, add_mesh(scene, gantry), o + Vec3(45, 0, 0));

  if (options.tunnel) {
    SurfaceMesh tube;
    add_box(tube, {0, 11.0f, 0}, {20.0f, 12.5f, 7.0f});
    add_box(tube, {0, -12.5f, 0}, {20.0f, -11.0f, 7.0f});
    add_box(tube, {0, -12.5f, 6.5f}, {20.0f, 12.5f, 8.0f});
    end_part(tube, concrete_id);
    for (const float y : {-5.0f, 5.0f}) add_box(tube, {8.0f, y - 0.3f, 6.3f}, {11.0f, y + 0.3f, 6.48f});
    end_part(tube, lamp_id);
    const std::uint32_t mesh = add_mesh(scene, tube);
    for (int i = 0; i < 12; ++i) add_instance(scene, mesh, o + Vec3(120.0 + 20.0 * i, 0, 0));
  }

  SurfaceMesh tree;
  for (int i = 0; i < 3; ++i) {
    const float a = 3.14159265f * i / 3.0f;
    const glm::vec3 side(2.6f * std::cos(a), 2.6f * std::sin(a), 0);
    add_quad(tree,
             {-side + glm::vec3(0, 0, 1.5f), side + glm::vec3(0, 0, 1.5f), side + glm::vec3(0, 0, 8.0f),
              -side + glm::vec3(0, 0, 8.0f)},
             {0, 0}, {1, 1});
  }
  for (SurfaceVertex& v : tree.vertices) v.normal = glm::normalize(v.position_m - glm::vec3(0, 0, 3.5f));
  end_part(tree, crown_id);
  add_box(tree, {-0.15f, -0.15f, 0}, {0.15f, 0.15f, 3.5f});
  end_part(tree, bark_id);
  const std::uint32_t tree_mesh = add_mesh(scene, tree);
  for (std::uint32_t i = 0; i < options.trees; ++i) {
    const double x = random.uniform(-60.0, 900.0), y = random.uniform(14.0, 58.0) * (i % 2 ? 1.0 : -1.0);
    add_instance(scene, tree_mesh, o + Vec3(x, y, 0), random.uniform(0.0, 6.28),
                 static_cast<float>(random.uniform(0.7, 1.3)));
  }
  reference.car_prototype = static_cast<std::uint32_t>(scene.prototypes.size());
  add_car(reference);
  return reference;
}

DrawnParticipant reference_car(const ReferenceScene& reference, const Vec3& world_m) {
  DrawnParticipant car;
  car.prototype = reference.car_prototype;
  car.world_from_vehicle.position_m = world_m;
  car.paint = glm::vec3(0.34f, 0.022f, 0.026f);
  return car;
}

Environment reference_day() {
  Environment environment;
  environment.sun_azimuth_rad = 3.9;
  environment.sun_elevation_rad = 0.62;
  environment.cloud_cover = 0.35;
  return environment;
}

FrameView forward_view(const Vec3& car_m, std::uint32_t width, std::uint32_t height) {
  FrameView view;
  const double across = 1.05;
  view.projection =
      symmetric_view({1.2, 0.35, 1.2}, 0.0, 0.0, across, 2.0 * std::atan(std::tan(across / 2.0) * height / width));
  view.world_from_car.position_m = car_m;
  view.viewport = {0, 0, width, height};
  return view;
}

}  // namespace septet::instant
