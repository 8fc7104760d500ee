#include "sim-server/drive/solid_things.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/core.h>
#include <glm/gtc/quaternion.hpp>

#include "engine/core/printable.hpp"
#include "engine/scene/command_validation.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/bodies/loose_body.hpp"
#include "engine/simulation/solids.hpp"
#include "engine/world/solid.hpp"
#include "sim-server/drive/batch_failures.hpp"
#include "sim-server/drive/name_in_log.hpp"

namespace septet::server {
namespace {

using simulation::ClearSolid;
using simulation::StandSolid;

/// no_node may be among them.
std::set<scene::NodeId> named_in(std::span<const scene::Command> batch) {
  std::set<scene::NodeId> named;
  for (const scene::Command& command : batch) {
    named.insert(scene::node_of(command));
    if (const auto* link = std::get_if<scene::LinkSet>(&command)) named.insert(link->value.target);
  }
  return named;
}

/// The last command that names one of these nodes; the last of all where none does.
std::size_t place_in(std::span<const scene::Command> batch, const std::vector<scene::ReadNode>& nodes,
                     scene::NodeId object) {
  for (std::size_t i = batch.size(); i-- > 0;) {
    const scene::NodeId named = scene::node_of(batch[i]);
    if (named == object || std::ranges::find(nodes, named, &scene::ReadNode::first) != nodes.end()) return i;
  }
  return batch.empty() ? 0 : batch.size() - 1;
}

/// `read` has a box.
StandSolid stand_of(std::uint32_t solid, const scene::ReadSolid& read, std::string name) {
  const scene::SolidBox& box = *read.box;
  // A board and a sheet are flat; a blow needs some thickness.
  const auto thick_m = [](double size_m) { return std::max(size_m, simulation::thinnest_solid_m); };
  StandSolid stand{solid,           box.foot_m.x,          box.foot_m.y,          box.foot_m.z,
                   box.heading_rad, thick_m(box.size_m.x), thick_m(box.size_m.y), thick_m(box.size_m.z),
                   std::move(name)};
  if (read.mass_kg) stand.mass_kg = *read.mass_kg;
  if (read.legs.empty()) return stand;
  stand.about_x_m = read.about_m.x, stand.about_y_m = read.about_m.y;
  stand.legs = read.legs;
  return stand;
}

/// `read` has a box.
std::optional<scene::PushableBox> pushable_box_of(std::uint32_t solid, const scene::ReadSolid& read) {
  if (!read.mass_kg) return std::nullopt;
  const Quat box_from_world = glm::angleAxis(-read.box->heading_rad, Vec3(0.0, 0.0, 1.0));
  return scene::PushableBox{first_solid_participant + solid, box_from_world * (read.box->foot_m - read.about_m)};
}

/// The tag of this name, or an id that is free.
scene::PartId tag_id(const scene::TagGroup& group, std::string_view name) {
  scene::PartId free = 0;
  for (const auto& [id, tag] : group.tags) {
    if (tag.name == name) return id;
    if (id == free) ++free;
  }
  return free;
}

/// The tags by which screens know the box. `node` is tagged solid.
void append_tags(const scene::Node& node, const scene::PushableBox& box, std::vector<scene::Command>& commands) {
  const auto found =
      std::ranges::find_if(node.tag_groups, [](const auto& entry) { return entry.second.name == scene::solid_group; });
  const scene::PartId group = found->first;
  scene::TagGroup tags = found->second;
  const auto set = [&](std::string_view name, scene::TagValue value) {
    const scene::PartId id = tag_id(tags, name);
    tags.tags[id] = {std::string(name), std::move(value)};
    commands.emplace_back(scene::TagSet{node.id, group, id, tags.tags[id]});
  };
  set(scene::participant_tag, box.participant);
  set(scene::foot_tag, box.foot_m);
}

/// Of the solids that nobody has.
std::optional<std::uint32_t> free_number(const std::map<scene::NodeId, SolidThing>& things) {
  for (std::uint32_t number = 0; number < most_solids; ++number)
    if (std::ranges::none_of(things, [&](const auto& entry) { return entry.second.solid == number; })) return number;
  return std::nullopt;
}

std::string name_in(const scene::Store& store, scene::NodeId id) {
  const scene::Node* node = store.find(id);
  return node ? printable(node->name) : fmt::format("#{}", id);
}

tl::unexpected<Error> hangs_on(const scene::Store& store, scene::NodeId child, scene::NodeId parent) {
  return failure(fmt::format("it hangs on \"{}\"", name_in(store, parent)),
                 fmt::format("\"{}\"", name_in(store, child)),
                 "tag what it hangs on body.solid: that one's box holds it");
}

/// The thing that the batch hangs it on.
std::optional<scene::NodeId> hung_by(std::span<const scene::Command> batch, scene::NodeId child) {
  for (const scene::Command& command : batch)
    if (const auto* link = std::get_if<scene::LinkSet>(&command);
        link && link->value.label == "child" && link->value.target == child)
      return link->node;
  return std::nullopt;
}

/// Adds a thing that has become solid. Error: why it may not.
Expected<void> add_thing(const scene::Store& store, scene::NodeId id, std::map<scene::NodeId, SolidThing>& things) {
  if (const auto parent = scene::parent_of(store, id)) return hangs_on(store, id, *parent);
  const auto number = free_number(things);
  if (!number)
    return failure(fmt::format("there are {} solids already", most_solids), fmt::format("\"{}\"", name_in(store, id)),
                   "take the tag body.solid from another thing first");
  things[id] = {.solid = *number, .standing = std::nullopt};
  return {};
}

/// Reads a thing anew if it changed; commands are appended. Error: it may not stand so; then nothing has changed.
Expected<void> update_thing(const scene::Store& store, scene::NodeId id, const simulation::Model& model,
                            const simulation::State& state, SolidThing& thing,
                            std::vector<simulation::OperatorCommand>& commands) {
  if (scene::is_as_read(store, thing.read_from)) return {};
  auto read = scene::read_solid(store, id);
  if (!read) return tl::unexpected(read.error());
  std::optional<StandSolid> wanted;
  thing.box.reset();
  if (read->box) {
    wanted = stand_of(thing.solid, *read, name_in_log(store, id));
    thing.box = pushable_box_of(thing.solid, *read);
    // Renamed, it stays where it was pushed to.
    if (thing.box && thing.standing) wanted->name = thing.standing->name;
  }
  if (wanted != thing.standing) {
    if (wanted) {
      if (auto may = simulation::may_stand(model, state, *wanted); !may)
        return failure(fmt::format("\"{}\" cannot stand there: {}", name_in(store, id), may.error().what), "solid",
                       may.error().remedy);
      commands.emplace_back(*wanted);
    } else {
      commands.emplace_back(ClearSolid{thing.solid});
    }
  }
  thing.standing = wanted;
  thing.read_from = std::move(read->read_from);
  return {};
}

bool is_solid_now(const scene::Store& store, scene::NodeId id) {
  const scene::Node* node = store.find(id);
  return node && scene::is_tagged_solid(*node);
}

std::string why_no_right(const Editor& editor, const std::string& name) {
  return fmt::format(
      "the key of {} may not change whether \"{}\" is solid: its line in allowed-clients needs the word "
      "solid",
      editor.name, name);
}

}  // namespace

tl::expected<SolidChange, replication::Failure> SolidThings::change(const scene::Store& store,
                                                                    std::span<const scene::Command> batch,
                                                                    const Editor& editor,
                                                                    const simulation::Model& model,
                                                                    const simulation::State& state) const {
  SolidChange change{things_, {}};
  const auto refuse = [&](scene::NodeId id, const std::vector<scene::ReadNode>& parts, std::string why) {
    return tl::unexpected(replication::Failure{place_in(batch, parts, id), told_name(store, id), std::move(why)});
  };
  const bool may_change = editor.rights.includes(net::EditKind::solid);
  const std::set<scene::NodeId> named = named_in(batch);
  for (const scene::NodeId id : named) {
    const auto known = change.things.find(id);
    const bool was_solid = known != change.things.end(), is_solid = is_solid_now(store, id);
    if (was_solid != is_solid && store.find(id) && !may_change)
      return refuse(id, {}, why_no_right(editor, name_in(store, id)));
    if (was_solid && !is_solid) {
      if (known->second.standing) change.commands.emplace_back(ClearSolid{known->second.solid});
      change.things.erase(known);
    }
  }
  for (const scene::NodeId id : named) {
    if (!is_solid_now(store, id)) continue;
    if (const auto parent = hung_by(batch, id)) return refuse(id, {}, describe(hangs_on(store, id, *parent).value()));
    if (change.things.contains(id)) continue;
    if (const auto added = add_thing(store, id, change.things); !added) return refuse(id, {}, describe(added.error()));
  }
  for (auto& [id, thing] : change.things)
    if (const auto done = update_thing(store, id, model, state, thing, change.commands); !done)
      return refuse(id, thing.read_from, describe(done.error()));
  return change;
}

SolidChange SolidThings::begin(const scene::Store& store, const simulation::Model& model,
                               const simulation::State& state, std::vector<std::string>& messages) const {
  SolidChange change;
  for (std::uint32_t solid = 0; solid < most_solids; ++solid)
    if (simulation::stands(state, solid)) change.commands.emplace_back(ClearSolid{solid});
  for (const auto& [id, node] : store.nodes()) {
    if (!scene::is_tagged_solid(node)) continue;
    auto done = add_thing(store, id, change.things);
    if (done) done = update_thing(store, id, model, state, change.things[id], change.commands);
    if (done) continue;
    change.things.erase(id);
    messages.push_back("not solid: " + describe(done.error()));
  }
  return change;
}

std::vector<scene::Command> SolidThings::missing_tags(const scene::Store& store) const {
  std::vector<scene::Command> missing;
  for (const auto& [id, thing] : things_) {
    const scene::Node* node = thing.box ? store.find(id) : nullptr;
    if (node && scene::pushable_box(*node) != thing.box) append_tags(*node, *thing.box, missing);
  }
  return missing;
}

std::optional<RigidTransform> SolidThings::pushed_pose(const scene::Store& store, scene::NodeId id,
                                                       const simulation::State& state) const {
  const auto thing = things_.find(id);
  const scene::Node* node = store.find(id);
  if (thing == things_.end() || !thing->second.box || !node) return std::nullopt;
  const simulation::LooseBody* body = simulation::find_loose(state, thing->second.box->participant);
  if (!body) return std::nullopt;
  const Participant box = simulation::participant_of(*body);
  if (!is_free_solid(box)) return std::nullopt;
  const auto& data = std::get<scene::ObjectData>(node->data);
  const Quat& rotation = data.motion.legs.empty() ? data.transform.rotation : data.motion.rotation;
  return scene::pose_by_box(*thing->second.box, box.world_from_vehicle, glm::normalize(rotation), data.motion);
}

}  // namespace septet::server
