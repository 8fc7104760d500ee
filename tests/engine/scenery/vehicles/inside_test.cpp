// What is seen from the eye points of all kinds of vehicles, by rays against the meshes that are drawn around them.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/scenery/vehicles/cockpit.hpp"
#include "engine/scenery/vehicles/cockpit_finish.hpp"
#include "engine/scenery/vehicles/eye_point.hpp"
#include "engine/scenery/vehicles/finish.hpp"
#include "engine/scenery/vehicles/fittings.hpp"
#include "engine/scenery/vehicles/vehicle_mirrors.hpp"
#include "engine/scenery/vehicles/vehicle_parts.hpp"
#include "engine/world/instrument_panel.hpp"

namespace septet::scenery {
namespace {

struct InsideTriangle {
  Vec3 a, b, c;
  std::uint32_t finish;
};

std::vector<InsideTriangle> triangles_of(const VehicleParts& parts) {
  std::vector<InsideTriangle> triangles;
  for (const VehiclePart& part : parts)
    for (const Placement& place : part.places) {
      const auto at = [&](std::uint32_t vertex) {
        return place.parent_from_object * (Vec3(part.mesh.vertices_m[vertex]) * Vec3(place.scale));
      };
      for (std::size_t i = 0; i < part.mesh.polygons.size(); ++i) {
        const auto& corners = part.mesh.polygons[i];
        for (std::uint32_t k = 2; k < geometry::corner_count(corners); ++k)
          triangles.push_back({at(corners[0]), at(corners[k - 1]), at(corners[k]), part.mesh.polygon_materials.at(i)});
      }
    }
  return triangles;
}

struct Met {
  double distance_m;
  std::uint32_t finish;
  bool from_behind;  ///< True where only the triangle's back is met, which is not drawn.
};

/// Nearest triangle on a ray, from either side (Möller and Trumbore).
std::optional<Met> met_by(const std::vector<InsideTriangle>& triangles, const Vec3& from, const Vec3& along) {
  std::optional<Met> nearest;
  for (const InsideTriangle& t : triangles) {
    const Vec3 e1 = t.b - t.a, e2 = t.c - t.a, p = glm::cross(along, e2);
    const double determinant = glm::dot(e1, p);
    if (std::abs(determinant) < 1e-12) continue;
    const Vec3 s = from - t.a, q = glm::cross(s, e1);
    const double u = glm::dot(s, p) / determinant, v = glm::dot(along, q) / determinant,
                 distance_m = glm::dot(e2, q) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || distance_m < 1e-6) continue;
    if (!nearest || distance_m < nearest->distance_m) nearest = Met{distance_m, t.finish, determinant < 0.0};
  }
  return nearest;
}

/// Direction in the vehicle's frame: headings to the left, pitches upwards.
Vec3 towards(double heading_deg, double pitch_deg) {
  constexpr double radians = std::numbers::pi / 180.0;
  const double level = std::cos(pitch_deg * radians);
  return {level * std::cos(heading_deg * radians), level * std::sin(heading_deg * radians),
          std::sin(pitch_deg * radians)};
}

bool is_enclosed(const VehicleModel& model) {
  return model.kind == ParticipantKind::car || model.kind == ParticipantKind::van ||
         model.kind == ParticipantKind::ambulance || model.kind == ParticipantKind::lorry ||
         model.kind == ParticipantKind::bus;
}

/// Share of directions that may fall on the rims of panes, more of them where panes are small or near.
double rim_share(ParticipantKind kind) {
  switch (kind) {
    case ParticipantKind::bus:
      return 0.006;
    case ParticipantKind::van:
    case ParticipantKind::ambulance:
      return 0.012;
    default:
      return 0.018;
  }
}

}  // namespace

TEST_CASE("whoever drives, rides or walks sees the road: nothing of their own lies straight on or over the horizon") {
  for (const VehicleModel& model : vehicle_models()) {
    if (!is_driven(model) || has_cockpit(model)) continue;
    CAPTURE(model.name);
    const auto triangles = triangles_of(inside_parts(model));
    REQUIRE_FALSE(triangles.empty());
    const Vec3 eye_m = eye_in(model);
    for (const double heading_deg : {-8.0, 0.0, 8.0})
      for (const double pitch_deg : {-4.0, 0.0, 3.0}) {
        CAPTURE(heading_deg);
        CAPTURE(pitch_deg);
        CHECK_FALSE(met_by(triangles, eye_m, towards(heading_deg, pitch_deg)).has_value());
      }
    // Nothing is so near that the picture's first 10 cm would cut it.
    for (const InsideTriangle& t : triangles) REQUIRE(glm::distance((t.a + t.b + t.c) / 3.0, eye_m) > 0.10);
  }
}

