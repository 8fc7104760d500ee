#pragma once
/// The objects of a drive's scene that its generated world has not, or has otherwise: what an operator's map shows of
/// the work of all editors. Read again only as far as the scene has changed.

#include <map>
#include <memory>
#include <set>
#include <vector>

#include "engine/scene/solid_box.hpp"
#include "engine/scene/store.hpp"
#include "sim-server/page/placing_view.hpp"

namespace septet::server {

class PlacedThings {
 public:
  /// Both outlive it. `generated`: the world before any edit.
  PlacedThings(const scene::Store& generated, const scene::Store& store);

  /// A new object whenever it has changed.
  std::shared_ptr<const page::PlacedView> view();
  /// Single things, generated or placed, whose origins lie within this distance of a place; the nearest eight, in order.
  std::vector<page::PlacedThing> near(const Vec2& place_m, double within_m);

 private:
  bool is_generated(scene::NodeId id) const { return generated_.find(id) != nullptr; }
  bool is_changed(scene::NodeId id) const;
  void look_at_all();
  void look_at_changes();
  std::set<scene::NodeId> placed() const;
  page::PlacedThing thing_of(const scene::Node& node);

  const scene::Store& generated_;
  const scene::Store& store_;
  std::uint64_t revision_ = 0;
  std::set<scene::NodeId> touched_;                  ///< Of the generated objects, those that may be changed.
  std::map<scene::NodeId, scene::ReadSolid> boxes_;  ///< Of objects that were shown.
  std::shared_ptr<const page::PlacedView> view_;
};

}  // namespace septet::server
