#pragma once
/// The things of the scene that can be hit: those whose tag `body.solid` is true (engine/scene/solid_box.hpp), each with
/// the number of its solid in the simulation (engine/simulation/solids.hpp).
///
/// After each batch of an editor the solids are read from the scene again, as far as something of them changed: what was
/// moved stands elsewhere, what is hidden, destroyed or no longer tagged is met no more. The batch is refused where a
/// solid may not be, so that what is met is always what is drawn.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/command.hpp"
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

  void take_over(SolidChange change) { things_ = std::move(change.things); }

 private:
  std::map<scene::NodeId, SolidThing> things_;
};

}  // namespace septet::server