TEST_CASE(
    "cars, vans, lorries and buses have a roof above the eyes, a dashboard below, pillars and panes beside them") {
  for (const VehicleModel& model : vehicle_models()) {
    if (!is_driven(model) || has_cockpit(model) || !is_enclosed(model)) continue;
    CAPTURE(model.name);
    const auto triangles = triangles_of(inside_parts(model));
    const Vec3 eye_m = eye_in(model);
    const auto above = met_by(triangles, eye_m, Vec3(0, 0, 1));
    REQUIRE(above.has_value());
    CHECK(above->distance_m < 1.4);
    const auto below = met_by(triangles, eye_m, towards(0.0, -50.0));
    REQUIRE(below.has_value());
    CHECK(below->distance_m < 2.0);
    int pillars = 0, panes = 0;
    for (double heading_deg = 15.0; heading_deg < 100.0; heading_deg += 0.5) {
      const auto met = met_by(triangles, eye_m, towards(heading_deg, 4.0));
      ++(met && met->distance_m < 3.0 ? pillars : panes);
    }
    CHECK(pillars >= 2);  // At least one degree.
    CHECK(panes >= 60);   // At least 30 degrees free.
    for (const InsideTriangle& t : triangles) REQUIRE(t.finish != index_of(Finish::clear_glass));
  }
}

TEST_CASE("no daylight comes through a body: from the eyes of those who sit in it every wall is met from within") {
  for (const VehicleModel& model : vehicle_models()) {
    if (!is_driven(model) || has_cockpit(model) || !is_enclosed(model) || model.name == "farm-tractor") continue;
    CAPTURE(model.name);
    const auto triangles = triangles_of(inside_parts(model));
    const Vec3 eye_m = eye_in(model);
    // The highest hole, and all; beside a pane the rim between lining and body counts, of 2 cm.
    constexpr double step_deg = 0.5, most_deg = 4.5;
    double highest_deg = 0.0;
    int rays = 0, holes = 0;
    for (double heading_deg = -105.0; heading_deg < 110.0; heading_deg += 15.0) {
      double hole_deg = 0.0;
      for (double pitch_deg = -60.0; pitch_deg < 30.0; pitch_deg += step_deg, ++rays) {
        const auto met = met_by(triangles, eye_m, towards(heading_deg, pitch_deg));
        hole_deg = met && met->from_behind ? hole_deg + step_deg : 0.0;
        highest_deg = std::max(highest_deg, hole_deg);
        holes += hole_deg > 0.0 ? 1 : 0;
      }
    }
    CHECK(highest_deg < most_deg);
    CHECK(holes <= rim_share(model.kind) * rays);
  }
}

TEST_CASE("each mirror is seen from the eyes and shows the road behind by the law of reflection") {
  for (const VehicleModel& model : vehicle_models()) {
    CAPTURE(model.name);
    const auto mirrors = vehicle_mirrors(model);
    if (!is_driven(model) || has_cockpit(model) || model.kind == ParticipantKind::bicycle ||
        model.kind == ParticipantKind::pedestrian) {
      CHECK(mirrors.empty());
      continue;
    }
    CHECK(mirrors.size() == (model.kind == ParticipantKind::car ? 3 : 2));
    const auto triangles = triangles_of(inside_parts(model));
    const Vec3 eye_m = eye_in(model);
    for (const VehicleMirror& mirror : mirrors) {
      CAPTURE(mirror.middle_m.y);
      const double away_m = glm::distance(eye_m, mirror.middle_m);
      const Vec3 along = (mirror.middle_m - eye_m) / away_m;
      const auto met = met_by(triangles, eye_m, along);
      REQUIRE(met.has_value());
      CHECK(met->finish == index_of(Finish::mirror));
      CHECK(std::abs(met->distance_m - away_m) < 0.02);
      CHECK(glm::reflect(along, mirror.normal).x < -0.98);
      CHECK(glm::length(glm::cross(mirror.right, mirror.up()) - mirror.normal) < 1e-9);
    }
  }
}

TEST_CASE(
    "whoever sits in a vehicle has its dials before them, turned to their eyes, with the steering wheel alone "
    "between") {
  for (const VehicleModel& model : vehicle_models()) {
    if (!is_driven(model) || has_cockpit(model)) continue;
    CAPTURE(model.name);
    const auto dials = dials_in(model);
    CHECK(dials.has_value() == (is_enclosed(model) || model.kind == ParticipantKind::motorcycle));
    if (!dials) continue;
    namespace panel = instrument_panel;
    const Vec3 eye_m = eye_in(model);
    VehicleParts parts = inside_parts(model);
    std::erase_if(parts, [](const VehiclePart& part) { return part.name.starts_with("steering wheel"); });
    const auto triangles = triangles_of(parts);
    const Vec3 away_m = *dials * panel::middle_m - eye_m;
    CHECK(glm::length(away_m) < 1.3);
    CHECK(std::abs(away_m.y) < 1e-9);
    CHECK(glm::dot(dials->orientation * panel::normal, -glm::normalize(away_m)) > 0.9);
    for (const double across : {-0.45, 0.0, 0.45})
      for (const double upward : {-0.4, 0.0, 0.4}) {
        CAPTURE(across);
        CAPTURE(upward);
        const Vec3 at =
            *dials * (panel::middle_m + across * panel::width_m * panel::right + upward * panel::height_m * panel::up);
        const auto met = met_by(triangles, eye_m, glm::normalize(at - eye_m));
        CHECK((!met || met->distance_m > glm::distance(at, eye_m)));
      }
  }
}

