#include "engine/editor/paints.hpp"

#include <cstddef>
#include <set>
#include <variant>

namespace septet::editor {
namespace {

using namespace scene;

/// More than a server undoes batches of one author, and few enough to look through with each line.
constexpr std::size_t most_paints_gone = 512;

using WornLink = std::pair<NodeId, PartId>;

/// What objects link to, but for links that get another target.
std::set<NodeId> targets_in(const Store& store, const std::set<WornLink>& but) {
  std::set<NodeId> targets;
  for (const auto& [id, node] : store.nodes())
    if (const auto* object = std::get_if<ObjectData>(&node.data))
      for (const auto& [link_id, link] : object->links)
        if (!but.contains({id, link_id})) targets.insert(link.target);
  return targets;
}

/// Of these pictures those that other materials than `gone` show.
std::set<NodeId> shown_still(const Store& store, const std::set<NodeId>& pictures, const std::set<NodeId>& gone) {
  std::set<NodeId> shown;
  for (const auto& [id, node] : store.nodes()) {
    const auto* material = std::get_if<MaterialData>(&node.data);
    if (!material || gone.contains(id)) continue;
    for (const auto& [fragment_id, fragment] : material->fragments)
      if (const auto* texture = std::get_if<TextureFragment>(&fragment))
        if (pictures.contains(texture->bitmap)) shown.insert(texture->bitmap);
  }
  return shown;
}

}  // namespace

void learn_paints(Paints& paints, std::span<const Command> commands) {
  NodeId picture = no_node;
  for (const Command& command : commands)
    if (const auto* create = std::get_if<NodeCreate>(&command)) {
      if (create->type == NodeType::bitmap) picture = create->node;
      if (create->type == NodeType::material) paints.pictures[create->node] = picture;
    }
}

void learn_worn(Paints& paints, const Command& command) {
  if (const auto* link = std::get_if<LinkSet>(&command); link && link->value.label == "material")
    paints.worn[{link->node, link->link}] = link->value.target;
}

std::vector<Command> take_place(Paints& paints, const Store& store, std::span<const Command> line) {
  std::set<WornLink> links;
  std::set<NodeId> replaced;
  for (const Command& command : line)
    if (const auto* link = std::get_if<LinkSet>(&command)) {
      const WornLink at{link->node, link->link};
      links.insert(at);
      if (const auto before = paints.worn.find(at); before != paints.worn.end()) replaced.insert(before->second);
    }
  for (const Command& command : line) learn_worn(paints, command);
  learn_paints(paints, line);
  std::set<NodeId> used = targets_in(store, links);
  for (const auto& [at, material] : paints.worn) used.insert(material);
  std::set<NodeId> materials, pictures;
  for (const auto& [material, picture] : paints.pictures) {
    if (used.contains(material) || !(store.find(material) || replaced.contains(material))) continue;
    materials.insert(material);
    if (picture != no_node) pictures.insert(picture);
  }
  const std::set<NodeId> kept = pictures.empty() ? pictures : shown_still(store, pictures, materials);
  std::vector<Command> commands;
  commands.reserve(materials.size() + pictures.size());
  for (const NodeId material : materials) commands.emplace_back(NodeDestroy{material});
  for (const NodeId picture : pictures)
    if (!kept.contains(picture)) commands.emplace_back(NodeDestroy{picture});
  if (paints.pictures.size() > most_paints_gone)
    std::erase_if(paints.pictures,
                  [&](const auto& paint) { return !store.find(paint.first) && !used.contains(paint.first); });
  return commands;
}

}  // namespace septet::editor
