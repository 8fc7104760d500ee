#pragma once
/// The objects of the generated world that can be hit where they are drawn: trees, houses, lamps and whatever else is
/// one object of the scene and one thing beside the roads (engine/simulation/standing.hpp). Each belongs to the thing in
/// whose place it was generated.
///
/// After each batch of an editor a thing whose objects are all hidden, destroyed or elsewhere is gone from its place;
/// once one of them is drawn there again it stands again.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/roadside/obstacles.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"
#include "engine/simulation/operator_command.hpp"
#include "sim-server/drive/scene_gate.hpp"

namespace septet::server {

class StandingThings {
 public:
  StandingThings() = default;
  /// `generated` has what the world was generated with, and no more.
  StandingThings(const scene::Store& generated, const roadside::Obstacles& obstacles);

  /// Commands that bring the simulation to what a batch that the store has just taken has made, each of them possible
  /// now. Error: the command by which a thing came back where somebody is.
  tl::expected<std::vector<simulation::OperatorCommand>, replication::Failure> change(
      const scene::Store& store, std::span<const scene::Command> batch, const simulation::Model& model,
      const simulation::State& state) const;

  /// The same at a drive's beginning, of all things; one that may not come back stays gone, with a message.
  std::vector<simulation::OperatorCommand> begin(const scene::Store& store, const simulation::Model& model,
                                                 const simulation::State& state,
                                                 std::vector<std::string>& messages) const;

  std::size_t size() const { return things_.size(); }

 private:
  struct Object {
    scene::NodeId id = scene::no_node;
    scene::Transform generated;
  };
  struct Thing {
    simulation::ShowStanding place;
    std::vector<Object> objects;
  };
  static bool is_drawn(const scene::Store& store, const Object& object);
  /// Empty: the simulation has it as the scene has it.
  static std::optional<simulation::ShowStanding> change_of(std::uint32_t number, const Thing& thing,
                                                           const scene::Store& store, const simulation::State& state);

  std::map<std::uint32_t, Thing> things_;            ///< By their numbers among the obstacles.
  std::map<scene::NodeId, std::uint32_t> thing_of_;  ///< By object.
};

}  // namespace septet::server
