#pragma once
/// Commands and stores for tests.

#include <stdexcept>
#include <vector>

#include "engine/core/random.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"

namespace septet::scene {

/// Ends the test if the store refuses.
inline void must_apply(Store& store, const Command& command) {
  const auto done = store.apply(command);
  if (!done) throw std::runtime_error(describe(done.error()));
}

/// Fragments, one of every kind.
inline std::vector<Fragment> sample_fragments() {
  RampFragment ramp{RampKind::smooth, RampChannel::green, 1, {{0.25f, {0.0f, 0.5f, 1.0f}}, {0.75f, glm::vec3(1.0f)}}};
  MatrixFragment matrix;
  matrix.matrix[5] = 0.25f;
  matrix.data = 4;
  return {ColorFragment{{0.1f, 0.2f, 0.3f}},
          LightFragment{LightKind::back_ambient, 0.5f, 9, "r", "g", "b"},
          ReflectionFragment{0.25f},
          TransparencyFragment{0.5f, 1.33f},
          VolumeFragment{0.125f, {0.5f, 0.25f, 1.0f}},
          ViewFragment{},
          GeometryFragment{"map_u", "map_v", ""},
          TextureFragment{7, "color_r", "color_g", "color_b", false, 6},
          NoiseFragment{NoiseKind::point_zero_to_one, 6},
          BlenderFragment{BlendKind::multiply, 0, 7, no_fragment},
          ClampFragment{true, {0.1f, 0.1f, 0.1f}, 9},
          matrix,
          ramp,
          AnimationFragment{"wave"},
          AlternativeFragment{9, 0},
          OutputFragment{"color", 14, no_fragment}};
}

/// Commands, at least one of every kind; applied in order they fill a store (but for the subscriptions).
inline std::vector<Command> sample_commands() {
  std::vector<Command> commands = {
      NodeIndexSubscribe{0b1111},
      NodeSubscribe{3, true},
      PartSubscribe{3, PartKind::layer, 2, false},
      NodeCreate{1, NodeType::object},
      NodeCreate{2, NodeType::geometry},
      NodeCreate{3, NodeType::material},
      NodeCreate{4, NodeType::bitmap},
      NodeCreate{5, NodeType::object},
      NodeDestroy{5},
      NodeNameSet{1, "model/saloon"},
      TagGroupSet{1, 0, "draw"},
      TagGroupSet{1, 1, "gone"},
      TagSet{1, 0, 0, {"flag", true}},
      TagSet{1, 0, 1, {"count", std::uint32_t{4000000000u}}},
      TagSet{1, 0, 2, {"from_m", 12.5}},
      TagSet{1, 0, 3, {"role", std::string("beacon")}},
      TagSet{1, 0, 4, {"where", Vec3(1.0, -2.0, 1e6)}},
      TagSet{1, 0, 5, {"look", NodeReference{3}}},
      TagSet{1, 0, 6, {"blob", Blob{0, 1, 2, 255}}},
      TagSet{1, 0, 7, {"gone", false}},
      TagDestroy{1, 0, 7},
      TagGroupDestroy{1, 1},
      TransformSet{1, {{1e6, -2.0, 0.125}, {0.6, 0.8, 0.0, 0.0}, {1.0f, 2.0f, 3.0f}}},
      LinkSet{1, 0, {"geometry", 2, 0}},
      LinkSet{1, 1, {"material", 3, 7}},
      LinkSet{1, 2, {"child", no_node, 0}},
      LinkDestroy{1, 2},
      HideSet{1, true},
      MotionSet{1,
                {{1e6, -2.0, 0.125},
                 {0.6, 0.8, 0.0, 0.0},
                 {{2.5, {1, 0, -3}, {0, 0, -9.81}, {0, 0, 0.5}}, {4.0, {}, {}, {}}}}},
      GeometrySizeSet{2, 5, 2},
      GeometryLayerSet{2, 0, "map_u", LayerType::corner_real, 0, 0.5f},
      GeometryLayerSet{2, 1, "crease", LayerType::corner_integer, geometry::crease_sharp, 0.0f},
      GeometryLayerSet{2, 2, "material", LayerType::face_byte, 0, 0.0f},
      GeometryLayerSet{2, 3, "gone", LayerType::vertex_xyz, 0, 0.0f},
      GeometryLayerDestroy{2, 3},
      VerticesSet{2, 0, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
      VerticesSet{2, 4, {{0.1f, 0.2f, 2e8f}}},
      PolygonsSet{2, 0, {{0, 1, 2, 3}, {0, 3, 4, geometry::no_vertex}}},
      LayerRealsSet{2, 0, 1, {0.0f, 0.25f, 1.0f, -3.5f}},
      LayerIntegersSet{2, 1, 0, {0, geometry::crease_sharp, 0, 0, 0, 0, 5, 5}},
      LayerIntegersSet{2, 2, 1, {255}},
      CreaseSet{2, CreaseKind::edge, {"crease", 7}},
      CreaseSet{2, CreaseKind::vertex, {"", geometry::crease_sharp}},
      BitmapSizeSet{4, 17, 9, 1},
      BitmapLayerSet{4, 0, "color_r", PixelType::byte},
      BitmapLayerSet{4, 1, "height", PixelType::real32},
      BitmapLayerSet{4, 2, "gone", PixelType::bit},
      BitmapLayerDestroy{4, 2},
      BitmapTilesSet{4, 0, 2, std::vector<std::uint8_t>(4 * 64, 77)},
      FragmentSet{3, 100, ColorFragment{}},
      FragmentDestroy{3, 100},
  };
  FragmentId id = 0;
  for (const Fragment& fragment : sample_fragments()) commands.push_back(FragmentSet{3, id++, fragment});
  return commands;
}

inline Store sample_store() {
  Store store;
  for (const Command& command : sample_commands())
    if (command.index() > 2) must_apply(store, command);
  return store;
}

}  // namespace septet::scene
