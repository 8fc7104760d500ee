#include "sim-server/drive/placed_things.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>

#include "engine/core/printable.hpp"
#include "engine/math/angle_units.hpp"
#include "engine/scene/command_text.hpp"
#include "engine/scene/drawn_object.hpp"
#include "engine/scene/edit_file.hpp"
#include "sim-server/drive/stock_things.hpp"

namespace septet::server {
namespace {

constexpr std::size_t most_found = 8;

/// Those that stand at a place in the world.
const scene::ObjectData* standing(const scene::Node* node) {
  const auto* object = node ? std::get_if<scene::ObjectData>(&node->data) : nullptr;
  return object && !node->name.starts_with(scene::prototype_prefix) ? object : nullptr;
}

}  // namespace

PlacedThings::PlacedThings(const scene::Store& generated, const scene::Store& store)
    : generated_(generated), store_(store) {
  look_at_all();
}

void PlacedThings::look_at_all() {
  revision_ = store_.revision();
  touched_.clear();
  for (const auto& [id, node] : generated_.nodes())
    if (standing(&node) && is_changed(id)) touched_.insert(id);
}

void PlacedThings::look_at_changes() {
  const auto changes = store_.changes().since(revision_);
  if (!changes) return look_at_all();
  revision_ = store_.revision();
  for (const auto& change : *changes)
    if (standing(generated_.find(change.what.node))) touched_.insert(change.what.node);
}

bool PlacedThings::is_changed(scene::NodeId id) const {
  const scene::Node* was = generated_.find(id);
  const scene::Node* is = store_.find(id);
  const scene::ObjectData *before = standing(was), *now = standing(is);
  if (!before || !now) return false;
  return before->hidden != now->hidden || before->transform != now->transform || !now->motion.legs.empty() ||
         scene::is_tagged_solid(*was) != scene::is_tagged_solid(*is);
}

/// Those that editors made, but for what hangs on others. Their ids lie beyond the generated ones.
std::set<scene::NodeId> PlacedThings::placed() const {
  std::set<scene::NodeId> roots, children;
  for (auto at = store_.nodes().lower_bound(scene::edit_file_ids); at != store_.nodes().end(); ++at) {
    const scene::ObjectData* object = standing(&at->second);
    if (!object || is_generated(at->first)) continue;
    roots.insert(at->first);
    for (const auto& [id, link] : object->links)
      if (link.label == "child") children.insert(link.target);
  }
  for (const scene::NodeId child : children) roots.erase(child);
  return roots;
}

page::PlacedThing PlacedThings::thing_of(const scene::Node& node) {
  const scene::ObjectData& object = std::get<scene::ObjectData>(node.data);
  const scene::Transform& at = object.transform;
  page::PlacedThing thing{.id = node.id,
                          .name = printable(node.name, 120),
                          .node = scene::word_of({store_}, node.id),
                          .x_m = at.position_m.x,
                          .y_m = at.position_m.y,
                          .heading_deg = degrees_per_radian * heading_rad(at.rotation),
                          .middle_x_m = at.position_m.x,
                          .middle_y_m = at.position_m.y,
                          .is_shown = !object.hidden,
                          .is_solid = scene::is_tagged_solid(node),
                          .was_placed = !is_generated(node.id)};
  auto known = boxes_.find(node.id);
  if (known == boxes_.end() || !scene::is_as_read(store_, known->second.read_from)) {
    auto read = scene::read_solid(store_, node.id);
    known = boxes_.insert_or_assign(node.id, read ? std::move(*read) : scene::ReadSolid{}).first;
  }
  if (const auto& box = known->second.box) {
    thing.length_m = box->size_m.x;
    thing.width_m = box->size_m.y;
    thing.middle_x_m = box->foot_m.x;
    thing.middle_y_m = box->foot_m.y;
  }
  return thing;
}

std::shared_ptr<const page::PlacedView> PlacedThings::view() {
  if (view_ && revision_ == store_.revision()) return view_;
  look_at_changes();
  page::PlacedView view;
  const auto show = [&](scene::NodeId id) {
    if (view.things.size() < page::most_placed_shown)
      view.things.push_back(thing_of(*store_.find(id)));
    else
      ++view.more;
  };
  for (const scene::NodeId id : placed()) show(id);
  for (const scene::NodeId id : touched_)
    if (is_changed(id)) show(id);
  if (!view_ || view_->things != view.things || view_->more != view.more)
    view_ = std::make_shared<const page::PlacedView>(std::move(view));
  return view_;
}

std::vector<page::PlacedThing> PlacedThings::near(const Vec2& place_m, double within_m) {
  std::vector<std::pair<double, scene::NodeId>> found;
  const auto look = [&](const scene::Node& node) {
    const double away_m = glm::length(Vec2(std::get<scene::ObjectData>(node.data).transform.position_m) - place_m);
    if (away_m <= within_m) found.emplace_back(away_m, node.id);
  };
  for (const auto& [id, node] : store_.nodes())
    if (is_generated(id) && standing(&node) && is_single_thing(kind_of_object(node.name))) look(node);
  for (const scene::NodeId id : placed()) look(*store_.find(id));
  std::ranges::sort(found);
  found.resize(std::min(found.size(), most_found));
  std::vector<page::PlacedThing> things;
  things.reserve(found.size());
  for (const auto& [away_m, id] : found) things.push_back(thing_of(*store_.find(id)));
  return things;
}

}  // namespace septet::server
