#pragma once
/// What an operator places, moves and hides on the page's map, by an editor's lines (docs/editing.md) through the
/// drive's one gate:
///
///     like NAME NODE X Y Z HEADING      import NAME FILE.glb X Y Z HEADING      move NODE X Y Z HEADING
///     hide NODE      show NODE      solid NODE [off]      remove NODE
///
/// Z may be the word `ground`: the height of the road or the land there. FILE.glb is the name of a file of the drive's
/// folders, never a path.

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/editor/edit_verbs.hpp"
#include "engine/scene/store.hpp"
#include "engine/simulation/model.hpp"
#include "sim-server/drive/placed_things.hpp"
#include "sim-server/drive/world_gate.hpp"
#include "sim-server/page/placing_view.hpp"

namespace septet::server {

/// First of the ids of what the page makes: beyond those of all sessions (engine/replication/replication_server.cpp).
inline constexpr scene::NodeId page_ids = 0xE0000000u;

/// World z of the ground: of the road or the kerb on it, else of the land; 0 without either.
double ground_m(const simulation::Model& model, const Vec2& place_m);

/// The .glb files of these folders by their names; of two with one name the first folder's.
std::map<std::string, std::filesystem::path> models_in(const std::vector<std::filesystem::path>& folders);

class Placing {
 public:
  /// `gate` and `model` outlive it. `folders`: where models lie. `out`: where files of edits are written.
  Placing(WorldGate& gate, const simulation::Model& model, const std::vector<std::filesystem::path>& folders,
          std::filesystem::path out);

  page::PlacingFacts facts() const;
  /// Does these lines as one batch, shown from this tick on. Error: a line that cannot be read, or why the gate refuses.
  Expected<void> take(std::string_view lines, Tick from);
  /// Writes what differs from the generated world to NAME.edits; returns the file. Error: a name that is none.
  Expected<std::filesystem::path> save(const std::string& name) const;
  std::vector<page::PlacedThing> near(const Vec2& place_m, double within_m);
  /// Null where the drive has no scene.
  std::shared_ptr<const page::PlacedView> view();

 private:
  Expected<editor::EditedLine> edit_of(std::string_view line, editor::EditNames& names) const;

  WorldGate& gate_;
  const simulation::Model& model_;
  std::map<std::string, std::filesystem::path> models_;
  std::filesystem::path out_;
  std::optional<PlacedThings> things_;  ///< Empty where the drive has no scene.
  scene::NodeId next_ = page_ids;       ///< First id that was never used.
};

}  // namespace septet::server
