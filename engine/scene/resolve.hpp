#pragma once
/// Nodes to drawable content: subdivides, triangulates, evaluates materials, places instances.
///
/// Incremental: `update` compares the revisions and redoes only parts that changed since its last call, so that a flood
/// of commands costs no more than the nodes that they touched. Slots of ResolvedScene keep their index for as long as
/// their node is in use; slots of removed content are emptied (with a new revision), and an emptied mesh slot is used
/// again. The reading of nodes is fixed in CONVENTIONS.md. Meaningless content (a dangling link, a polygon with a
/// corner out of range, a loop of children or fragments) is left out or neutral, never an error: the store holds any
/// content that the network brought.

#include <cstdint>
#include <memory>

#include "engine/scene/resolved_scene.hpp"
#include "engine/scene/store.hpp"

namespace septet::scene {

class Resolver {
 public:
  Resolver();
  ~Resolver();
  Resolver(Resolver&&) noexcept;
  Resolver& operator=(Resolver&&) noexcept;

  /// Brings the scene up to the store's revision. Returns true if anything changed. `mesh_budget` bounds the meshes
  /// made in this call (the rest follow in the next ones; see `pending`), so that a big change does not stop the
  /// picture.
  bool update(const Store& store, std::size_t mesh_budget = ~std::size_t{0});

  /// The next update reads another store (a mirror that was filled anew). Revisions keep rising.
  void forget();

  const ResolvedScene& scene() const;
  /// Meshes that still wait for an update.
  std::size_t pending() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The whole scene at once.
ResolvedScene resolve(const Store& store);

}  // namespace septet::scene
