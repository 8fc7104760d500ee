#include "engine/scene/material_evaluation.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace septet;
using namespace septet::scene;

namespace {

// A material whose fragments have the numbers 0, 1, …; the first one is shown.
SurfaceMaterial evaluated(const std::vector<Fragment>& fragments) {
  Node node;
  MaterialData material;
  FragmentId id = 0;
  for (const Fragment& fragment : fragments) material.fragments[id++] = fragment;
  material.fragments[1000] = OutputFragment{"displacement", 77, no_fragment};
  material.fragments[1001] = OutputFragment{"color", 0, no_fragment};
  node.data = material;
  return evaluate_material(node, [](NodeId bitmap) { return static_cast<std::int32_t>(bitmap); });
}

// Emission alone, the result of plain colours.
glm::vec3 shown(const std::vector<Fragment>& fragments) { return evaluated(fragments).emission; }

}  // namespace

TEST_CASE("a blender fades from its first to its second and adds and subtracts and multiplies and divides") {
  const ColorFragment a{{0.8f, 0.4f, 0.2f}}, b{{0.2f, 0.5f, 0.0f}}, quarter{glm::vec3(0.25f)};
  const auto blended = [&](BlendKind kind) { return shown({BlenderFragment{kind, 1, 2, 3}, a, b, quarter}); };
  const auto is = [](const glm::vec3& color, const glm::vec3& expected) {
    return glm::all(glm::lessThan(glm::abs(color - expected), glm::vec3(1e-6f)));
  };
  CHECK(is(blended(BlendKind::fade), {0.65f, 0.425f, 0.15f}));
  CHECK(is(blended(BlendKind::add), {1.0f, 0.9f, 0.2f}));
  CHECK(is(blended(BlendKind::subtract), {0.6f, 0.0f, 0.2f}));
  CHECK(is(blended(BlendKind::multiply), {0.16f, 0.2f, 0.0f}));
  CHECK(is(blended(BlendKind::divide), {4.0f, 0.8f, 0.0f}));  // Division by 0 gives 0.
}

TEST_CASE("a clamp is a floor or a ceiling and a matrix turns colours row by row") {
  const ColorFragment a{{0.8f, 0.4f, 0.2f}};
  CHECK(shown({ClampFragment{true, glm::vec3(0.5f), 1}, a}) == glm::vec3(0.8f, 0.5f, 0.5f));
  CHECK(shown({ClampFragment{false, glm::vec3(0.5f), 1}, a}) == glm::vec3(0.5f, 0.4f, 0.2f));
  MatrixFragment matrix;
  matrix.matrix = {0, 1, 0, 0, 0, 0, 1, 0.5f, 1, 0, 0, 0, 0, 0, 0, 1};
  matrix.data = 1;
  const glm::vec3 turned = shown({matrix, a});
  CHECK(turned.r == 0.4f);
  CHECK(turned.g == doctest::Approx(0.7f));
  CHECK(turned.b == 0.8f);
}

TEST_CASE("a ramp steps or runs straight or smoothly from point to point") {
  const auto ramp_at = [](RampKind kind, float at) {
    RampFragment ramp{kind, RampChannel::green, 1, {{0.2f, glm::vec3(0.0f)}, {0.6f, glm::vec3(1.0f)}}};
    return shown({ramp, ColorFragment{{0.9f, at, 0.1f}}}).r;
  };
  for (const RampKind kind : {RampKind::square, RampKind::linear, RampKind::smooth}) {
    CHECK(ramp_at(kind, 0.1f) == 0.0f);
    CHECK(ramp_at(kind, 0.7f) == 1.0f);
  }
  CHECK(ramp_at(RampKind::square, 0.5f) == 0.0f);
  CHECK(ramp_at(RampKind::linear, 0.3f) == doctest::Approx(0.25));
  CHECK(ramp_at(RampKind::smooth, 0.3f) == doctest::Approx(0.0625 * 2.5));
}

