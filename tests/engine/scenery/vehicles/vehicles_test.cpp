#include "engine/scenery/vehicles/vehicles.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>

#include <doctest/doctest.h>

#include "engine/geometry/mesh_measures.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/vehicles/cage.hpp"
#include "engine/scenery/vehicles/car_body.hpp"
#include "engine/scenery/vehicles/car_lines.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/limb.hpp"
#include "engine/scenery/vehicles/surface_patch.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/world/vehicle_body.hpp"
#include "tests/engine/geometry/solid_measures.hpp"
#include "tests/relative.hpp"

namespace septet::scenery {
namespace {

bool has_role(const VehicleParts& parts, scene::PartRole role, float distance_m) {
  return std::any_of(parts.begin(), parts.end(), [&](const VehiclePart& part) {
    return std::any_of(part.places.begin(), part.places.end(), [&](const Placement& place) {
      return place.role == role && distance_m >= place.visible_from_m && distance_m < place.visible_to_m;
    });
  });
}

/// Opaque polygons of the part.
geometry::PolygonMesh opaque_part(const VehicleParts& parts, std::string_view name) {
  const auto part = std::ranges::find(parts, name, &VehiclePart::name);
  REQUIRE(part != parts.end());
  geometry::PolygonMesh opaque;
  opaque.vertices_m = part->mesh.vertices_m;
  for (std::size_t i = 0; i < part->mesh.polygons.size(); ++i)
    if (part->mesh.polygon_materials[i] != index_of(Finish::clear_glass))
      opaque.polygons.push_back(part->mesh.polygons[i]);
  return opaque;
}

/// Triangles of all parts that are drawn at a distance.
std::size_t triangles_at(const VehicleParts& parts, float distance_m) {
  std::size_t count = 0;
  for (const VehiclePart& part : parts)
    for (const Placement& place : part.places)
      if (distance_m >= place.visible_from_m && distance_m < place.visible_to_m)
        count += geometry::triangle_count(part.mesh, part.subdivision_level);
  return count;
}

}  // namespace

TEST_CASE("the body of a car is closed and faces outwards and fills its bounding box") {
  for (const VehicleModel& model : vehicle_models()) {
    if (!has_car_lines(model)) continue;
    CAPTURE(model.name);
    for (const std::uint32_t level : {0u, 1u}) {
      const auto body = shown_surface(car_body_cage(model, car_shape(model), level), level);
      CHECK(geometry::is_finite(body));
      CHECK(geometry::is_closed(body));
      const double box = model.length_m * model.width_m * model.height_m;
      const bool has_bed = model.name == "pick-up" || model.name == "dropside-van" || model.name == "box-van";
      CHECK(geometry::signed_volume_m3(body) > (has_bed ? 0.3 : 0.45) * box);
      CHECK(geometry::signed_volume_m3(body) < 0.90 * box);
      const geometry::Bounds bounds = geometry::bounds(body);
      CHECK(bounds.max_m.x == relative(model.front_m(), 0.001));
      CHECK(bounds.min_m.x == relative(-model.rear_overhang_m, 0.001));
      CHECK(bounds.max_m.y == relative(model.width_m / 2, 0.001));
      CHECK(bounds.max_m.z == relative(model.height_m - car_shape(model).roof_below_m, 0.001));
    }
  }
}

TEST_CASE("the slope that debris meets at a vehicle's front lies close around what is drawn of it") {
  for (const VehicleModel& model : vehicle_models()) {
    const auto slope = front_slope(model.kind);
    if (!slope || !has_car_lines(model)) continue;
    CAPTURE(model.name);
    // Side view: z over x, from the bonnet's edge at the front to the beginning of the roof.
    const double rise = (1.0 - slope->edge_height) * model.height_m, run = slope->roof_begins * model.length_m;
    double furthest_out_m = -1e9;
    for (const auto& vertex : shown_surface(car_body_cage(model, car_shape(model), 1), 1).vertices_m) {
      const double behind_m = model.front_m() - vertex.x, above_edge_m = vertex.z - slope->edge_height * model.height_m;
      if (behind_m > run) continue;
      furthest_out_m = std::max(furthest_out_m, (above_edge_m * run - behind_m * rise) / std::hypot(rise, run));
    }
    CHECK(furthest_out_m < 0.02);
    CHECK(furthest_out_m > -0.14);
  }
}

TEST_CASE("every vehicle keeps within its triangle budgets and gets simpler with distance") {
  for (const VehicleModel& model : vehicle_models()) {
    CAPTURE(model.name);
    const VehicleParts parts = vehicle_parts(model);
    const std::size_t near = triangles_at(parts, 5.0f), middle = triangles_at(parts, 80.0f),
                      far = triangles_at(parts, 400.0f);
    CHECK(near <= 6900);
    CHECK(middle <= 920);
    CHECK(far <= 170);
    CHECK(near > middle);
    CHECK(middle > far);
    CHECK(far > 0);
    CHECK(triangles_at(parts, vehicles_until_m) == 0);
  }
}

TEST_CASE("at each distance a vehicle is drawn in one level of detail, and its levels meet") {
  for (const VehicleModel& model : vehicle_models()) {
    CAPTURE(model.name);
    // Distance ranges in which parts are drawn, each once.
    std::set<std::pair<float, float>> ranges;
    for (const VehiclePart& part : vehicle_parts(model))
      for (const Placement& place : part.places) ranges.insert({place.visible_from_m, place.visible_to_m});
    float reached_m = 0.0f;
    for (const auto& [from_m, to_m] : ranges) {
      CHECK(from_m == reached_m);
      CHECK(to_m > from_m);
      reached_m = to_m;
    }
    CHECK(ranges.size() == 3);
    CHECK(reached_m == vehicles_until_m);
  }
}

TEST_CASE("every part of every vehicle is finite and lies within reach of its body") {
  for (const VehicleModel& model : vehicle_models()) {
    CAPTURE(model.name);
    for (const VehiclePart& part : vehicle_parts(model)) {
      CAPTURE(part.name);
      CHECK(geometry::is_finite(part.mesh));
      CHECK_FALSE(part.mesh.polygons.empty());
      const geometry::Bounds bounds = geometry::bounds(part.mesh);
      for (const Placement& place : part.places) {
        const glm::vec3 at(place.parent_from_object.position_m);
        const glm::vec3 high = at + place.scale * bounds.max_m, low = at + place.scale * bounds.min_m;
        CHECK(high.x < model.front_m() + 0.15);
        CHECK(low.x > -model.rear_overhang_m - 0.15);
        CHECK(high.z < model.height_m + 0.2);
        CHECK(low.z > -0.06);
      }
    }
  }
}

TEST_CASE("cars have the lamps and wheels that move and light") {
  using enum scene::PartRole;
  for (const VehicleModel& model : vehicle_models()) {
    if (model.kind == ParticipantKind::pedestrian || model.kind == ParticipantKind::bicycle ||
        model.kind == ParticipantKind::object)
      continue;
    if (model.name == "caravan" || model.name == "semitrailer") continue;  // Lamps ahead are on its tractor.
    CAPTURE(model.name);
    const VehicleParts parts = vehicle_parts(model);
    for (const auto role : {lamp_head, lamp_tail, lamp_brake, lamp_indicator_left, lamp_indicator_right,
                            wheel_front_left, wheel_rear_left})
      CHECK(has_role(parts, role, 10.0f));
    for (const auto role : {lamp_head, lamp_tail}) CHECK(has_role(parts, role, 500.0f));
    const bool hurries = model.kind == ParticipantKind::ambulance || model.name == "police-car" ||
                         model.name == "police-van" || model.name == "fire-engine";
    for (const float distance_m : {10.0f, 80.0f, 500.0f}) CHECK(has_role(parts, beacon, distance_m) == hurries);
  }
}

TEST_CASE("every vehicle is drawn as long and as wide as traffic and collisions take it for") {
  for (const VehicleModel& model : vehicle_models()) {
    if (model.track_m < 1.0) continue;
    CAPTURE(model.name);
    for (const float distance_m : {10.0f, 80.0f, 500.0f}) {
      CAPTURE(distance_m);
      glm::vec3 low(1e9f), high(-1e9f);
      for (const VehiclePart& part : vehicle_parts(model))
        for (const Placement& place : part.places) {
          if (distance_m < place.visible_from_m || distance_m >= place.visible_to_m) continue;
          const auto shown = geometry::bounds(shown_surface(part.mesh, part.subdivision_level));
          const glm::vec3 at(place.parent_from_object.position_m);
          low = glm::min(low, at + place.scale * shown.min_m), high = glm::max(high, at + place.scale * shown.max_m);
        }
      CHECK(high.x == relative(model.front_m(), 0.012));
      CHECK(low.x == relative(-model.rear_overhang_m, 0.08));
      // Mirrors stand out, a rider's arms do not.
      CHECK(high.y > 0.45 * model.width_m);
      CHECK(high.y < 0.5 * model.width_m + 0.25);
    }
  }
}

TEST_CASE("a ray through a side window of a near car meets the driver's head before the far side's roof or door") {
  for (const char* name : {"volvo-s80", "hatchback", "saloon", "estate", "suv", "van", "minibus", "mpv", "taxi"}) {
    CAPTURE(name);
    const VehicleModel& model = vehicle_models()[*find_vehicle_model(name)];
    const VehicleParts parts = vehicle_parts(model);
    const auto driver =
        std::find_if(parts.begin(), parts.end(), [](const VehiclePart& part) { return part.name == "occupant near"; });
    REQUIRE(driver != parts.end());
    const glm::vec3 head(driver->places.front().parent_from_object.position_m);
    CHECK(head.y > 0.2f);
    CHECK(head.z + 0.12f < model.height_m);
    // Opaque parts of the body on the path in from the left, at the head's height and around it.
    const auto body =
        std::find_if(parts.begin(), parts.end(), [](const VehiclePart& part) { return part.name == "body near"; });
    REQUIRE(body != parts.end());
    int open = 0;
    for (const float dx : {-0.05f, 0.0f, 0.05f})
      for (const float dz : {-0.06f, 0.0f}) {
        const auto outermost = surface_point(body->mesh, Face::left, {head.x + dx, head.z + dz});
        open += !outermost || outermost->y < head.y;
      }
    CHECK(open >= 5);
  }
}

TEST_CASE("through the side windows of a near bus or coach one sees out on the other side, past the people between") {
  for (const char* name : {"coach", "city-bus"}) {
    CAPTURE(name);
    const VehicleModel& model = vehicle_models()[*find_vehicle_model(name)];
    const VehicleParts parts = vehicle_parts(model);
    const geometry::PolygonMesh opaque = opaque_part(parts, "body near");
    const geometry::Bounds people = geometry::bounds(opaque_part(parts, "people near"));
    // Path over the heads, along the middle of the windows.
    int open = 0, tried = 0;
    for (double x = -model.rear_overhang_m + 1.0; x < model.front_m() - 1.5; x += 0.03, ++tried)
      open += !surface_point(opaque, Face::left, {x, people.max_m.z + 0.15}).has_value();
    CHECK(open > 0.8 * tried);
    CHECK(open < tried);
    CHECK(people.max_m.z < model.height_m);
    CHECK(people.max_m.y < 0.5 * model.width_m);
  }
}

TEST_CASE("a lorry's driver sits behind glass that one sees through, and no wall hides him") {
  for (const char* name : {"lorry", "fire-engine", "tractor-unit"}) {
    CAPTURE(name);
    const VehicleParts parts = vehicle_parts(vehicle_models()[*find_vehicle_model(name)]);
    const geometry::PolygonMesh opaque = opaque_part(parts, "cab near");
    const geometry::Bounds people = geometry::bounds(opaque_part(parts, "people near"));
    const glm::vec2 head(people.max_m.x - 0.1f, people.max_m.z - 0.12f);
    const auto outermost = surface_point(opaque, Face::left, head);
    CHECK((!outermost || outermost->y < people.max_m.y));
    const auto foremost = surface_point(opaque, Face::front, {0.62f, people.max_m.z - 0.12f});
    CHECK((!foremost || foremost->x < people.max_m.x));
  }
}

TEST_CASE("vehicles of one outline share the parts that they have in common") {
  const VehicleParts saloon = vehicle_parts(vehicle_models()[*find_vehicle_model("saloon")]),
                     taxi = vehicle_parts(vehicle_models()[*find_vehicle_model("taxi")]);
  std::size_t shared = 0;
  for (const VehiclePart& part : taxi)
    for (const VehiclePart& other : saloon)
      if (other.name == part.name && other.mesh.vertices_m == part.mesh.vertices_m) {
        ++shared;
        break;
      }
  CHECK(shared + 2 == taxi.size());  // Differs by the sign, near and middle.
}

TEST_CASE("the scene holds a prototype for every model of the catalogue") {
  scene::Store store;
  scene::SceneBuilder builder(store);
  build_vehicles(builder);
  const scene::ResolvedScene scene = scene::resolve(store);
  CHECK(scene.instances.empty());
  // Each but a caravan, a trailer and a box has an inside, the driver's own model a shell, and two riders and the
  // walker have heads, too.
  constexpr std::ptrdiff_t without_inside = 3, shells = 1, heads = 3;
  CHECK(std::ranges::count_if(scene.prototypes, [](const auto& p) { return !p.name.starts_with("cockpit/"); }) ==
        2 * static_cast<std::ptrdiff_t>(vehicle_models().size()) - without_inside + shells + heads);
  for (const scene::Prototype& prototype : scene.prototypes) {
    CAPTURE(prototype.name);
    const bool small = prototype.name.starts_with("cockpit/") || prototype.name.starts_with("head/");
    CHECK(prototype.parts.size() >= (small ? 1 : 3));
  }
}

TEST_CASE("a limb goes from one thickness to the other over its length") {
  geometry::MeshBuilder builder;
  add_limb(builder, {0, 0, 1}, {0, 2, 1}, 0.1f, 0.04f, 24);
  const geometry::PolygonMesh limb = builder.take();
  CHECK(geometry::is_closed(limb));
  CHECK(geometry::signed_volume_m3(limb) > 0.0);
  const auto radius_near = [&](float y) {
    float radius = 0.0f;
    for (const glm::vec3& p : limb.vertices_m)
      if (std::abs(p.y - y) < 0.05f) radius = std::max(radius, std::hypot(p.x, p.z - 1.0f));
    return radius;
  };
  CHECK(radius_near(0.0f) == doctest::Approx(0.1));
  CHECK(radius_near(2.0f) == doctest::Approx(0.04));
}

}  // namespace septet::scenery
