// A vehicle that lost parts, and the pieces that show them: in numbers.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/debris/piece.hpp"
#include "engine/instant/participants.hpp"
#include "engine/instant/scene_summary.hpp"
#include "engine/physics/elastic/tetrahedral_mesh.hpp"
#include "sim-client/frame/clothing.hpp"
#include "sim-client/frame/prototype_of.hpp"
#include "sim-client/frame/torn_vehicle.hpp"
#include "tests/relative.hpp"
#include "tests/sim-client/frame/cockpit_view.hpp"

namespace septet::frame {
namespace {

using debris::Mount;

const VehicleModel& model_called(const std::string& name) { return vehicle_models()[*find_vehicle_model(name)]; }

const scene::Prototype& prototype_called(const std::string& name) {
  return vehicles_scene().prototypes[*prototype_of(vehicles_scene(), name)];
}

std::uint32_t dark_material() {
  const scene::Instance& sample = prototype_called("debris/bumper-plastic").parts.front();
  return vehicles_scene().meshes[sample.mesh].parts.front().material;
}

double area_m2(const SheetTriangle& t) {
  return 0.5 * glm::length(glm::cross(t.corners[1].position_m - t.corners[0].position_m,
                                      t.corners[2].position_m - t.corners[0].position_m));
}

/// Areas in a region that look outwards, of a vehicle as it is drawn close by: of its skin, and of what is dark.
struct SkinArea {
  double skin_m2 = 0.0, dark_m2 = 0.0;
};
SkinArea skin_area(const scene::Prototype& prototype, const instant::ReshapedParts& reshaped,
                   const scenery::MountRegion& region) {
  SkinArea area;
  for (std::size_t i = 0; i < prototype.parts.size(); ++i) {
    const scene::Instance& part = prototype.parts[i];
    if (part.visible_from_m > 0.0f || part.role != scene::PartRole::fixed) continue;
    const scene::SurfaceMesh& mesh = reshaped[i] ? *reshaped[i] : vehicles_scene().meshes[part.mesh];
    const auto cut = cut_mesh(mesh, part.world_from_object, part.scale, vehicles_scene().materials, region);
    if (!cut) continue;
    for (const SheetTriangle& t : cut->taken)
      if (t.is_skin) (t.material == dark_material() ? area.dark_m2 : area.skin_m2) += area_m2(t);
  }
  return area;
}

double area_m2(const Sheet& sheet) {
  double sum = 0.0;
  for (const SheetTriangle& t : sheet) sum += area_m2(t);
  return sum;
}

constexpr std::array with_skin{Mount::front_bumper,     Mount::rear_bumper,    Mount::front_left_door,
                               Mount::front_right_door, Mount::rear_left_door, Mount::rear_right_door};

/// What a screen is told of a part that was torn off, as it lies at a place.
debris::Keyframe told_of(debris::Part part, ModelIndex model, Mount mount, const RigidTransform& place) {
  Random random(2);
  debris::Piece piece = debris::make_part(part, place, Vec3(0), Vec3(0), random);
  piece.origin = debris::PieceOrigin{3, model, 5, mount};
  return debris::keyframe_of(piece);
}

}  // namespace

TEST_CASE("skin that was torn off is no longer on the vehicle, behind it is a dark recess, and all else is there") {
  for (const VehicleModel& model : vehicle_models()) {
    if (!scenery::mount_region(model, Mount::front_bumper)) continue;
    CAPTURE(model.name);
    const scene::Prototype& prototype = prototype_called(std::string(model.name));
    const instant::ReshapedParts whole(prototype.parts.size());
    for (const Mount mount : with_skin) {
      CAPTURE(static_cast<int>(mount));
      if (!scenery::mount_region(model, mount)) continue;  // Two doors.
      const auto torn = without_torn(vehicles_scene(), prototype, model, debris::bit_of(mount));
      for (const Mount other : with_skin) {
        const auto region = scenery::mount_region(model, other);
        if (!region) continue;
        const SkinArea before = skin_area(prototype, whole, *region), after = skin_area(prototype, torn, *region);
        REQUIRE(before.skin_m2 > 0.05);
        if (other == mount) {
          CHECK(after.skin_m2 < 1e-3 * before.skin_m2);
          CHECK(after.dark_m2 > 0.5 * before.skin_m2);
        } else {
          CHECK(after.skin_m2 == relative(before.skin_m2, 1e-3));
        }
      }
    }
  }
}

TEST_CASE("a lamp that was torn off is gone with its lens, which does not shine any more, and the other one is there") {
  const VehicleModel& model = model_called("saloon");
  const scene::Prototype& prototype = prototype_called("saloon");
  const auto torn = without_torn(vehicles_scene(), prototype, model, debris::bit_of(Mount::front_left_lamp));
  int gone = 0, there = 0;
  for (std::size_t i = 0; i < prototype.parts.size(); ++i) {
    if (prototype.parts[i].role != scene::PartRole::lamp_head) continue;
    const bool is_gone = torn[i] && torn[i]->indices.empty();
    const scene::SurfaceMesh& mesh = vehicles_scene().meshes[prototype.parts[i].mesh];
    const Vec3 middle = prototype.parts[i].world_from_object * Vec3(0.5f * (mesh.bounds_min_m + mesh.bounds_max_m));
    CHECK(is_gone == (middle.y > 0.0));
    ++(is_gone ? gone : there);
  }
  CHECK(gone == 3);  // At each level of detail.
  CHECK(there == 3);
  instant::DrawnParticipant drawn;
  drawn.prototype = *prototype_of(vehicles_scene(), "saloon");
  drawn.lamps.set(Lamp::low_beam, true);
  const auto glows = [&] {
    const auto scene = instant::summarise(vehicles_scene());
    return instant::place_participants(std::span(&drawn, 1), scene.prototypes, scene.meshes, 0.0, Vec3(20.0, 0.0, 1.0),
                                       [](const RigidTransform&) { return 1.0f; })
        .glows.size();
  };
  const std::size_t both = glows();
  drawn.reshaped = std::make_shared<const instant::ReshapedParts>(torn);
  CHECK(glows() == both - 1);
}

TEST_CASE("a whole door wears the door's skin in its own size, wherever it lies and however it is turned") {
  const ModelIndex model = *find_vehicle_model("saloon");
  const Sheet panel = panel_of(vehicles_scene(), vehicle_models()[model], Mount::front_left_door);
  REQUIRE_FALSE(panel.empty());
  const RigidTransform place{{2000.0, -700.0, 12.0}, orientation_from_angles(2.0, 0.7, -1.1)};
  const debris::Keyframe told = told_of(debris::Part::door, model, Mount::front_left_door, place);
  const Clothing clothing(panel, told);
  REQUIRE(clothing.is_worn());
  CHECK(clothing.fits(told));
  const debris::Keyframe worn = clothing.worn(told);
  double worn_m2 = 0.0;
  Vec3 low(1e9), high(-1e9);
  const RigidTransform part_from_world = inverse(place);
  for (const auto& t : worn.triangles) {
    const Vec3 a = worn.vertices_m[t[0]], b = worn.vertices_m[t[1]], c = worn.vertices_m[t[2]];
    worn_m2 += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  CHECK(worn_m2 == relative(area_m2(panel), 0.01));
  for (const Vec3& vertex : worn.vertices_m) {
    low = glm::min(low, part_from_world * vertex);
    high = glm::max(high, part_from_world * vertex);
  }
  const auto region = *scenery::mount_region(vehicle_models()[model], Mount::front_left_door);
  CHECK(high.x - low.x == relative(region.skin->high_m.x - region.skin->low_m.x, 0.02));
  CHECK(std::abs(high.x + low.x) < 0.02);
  // Its front looks as the door did, to the left.
  std::size_t outwards = 0;
  for (const auto& t : worn.triangles) {
    const Vec3 a = worn.vertices_m[t[0]], b = worn.vertices_m[t[1]], c = worn.vertices_m[t[2]];
    outwards += (part_from_world.orientation * glm::cross(b - a, c - a)).y > 0.0;
  }
  CHECK(outwards > 20);
}

TEST_CASE("the pieces of a broken bumper wear each its own share of the skin, and all of them the whole") {
  const ModelIndex model = *find_vehicle_model("hatchback");
  const Sheet panel = panel_of(vehicles_scene(), vehicle_models()[model], Mount::front_bumper);
  const debris::Keyframe whole = told_of(debris::Part::bumper, model, Mount::front_bumper, {});
  const std::size_t all = Clothing(panel, whole).worn(whole).triangles.size();
  // Broken across at its middle: cubes to the left and to the right of it.
  std::size_t sum = 0;
  for (const double side : {1.0, -1.0}) {
    debris::Keyframe half;
    half.part = whole.part;
    half.origin = whole.origin;
    elastic::TetrahedralMesh lattice = elastic::lattice_mesh({1, 6, 2}, {0.08, 0.85, 0.3});
    for (auto& node : lattice.nodes_m) node -= Eigen::Vector3d(0.04, side > 0 ? 0.0 : 0.85, 0.15);
    for (const auto& node : lattice.nodes_m) {
      half.vertices_m.push_back(debris::from_eigen(node));
      for (int n = 0; n < debris::lattice_node_count(whole.part); ++n)
        if (glm::length(debris::lattice_place_m(whole.part, n) - half.vertices_m.back()) < 1e-6)
          half.lattice_nodes.push_back(static_cast<std::uint8_t>(n));
    }
    for (const auto& triangle : elastic::surface_triangles(lattice.nodes_m, lattice.tetrahedra))
      half.triangles.push_back({static_cast<std::uint16_t>(triangle.nodes[0]),
                                static_cast<std::uint16_t>(triangle.nodes[1]),
                                static_cast<std::uint16_t>(triangle.nodes[2])});
    REQUIRE(half.lattice_nodes.size() == half.vertices_m.size());
    const Clothing clothing(panel, half);
    CHECK_FALSE(clothing.fits(whole));
    const debris::Keyframe worn = clothing.worn(half);
    sum += worn.triangles.size();
    for (const Vec3& vertex : worn.vertices_m) CHECK(side * vertex.y > -0.13);
  }
  CHECK(sum == all);
}

TEST_CASE("what no panel is known of wears nothing") {
  const ModelIndex caravan = *find_vehicle_model("caravan");
  CHECK(panel_of(vehicles_scene(), vehicle_models()[caravan], Mount::front_bumper).empty());
  CHECK(panel_of(scene::ResolvedScene(), model_called("saloon"), Mount::front_bumper).empty());
  const debris::Keyframe told = told_of(debris::Part::bumper, caravan, Mount::front_bumper, {});
  CHECK_FALSE(Clothing({}, told).is_worn());
}

}  // namespace septet::frame