TEST_CASE("half transparent glass keeps its colour and names its refraction") {
  const SurfaceMaterial glass =
      evaluated({BlenderFragment{BlendKind::fade, 1, 4, 5}, BlenderFragment{BlendKind::multiply, 2, 3, no_fragment},
                 ColorFragment{{0.4f, 0.2f, 0.1f}}, LightFragment{}, TransparencyFragment{1.0f, 1.33f},
                 ColorFragment{glm::vec3(0.75f)}});
  CHECK(glass.opacity == doctest::Approx(0.25));
  CHECK(glass.base_color.r == doctest::Approx(0.4));
  CHECK(glass.base_color.b == doctest::Approx(0.1));
  CHECK(glass.refraction_index == doctest::Approx(1.33));
  CHECK(glass.metallic == 0.0f);
  CHECK(glass.roughness == doctest::Approx(0.7));
}

TEST_CASE("what mirrors is polished and as metallic as it mirrors more than it is lit") {
  const SurfaceMaterial metal = evaluated({BlenderFragment{BlendKind::add, 1, 2, no_fragment},
                                           BlenderFragment{BlendKind::multiply, 3, 4, no_fragment}, LightFragment{},
                                           ReflectionFragment{}, ColorFragment{glm::vec3(0.5f)}});
  CHECK(metal.metallic == doctest::Approx(1.0 / 3.0));
  CHECK(metal.roughness == doctest::Approx(0.1));
  const SurfaceMaterial mirror = evaluated({ReflectionFragment{}});
  CHECK(mirror.metallic == 1.0f);
  CHECK(mirror.base_color == glm::vec3(1.0f));
}

TEST_CASE("of light from behind and of light from ahead only that from ahead lights a surface") {
  CHECK(evaluated({LightFragment{LightKind::direct}}).base_color == glm::vec3(1.0f));
  CHECK(evaluated({LightFragment{LightKind::back_direct}}).base_color == glm::vec3(0.0f));
  CHECK(evaluated({LightFragment{LightKind::ambient}}).base_color == glm::vec3(0.0f));
}

TEST_CASE("of two alternatives the first that is there is taken and noise has its mean") {
  CHECK(shown({AlternativeFragment{1, 2}, ColorFragment{glm::vec3(1.0f)}, ColorFragment{glm::vec3(0.5f)}}) ==
        glm::vec3(1.0f));
  CHECK(shown({AlternativeFragment{9, 1}, ColorFragment{glm::vec3(0.5f)}}) == glm::vec3(0.5f));
  CHECK(shown({NoiseFragment{NoiseKind::perlin_zero_to_one}}) == glm::vec3(0.5f));
  CHECK(shown({NoiseFragment{NoiseKind::point_minus_one_to_one}}) == glm::vec3(0.0f));
}

TEST_CASE("a picture reaches the colour that it is multiplied into from either side") {
  for (const bool first : {true, false}) {
    const FragmentId a = first ? FragmentId{1} : FragmentId{2}, b = first ? FragmentId{2} : FragmentId{1};
    const SurfaceMaterial shown_image = evaluated(
        {BlenderFragment{BlendKind::multiply, a, b, no_fragment}, TextureFragment{7},
         BlenderFragment{BlendKind::multiply, 3, 4, no_fragment}, ColorFragment{glm::vec3(0.5f)}, LightFragment{}});
    CHECK(shown_image.base_color_image == 7);
    CHECK(shown_image.base_color == glm::vec3(0.5f));
  }
}

TEST_CASE("whatever a tree comes to is finite and moderate") {
  const SurfaceMaterial bright = evaluated({ColorFragment{glm::vec3(3e38f, -1.0f, 2e6f)}});
  CHECK(bright.emission == glm::vec3(1e6f, 0.0f, 1e6f));
  const SurfaceMaterial lit = evaluated(
      {BlenderFragment{BlendKind::multiply, 1, 2, no_fragment}, LightFragment{}, ColorFragment{{3.0f, -2.0f, 0.5f}}});
  CHECK(lit.base_color == glm::vec3(1.0f, 0.0f, 0.5f));
  CHECK(evaluated({TransparencyFragment{1.0f, 9.0f}}).refraction_index == 4.0f);
  CHECK(evaluated({TransparencyFragment{1.0f, 0.5f}}).refraction_index == 1.0f);
  CHECK(evaluated({TransparencyFragment{1.0f, 1.5f}}).opacity == 0.0f);
}

TEST_CASE("a material that says nothing is grey") {
  Node node;
  node.data = MaterialData{};
  const SurfaceMaterial grey = evaluate_material(node, [](NodeId) { return -1; });
  CHECK(grey.base_color == SurfaceMaterial{}.base_color);
  CHECK(grey.opacity == 1.0f);
}
