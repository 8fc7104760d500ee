#include "sim-server/drive/standing_things.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <variant>

#include "engine/scene/command_validation.hpp"
#include "engine/scene/drawn_object.hpp"
#include "engine/simulation/standing.hpp"
#include "sim-server/drive/batch_failures.hpp"
#include "sim-server/drive/name_in_log.hpp"

namespace septet::server {
namespace {

std::set<scene::NodeId> children_in(const scene::Store& store) {
  std::set<scene::NodeId> children;
  for (const auto& [id, node] : store.nodes())
    if (const auto* object = std::get_if<scene::ObjectData>(&node.data))
      for (const auto& [link_id, link] : object->links)
        if (link.label == "child") children.insert(link.target);
  return children;
}

}  // namespace

StandingThings::StandingThings(const scene::Store& generated, const roadside::Obstacles& obstacles) {
  const std::set<scene::NodeId> children = children_in(generated);
  for (const auto& [id, node] : generated.nodes()) {
    if (node.type() != scene::NodeType::object || children.contains(id)) continue;
    const scene::DrawnObject drawn = scene::read_object(node);
    if (drawn.prototype || drawn.geometry == scene::no_node) continue;
    const Vec3& at_m = drawn.transform.position_m;
    const std::uint32_t number = obstacles.thing_at(Vec2(at_m));
    if (number == 0) continue;
    Thing& thing = things_[number];
    if (thing.objects.empty()) thing.place = {at_m.x, at_m.y, false, name_in_log(generated, id)};
    thing.objects.push_back({id, drawn.transform});
    thing_of_[id] = number;
  }
}

bool StandingThings::is_drawn(const scene::Store& store, const Object& object) {
  const scene::Node* node = store.find(object.id);
  if (!node || node->type() != scene::NodeType::object) return false;
  const scene::DrawnObject drawn = scene::read_object(*node);
  return !drawn.hidden && !drawn.prototype && drawn.motion.legs.empty() && drawn.transform == object.generated;
}

std::optional<simulation::ShowStanding> StandingThings::change_of(std::uint32_t number, const Thing& thing,
                                                                  const scene::Store& store,
                                                                  const simulation::State& state) {
  simulation::ShowStanding show = thing.place;
  show.shown = std::ranges::any_of(thing.objects, [&](const Object& object) { return is_drawn(store, object); });
  if (show.shown != std::ranges::binary_search(state.gone, number)) return std::nullopt;
  return show;
}

tl::expected<std::vector<simulation::OperatorCommand>, replication::Failure> StandingThings::change(
    const scene::Store& store, std::span<const scene::Command> batch, const simulation::Model& model,
    const simulation::State& state) const {
  std::map<std::uint32_t, std::size_t> touched;  // With the last command that names one of its objects.
  for (std::size_t i = 0; i < batch.size(); ++i)
    if (const auto thing = thing_of_.find(scene::node_of(batch[i])); thing != thing_of_.end())
      touched[thing->second] = i;
  std::vector<simulation::OperatorCommand> commands;
  for (const auto& [number, index] : touched) {
    auto show = change_of(number, things_.at(number), store, state);
    if (!show) continue;
    if (const auto may = simulation::may_show(model, state, *show); !may)
      return tl::unexpected(replication::Failure{index, told_name(store, scene::node_of(batch[index])),
                                                 "it cannot be shown there: " + describe(may.error())});
    commands.emplace_back(std::move(*show));
  }
  return commands;
}

std::vector<simulation::OperatorCommand> StandingThings::begin(const scene::Store& store,
                                                               const simulation::Model& model,
                                                               const simulation::State& state,
                                                               std::vector<std::string>& messages) const {
  std::vector<simulation::OperatorCommand> commands;
  for (const auto& [number, thing] : things_) {
    auto show = change_of(number, thing, store, state);
    if (!show) continue;
    if (const auto may = simulation::may_show(model, state, *show); may)
      commands.emplace_back(std::move(*show));
    else
      messages.push_back("not met: " + describe(may.error()));
  }
  return commands;
}

}  // namespace septet::server
