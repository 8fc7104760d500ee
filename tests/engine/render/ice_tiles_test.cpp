#include "engine/render/passes/ice_tiles.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

namespace septet::render {
namespace {

/// Body in the form of a triangle of this size.
ice::IceBody body_at(const Vec3& origin_m, float size_m, bool thin = false) {
  ice::IceBody body;
  body.origin_m = origin_m;
  body.look.thin = thin;
  for (const glm::vec3 p : {glm::vec3(-1, 0, 0), {1, 0, 0}, {0, 0, 1}})
    body.vertices.push_back({0.5f * size_m * p, {}, {}});
  return body;
}

}  // namespace

TEST_CASE(
    "ice on a roof and ice on the road have surroundings of their own, and pieces that lie together share theirs") {
  const std::vector<ice::IceBody> bodies{body_at({20, 3, 3.9}, 2.0f), body_at({21, 3.4, 3.9}, 2.0f),
                                         body_at({8, 0, 0.05}, 0.4f), body_at({9, 0.8, 0.05}, 0.3f)};
  const IceNeighbourhoods found = ice_neighbourhoods(bodies, {0, 0, 1.2});
  REQUIRE(found.middles_m.size() == 2);
  CHECK(found.of_body[0] == found.of_body[1]);
  CHECK(found.of_body[2] == found.of_body[3]);
  CHECK(found.of_body[0] != found.of_body[2]);
  CHECK(glm::length(found.middles_m[found.of_body[0]] - Vec3(20.5, 3.2, 3.9)) < 0.3);
  CHECK(glm::length(found.middles_m[found.of_body[2]] - Vec3(8.5, 0.4, 0.05)) < 0.3);
}

TEST_CASE(
    "of ice in many places two have surroundings of their own, the largest in the eye, and all others the nearest "
    "ones") {
  std::vector<ice::IceBody> bodies;
  for (int i = 0; i < 12; ++i) bodies.push_back(body_at({10.0 + 9.0 * i, 0.0, 0.0}, i == 7 ? 9.0f : 1.0f));
  const IceNeighbourhoods found = ice_neighbourhoods(bodies, Vec3(0.0));
  REQUIRE(found.middles_m.size() == most_neighbourhoods);
  // Groups of the nearest body, and of the large one although it is further off than most.
  CHECK(glm::length(found.middles_m[found.of_body[0]] - bodies[0].origin_m) < 2.0);
  CHECK(std::ranges::count(found.of_body, found.of_body[7]) > 1);
  CHECK(found.of_body[7] == found.of_body[11]);
  for (std::size_t i = 0; i < bodies.size(); ++i) CHECK(found.of_body[i] < most_neighbourhoods);
}

TEST_CASE("an eye among thin sheets looks from above the road, and bodies without a place or size take nothing away") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(ice_neighbourhoods(std::vector{body_at({20, 0, 5}, 4.0f, true)}, Vec3(0.0)).middles_m.at(0).z > 5.2);
  ice::IceBody empty, broken = body_at({1, 2, 3}, 1.0f);
  broken.vertices[1].position_m.x = std::numeric_limits<float>::quiet_NaN();
  const auto found = ice_neighbourhoods(std::vector{empty, broken, body_at({10, 0, 0}, 1.0f)}, Vec3(0.0));
  CHECK(found.of_body.size() == 3);
  CHECK(ice_neighbourhoods(std::vector{body_at({nan, 0, 0}, 1.0f), body_at({10, 0, 0}, 1.0f)}, Vec3(0.0))
            .of_body.size() == 2);
  CHECK(ice_neighbourhoods({}, Vec3(0.0)).middles_m.empty());
}

TEST_CASE("surroundings are drawn for the bodies that a screen sees, and each tile knows its own") {
  IceNeighbourhoods neighbourhoods{{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {0, 1, 2, 1}};
  IceTiles tiles;
  tiles.list.resize(3);
  tiles.list[0].body = 3, tiles.list[1].body = 2, tiles.list[2].body = 1;
  const std::vector<Vec3> seen = seen_neighbourhoods(neighbourhoods, tiles);
  REQUIRE(seen.size() == 2);
  CHECK(seen[0] == Vec3(2, 0, 0));
  CHECK(seen[1] == Vec3(3, 0, 0));
  CHECK(tiles.list[0].around == 0);
  CHECK(tiles.list[1].around == 1);
  CHECK(tiles.list[2].around == 0);
}

}  // namespace septet::render
