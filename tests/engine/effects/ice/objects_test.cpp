#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/ice/air_pattern.hpp"
#include "engine/effects/ice/objects.hpp"

namespace septet::ice {
namespace {

std::size_t triangles(const Surface& surface) { return surface.size() / 3; }

}  // namespace

TEST_CASE("the paper's objects have the paper's numbers of polygons and lie in the ball of half a metre") {
  CHECK(triangles(sphere()) == 960);
  CHECK(triangles(cube()) == 4800);
  // 14,400 but for those that shrink to nothing where patches meet in a point.
  CHECK(triangles(teapot()) > 14200);
  CHECK(triangles(teapot()) <= 14400);
  for (const char* name : {"sphere", "cube", "peanut", "teapot"}) {
    const Surface surface = *object(name);
    float reach = 0.0f, shortest = 2.0f;
    for (const IceVertex& vertex : surface) {
      reach = std::max(reach, glm::length(vertex.position_m));
      shortest = std::min(shortest, glm::length(vertex.normal));
    }
    CHECK(reach == doctest::Approx(0.5f));
    CHECK(shortest == doctest::Approx(1.0f));
  }
  CHECK(!object("pyramid").has_value());
}

TEST_CASE("sphere, cube and peanut are closed and face outwards") {
  for (const char* name : {"sphere", "cube", "peanut"}) {
    CAPTURE(name);
    const Faults found = faults(*object(name));
    CHECK(found.open_edges == 0);
    CHECK(found.flat_triangles == 0);
    CHECK(!found.inverted);
    CHECK(told(found).empty());
  }
  CHECK(!faults(teapot()).inverted);
}

TEST_CASE("open, inverted, flat and empty meshes are told and not refused") {
  Surface open = cube();
  open.resize(open.size() - 3);
  CHECK(faults(open).open_edges == 3);
  Surface inverted = sphere();
  for (std::size_t i = 0; i < inverted.size(); i += 3) std::swap(inverted[i], inverted[i + 1]);
  CHECK(faults(inverted).inverted);
  const Surface point = *read_object("v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", "point.obj");
  CHECK(faults(point).empty);
  CHECK(faults(point).flat_triangles == 1);
  CHECK(told(faults(point)).find("no extent") != std::string::npos);
}

TEST_CASE("a mesh file is read with its polygons and refused with the line that is wrong") {
  const Surface quad = *read_object("# a quad\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1/1/1 2//2 3 -1\n", "q.obj");
  CHECK(triangles(quad) == 2);
  CHECK(quad.front().normal.z == doctest::Approx(1.0f));
  for (const char* wrong : {"v 0 0\n", "v 0 0 nan\n", "v 0 0 1e30\n", "v 0 0 0\nf 1 2 3\n", "v 0 0 0\nf 0 1 1\n",
                            "v 0 0 0\nf 1 x 1\n", "", "f\n", "v 0 0 0\n"}) {
    CAPTURE(wrong);
    CHECK(!read_object(wrong, "wrong.obj").has_value());
  }
  CHECK(read_object("v 0 0 0\nf 1 2 3\n", "wrong.obj").error().where == "wrong.obj:2");
}

TEST_CASE("cracks of the field depend on the place in rest space alone, however the body is cut") {
  const Box slab{{-1.0f, -0.6f, -0.1f}, {1.0f, 0.6f, 0.1f}};
  const Box left{{-1.0f, -0.6f, -0.1f}, {0.1f, 0.6f, 0.1f}}, right{{0.1f, -0.6f, -0.1f}, {1.0f, 0.6f, 0.1f}};
  const auto whole = cracks_in(slab, 0.4f), a = cracks_in(left, 0.4f), b = cracks_in(right, 0.4f);
  CHECK(!whole.empty());
  const auto holds = [](const std::vector<Crack>& cracks, const Crack& crack) {
    return std::ranges::any_of(cracks, [&](const Crack& other) {
      return other.middle_m == crack.middle_m && other.turn == crack.turn && other.size_m == crack.size_m;
    });
  };
  for (const Crack& crack : whole) CHECK((holds(a, crack) || holds(b, crack)));
  for (const Crack& crack : a) CHECK(holds(whole, crack));
  for (const Crack& crack : b) CHECK(holds(whole, crack));
  // A body as large as the world has no more than the most that is drawn.
  CHECK(cracks_in({glm::vec3(-1e9f), glm::vec3(1e9f)}, 0.4f).size() <= 512);
}

TEST_CASE("cracks of a lone body lie near its middle, are larger than it, and are the same for the same seed") {
  const Box box{glm::vec3(-0.5f), glm::vec3(0.5f)};
  const auto cracks = generic_cracks(box, 50, 7), again = generic_cracks(box, 50, 7),
             other = generic_cracks(box, 50, 8);
  REQUIRE(cracks.size() == 50);
  for (std::size_t i = 0; i < 50; ++i) {
    CHECK(glm::length(cracks[i].middle_m) < 0.5f);
    CHECK(cracks[i].size_m > 1.7f);
    CHECK(cracks[i].middle_m == again[i].middle_m);
    CHECK(cracks[i].middle_m != other[i].middle_m);
    CHECK(std::abs(glm::determinant(cracks[i].turn) - 1.0f) < 1e-4f);
  }
}

TEST_CASE("a crack's vertices have unit normals across its faces, and air fills the box") {
  std::vector<IceVertex> inside;
  for (const Crack& crack : generic_cracks({glm::vec3(-0.5f), glm::vec3(0.5f)}, 3, 1)) append_crack(inside, crack);
  REQUIRE(inside.size() == 3 * 6 * 6 * 6);
  for (std::size_t i = 0; i < inside.size(); i += 3) {
    const glm::vec3 face = glm::normalize(
        glm::cross(inside[i + 1].position_m - inside[i].position_m, inside[i + 2].position_m - inside[i].position_m));
    for (std::size_t c = 0; c < 3; ++c) CHECK(glm::dot(face, inside[i + c].normal) > 0.85f);
  }
  inside.clear();
  append_air(inside, {glm::vec3(-0.5f), glm::vec3(0.5f)}, 19, 1);
  CHECK(inside.size() == 19 * 6);
}

TEST_CASE("a crack's normal at a corner is across its surface there") {
  Crack crack;
  crack.turn = glm::mat3(1.0f);
  crack.size_m = 2.0f;
  crack.bend = 0.25f;
  std::vector<IceVertex> inside;
  constexpr std::uint32_t cells = 64;
  append_crack(inside, crack, InsideKind::crack, cells);
  // Triangles about a corner lie in the surface but for the second order of a cell.
  for (std::size_t i = 0; i < inside.size(); i += 3)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t other = 0; other < 3; ++other) {
        const glm::vec3 along = inside[i + other].position_m - inside[i + c].position_m;
        REQUIRE(std::abs(glm::dot(along, inside[i + c].normal)) <= 0.02f * glm::length(along) + 1e-6f);
      }
}

