#pragma once
/// A material's tree of fragments as a sum of lobes: shares of a surface's light to the eye (CONVENTIONS.md,
/// "Materials").
///
/// Evaluated once for a surface as a whole, where a texture stays an image that multiplies a lobe; or at one place of
/// the surface, where it is the colour that is read there. One code for both, so they agree wherever nothing varies.
/// Pure functions; any thread.

#include <functional>
#include <memory>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/scene/material_fragment.hpp"
#include "engine/scene/node.hpp"

namespace septet::scene {

inline float mean_of_channels(const glm::vec3& color) { return (color.r + color.g + color.b) / 3.0f; }

/// A colour (linear Rec. 709), times an image where there is one.
struct Lobe {
  glm::vec3 color{0.0f};
  NodeId image = no_node;
};

struct Lobes {
  Lobe plain;  ///< Light of its own.
  Lobe lit;    ///< Light in proportion to the light that falls on it.
  Lobe mirror;
  Lobe through;
  float refraction_index = 1.5f;
  float alpha = 1.0f;  ///< At a place: least of the textures that are read there.
  /// False: the tree varies over the surface in a way that these lobes cannot say, and means stand in for it.
  bool exact = true;

  bool is_plain() const {
    return lit.color == glm::vec3(0.0f) && mirror.color == glm::vec3(0.0f) && through.color == glm::vec3(0.0f);
  }
};

struct SurfacePlace {
  glm::vec2 uv{0.0f};  ///< map_u, map_v.
  /// Colour and alpha of a texture fragment at these coordinates of its bitmap.
  std::function<glm::vec4(const TextureFragment&, const glm::vec2&)> texture;
};

/// Lobes of the output "color" of the surface as a whole; neutral grey without one.
Lobes evaluate_lobes(const MaterialData& material);

/// The same at one place after another: what does not depend on the place is evaluated once. One thread at a time.
class LobesAtPlaces {
 public:
  /// `material` outlives it.
  explicit LobesAtPlaces(const MaterialData& material);
  ~LobesAtPlaces();
  LobesAtPlaces(const LobesAtPlaces&) = delete;
  LobesAtPlaces& operator=(const LobesAtPlaces&) = delete;

  Lobes at(const SurfacePlace& place);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace septet::scene
