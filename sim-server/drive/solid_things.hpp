#pragma once
/// The things of the scene that can be hit: those whose tag `body.solid` is true (engine/scene/solid_box.hpp), each with
/// the number of its solid in the simulation (engine/simulation/solids.hpp).
///
/// After each batch of an editor the solids are read from the scene again, as far as something of them changed: what was
/// moved stands elsewhere, what is hidden, destroyed or no longer tagged is met no more. The batch is refused where a
/// solid may not be, so that what is met is always what is drawn. One that was pushed stays where it came to until its
/// place, motion, shape or mass is changed: it then stands as the scene has it.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/math/rigid_transform.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/pushable_box.hpp"
#include "engine/scene/solid_box.hpp"
#include "engine/scene/store.hpp"
#include "engine/simulation/operator_command.hpp"
#include "sim-server/drive/scene_gate.hpp"

namespace septet::server {

/// A tagged thing.
struct SolidThing {
  std::uint32_t solid = 0;                         ///< Its number.
  std::optional<simulation::StandSolid> standing;  ///< Empty: it is hidden, or nothing is to be seen of it.
  std::vector<scene::ReadNode> read_from{};
  std::optional<scene::PushableBox> box{};  ///< Of one that stands and has a mass.
};

/// What a batch makes of the solids.
struct SolidChange {
  std::map<scene::NodeId, SolidThing> things;
  std::vector<simulation::OperatorCommand> commands;  ///< Bring the simulation there, each of them possible now.
};

class SolidThings {
 public:
  /// The change by a batch that the store has just taken; nothing changes here before take_over(). `editor`: whose
  /// batch it is. Error: the command by which something became solid that may not, or came where it may not stand.
  tl::expected<SolidChange, replication::Failure> change(const scene::Store& store,
                                                         std::span<const scene::Command> batch, const Editor& editor,
                                                         const simulation::Model& model,
                                                         const simulation::State& state) const;

  /// The same at a drive's beginning, when nobody may be refused: a thing that may not be solid is left out, with a
  /// message. Clears what an earlier log left standing.
  SolidChange begin(const scene::Store& store, const simulation::Model& model, const simulation::State& state,
                    std::vector<std::string>& messages) const;

  /// Tags by which screens draw what can be pushed where it is (engine/scene/pushable_box.hpp), as far as they are not set.
  std::vector<scene::Command> missing_tags(const scene::Store& store) const;

  /// Pose of a thing that nothing but pushes moves, after the state's tick; empty of others.
  std::optional<RigidTransform> pushed_pose(const scene::Store& store, scene::NodeId id,
                                            const simulation::State& state) const;

  void take_over(SolidChange change) { things_ = std::move(change.things); }

 private:
  std::map<scene::NodeId, SolidThing> things_;
};

}  // namespace septet::server