TEST_CASE("cells above each other have cracks of their own") {
  const auto shifted_by_a_cell = [](const glm::vec3& shift) {
    const float cell = 0.4f;
    const Box low{glm::vec3(0.0f), glm::vec3(0.8f)}, high{cell * shift, glm::vec3(0.8f) + cell * shift};
    const auto a = cracks_in(low, cell), b = cracks_in(high, cell);
    int same = 0;
    for (const Crack& crack : a)
      same += std::ranges::any_of(
          b, [&](const Crack& other) { return glm::length(other.middle_m - crack.middle_m - cell * shift) < 1e-4f; });
    return same;
  };
  CHECK(shifted_by_a_cell({1, 0, 0}) == 0);
  CHECK(shifted_by_a_cell({0, 1, 0}) == 0);
  CHECK(shifted_by_a_cell({0, 0, 1}) == 0);
}

TEST_CASE("the pattern of air has haze where the noise is high and separate bubbles that are denser than it") {
  constexpr std::uint32_t side = 256;
  std::vector<std::uint8_t> clear(side * side, 0), high(side * side, 255);
  const std::vector<std::uint8_t> bubbles = air_pattern(clear, side), hazy = air_pattern(high, side);
  const auto full = static_cast<std::size_t>(std::ranges::count_if(bubbles, [](int a) { return a > 170; }));
  const auto none = static_cast<std::size_t>(std::ranges::count(bubbles, 0));
  CHECK(full > 200);
  CHECK(full < side * side / 20);
  CHECK(none > side * side * 4 / 5);
  // 0.07 of 0.5.
  CHECK(int{*std::ranges::min_element(hazy)} == 36);
  for (std::size_t i = 0; i < bubbles.size(); ++i) REQUIRE(hazy[i] >= bubbles[i]);
  // It repeats: no bubble is cut at the edge.
  for (std::size_t i = 0; i < side; ++i) CHECK(bubbles[i] + bubbles[(side - 1) * side + i] + bubbles[i * side] == 0);
}

}  // namespace septet::ice