TEST_CASE("a rider sees handlebars and arms, a walker nothing of the own head, and what is towed has no inside") {
  for (const char* name : {"motorcycle", "bicycle"}) {
    CAPTURE(name);
    const VehicleModel& model = vehicle_models()[*find_vehicle_model(name)];
    const auto triangles = triangles_of(inside_parts(model));
    // Low before them, to both sides, within reach.
    for (const double side : {-1.0, 1.0}) {
      int met = 0;
      for (double heading_deg = 5.0; heading_deg <= 60.0; heading_deg += 1.0)
        for (double pitch_deg = -75.0; pitch_deg <= -35.0; pitch_deg += 1.0) {
          const auto own = met_by(triangles, eye_in(model), towards(side * heading_deg, pitch_deg));
          met += own && own->distance_m < 0.9 ? 1 : 0;
        }
      CHECK(met >= 20);
    }
  }
  for (const char* name : {"caravan", "semitrailer", "volvo-s80"})
    CHECK(inside_parts(vehicle_models()[*find_vehicle_model(name)]).empty());
}

TEST_CASE("the head that a rider or walker does not see of themselves is there to throw its shadow") {
  const auto polygons_of = [](const VehicleParts& parts) {
    std::size_t count = 0;
    for (const VehiclePart& part : parts)
      if (!part.places.empty() && part.places.front().visible_from_m <= 0.0f && !part.name.starts_with("fittings"))
        count += part.mesh.polygons.size();
    return count;
  };
  for (const char* name : {"pedestrian", "bicycle", "motorcycle"}) {
    CAPTURE(name);
    const VehicleModel& model = vehicle_models()[*find_vehicle_model(name)];
    const VehicleParts head = own_head_parts(model);
    CHECK(polygons_of(head) > 50);
    CHECK(polygons_of(head) + polygons_of(inside_parts(model)) == polygons_of(vehicle_parts(model)));
    for (const InsideTriangle& t : triangles_of(head)) REQUIRE(glm::distance(t.a, eye_in(model)) < 0.3);
  }
  CHECK(own_head_parts(vehicle_models()[*find_vehicle_model("van")]).empty());
}

TEST_CASE("riders' hands hold the grips") {
  struct Row {
    const char* name;
    Finish hand;
    Vec3 grip_m;
  };
  for (const Row& row :
       {Row{"bicycle", Finish::skin, {0.86, 0.27, 1.00}}, Row{"motorcycle", Finish::leather, {1.12, 0.31, 1.02}}}) {
    CAPTURE(row.name);
    const auto triangles = triangles_of(inside_parts(vehicle_models()[*find_vehicle_model(row.name)]));
    for (const double side : {-1.0, 1.0}) {
      const Vec3 grip_m(row.grip_m.x, side * row.grip_m.y, row.grip_m.z);
      // Ahead of the bar as well: an arm alone ends behind it.
      CHECK(std::ranges::any_of(triangles, [&](const InsideTriangle& t) {
        return t.finish == index_of(row.hand) && glm::distance(t.a, grip_m) < 0.09 && t.a.x > grip_m.x + 0.025;
      }));
    }
  }
}

TEST_CASE("a bus's driver sees the glass of the mirrors before the windscreen, and no housing on the pillars") {
  for (const char* name : {"coach", "city-bus"}) {
    CAPTURE(name);
    const VehicleModel& model = vehicle_models()[*find_vehicle_model(name)];
    VehicleParts parts = inside_parts(model);
    std::erase_if(parts, [](const VehiclePart& part) { return part.name.starts_with("fittings"); });
    for (const InsideTriangle& t : triangles_of(parts))
      if (t.finish == index_of(Finish::trim) && t.a.x > model.front_m() - 0.7 && t.a.z > 1.5)
        REQUIRE(std::abs(t.a.y) < 0.5 * model.width_m);
  }
}

TEST_CASE("in the driver's car the bonnet is seen over the dashboard, and the road over the bonnet") {
  const auto triangles = triangles_of(interior_parts());
  const Vec3 eye_m(1.35, 0.37, 1.17);
  CHECK_FALSE(met_by(triangles, eye_m, towards(0.0, 0.0)).has_value());
  int bonnet = 0;
  for (double pitch_deg = -0.5; pitch_deg > -30.0; pitch_deg -= 0.5) {
    const auto met = met_by(triangles, eye_m, towards(0.0, pitch_deg));
    bonnet += met && met->finish == index_of(CockpitFinish::paint) ? 1 : 0;
  }
  CHECK(bonnet >= 4);  // Two degrees.
}

}  // namespace septet::scenery
