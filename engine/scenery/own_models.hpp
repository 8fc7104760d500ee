#pragma once
/// User's own models in place of generated ones: by name, as read from glTF files (engine/gltf), and as shapes of the
/// scene.
///
/// docs/own-models.md lists the meaning and origin of each name. A part whose node name begins with a PartRole
/// (`wheel_front_left`, `lamp_brake`, …) moves or shines accordingly; a material named `paint` takes the participant's
/// colour.

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gltf/gltf.hpp"
#include "engine/scenery/palette.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::scenery {

using OwnModels = std::map<std::string, gltf::Model, std::less<>>;

/// Names of replaceable objects beside roads; `is_replaceable` is true for the catalogue's vehicles, too.
std::span<const std::string_view> replaceable_things();
bool is_replaceable(std::string_view name);

/// True if a node of that name moves or shines on its own.
bool begins_own_part(std::string_view node_name);

/// The model in a file. Error: as of read_gltf, or a file that cannot be read.
Expected<gltf::Model> read_own_model(const std::filesystem::path& file);

/// Offset of a vehicle's model in the vehicle frame: the middle of its box, seen from above, goes to the middle of the
/// vehicle's.
glm::dvec3 vehicle_from_own_model_m(const gltf::Model& own, const VehicleModel& vehicle);

/// Warning for a model whose box differs from the vehicle's by more than a tenth and 5 cm; null if it does not.
std::optional<std::string> size_differs(const gltf::Model& own, const VehicleModel& vehicle);

/// Models as shapes: each is added to the scene when it is first placed.
class OwnShapes {
 public:
  /// `models`, which may be null, outlives this.
  OwnShapes(scene::SceneBuilder& builder, const OwnModels* models) : builder_(builder), models_(models) {}

  const gltf::Model* find(std::string_view name) const;

  /// Places all parts of the model `name`, each moved and scaled with the whole, and with its own role. False: there is
  /// no such model.
  bool place(std::string_view name, const Placement& placement, scene::NodeId parent = scene::no_node);

 private:
  const std::vector<Shape>& shapes_of(std::string_view name, const gltf::Model& model);

  scene::SceneBuilder& builder_;
  const OwnModels* models_;
  std::map<std::string, std::vector<Shape>, std::less<>> shapes_;  ///< Shapes by name, one for each part.
};

}  // namespace septet::scenery
