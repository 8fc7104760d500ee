#include "engine/editor/edit_verbs.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/core.h>
#include <glm/gtc/quaternion.hpp>

#include "engine/editor/shapes.hpp"
#include "engine/editor/shown_pose.hpp"
#include "engine/gltf/gltf.hpp"
#include "engine/image/png.hpp"
#include "engine/image/srgb.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/command_validation.hpp"
#include "engine/scene/participant_root.hpp"
#include "engine/scene/solid_box.hpp"

namespace septet::editor {
namespace {

using namespace scene;
using Words = std::span<const TextWord>;

constexpr std::size_t most_name_bytes = 200;
constexpr double longest_lifetime_s = 1e6;

tl::unexpected<Error> wrong(const std::string& what, std::string_view usage) {
  return failure(what, fmt::format("the line {}", usage), "septet edit --help and docs/editing.md show the lines");
}

std::optional<std::vector<double>> numbers(Words words) {
  std::vector<double> read;
  read.reserve(words.size());
  for (const TextWord& word : words) {
    double number = 0.0;
    const char* end = word.text.data() + word.text.size();
    const auto [stop, error] = std::from_chars(word.text.data(), end, number);
    if (error != std::errc() || stop != end || !std::isfinite(number)) return std::nullopt;
    read.push_back(number);
  }
  return read;
}

Quat turned(double heading_deg) { return glm::angleAxis(heading_deg * std::numbers::pi / 180.0, Vec3(0, 0, 1)); }

/// Bitmaps that a material reads, by its fragments and by its tags.
void add_bitmaps_read(const Command& command, std::set<NodeId>& bitmaps) {
  if (const auto* fragment = std::get_if<FragmentSet>(&command)) {
    if (const auto* texture = std::get_if<TextureFragment>(&fragment->value)) bitmaps.insert(texture->bitmap);
  } else if (const auto* tag = std::get_if<TagSet>(&command)) {
    if (const auto* bitmap = std::get_if<NodeReference>(&tag->value.value)) bitmaps.insert(bitmap->node);
  }
}

/// This editor's own bitmaps that materials read of which each is among the `gone`.
std::set<NodeId> bitmaps_left_over(const std::set<NodeId>& gone, const Store& store, NodeId own_ids,
                                   std::span<const Command> batch) {
  std::set<NodeId> read_by_gone, read_by_others;
  const auto read_by = [&](NodeId node) -> std::set<NodeId>& {
    return gone.contains(node) ? read_by_gone : read_by_others;
  };
  for (auto node = store.nodes().lower_bound(own_ids);
       node != store.nodes().end() && node->first - own_ids < replication::ids_per_session; ++node)
    if (node->second.type() == NodeType::material)
      describe_node(node->second, [&](const Command& command) { add_bitmaps_read(command, read_by(node->first)); });
  for (const Command& command : batch) add_bitmaps_read(command, read_by(scene::node_of(command)));
  std::erase_if(read_by_gone, [&](NodeId bitmap) {
    return read_by_others.contains(bitmap) || bitmap - own_ids >= replication::ids_per_session;
  });
  return read_by_gone;
}

}  // namespace

std::vector<Command> removal_of(NodeId thing, const Store& store, NodeId own_ids, std::span<const Command> batch) {
  std::vector<const LinkSet*> to_come;
  for (const Command& command : batch)
    if (const auto* link = std::get_if<LinkSet>(&command)) to_come.push_back(link);
  std::set<NodeId> gone{thing};
  std::vector<NodeId> next{thing};
  const auto reach = [&](NodeId target) {
    if (target - own_ids < replication::ids_per_session && gone.insert(target).second) next.push_back(target);
  };
  while (!next.empty()) {
    const NodeId id = next.back();
    next.pop_back();
    const Node* node = store.find(id);
    if (const auto* data = node ? std::get_if<ObjectData>(&node->data) : nullptr)
      for (const auto& [link_id, link] : data->links) reach(link.target);
    for (const LinkSet* link : to_come)
      if (link->node == id) reach(link->value.target);
  }
  gone.merge(bitmaps_left_over(gone, store, own_ids, batch));
  std::vector<Command> commands;
  commands.reserve(gone.size());
  for (const NodeId each : gone) commands.emplace_back(NodeDestroy{each});
  return commands;
}

std::optional<Transform> transform_of(Words words) {
  const auto read = numbers(words);
  if (!read || !(read->empty() || read->size() == 3 || read->size() == 4)) return std::nullopt;
  Transform transform;
  if (!read->empty()) transform.position_m = {(*read)[0], (*read)[1], (*read)[2]};
  if (read->size() == 4) transform.rotation = turned((*read)[3]);
  return transform;
}

namespace {

/// Of X Y Z, a rotation w x y z and a scale x y z; empty: other words.
std::optional<Transform> whole_transform_of(Words words) {
  const auto read = numbers(words);
  if (!read || read->size() != 10) return std::nullopt;
  const auto& n = *read;
  return Transform{{n[0], n[1], n[2]},
                   {n[3], n[4], n[5], n[6]},
                   {static_cast<float>(n[7]), static_cast<float>(n[8]), static_cast<float>(n[9])}};
}

/// A leg of `go`; a later one begins with its time after the first one's beginning.
std::optional<MotionLeg> leg_of(Words words, bool is_later) {
  const auto given = numbers(words);
  const std::size_t first = is_later ? 1 : 0;
  if (!given || (given->size() != first + 3 && given->size() != first + 6 && given->size() != first + 7))
    return std::nullopt;
  const auto vector = [&](std::size_t at) {
    return at + 2 < given->size() ? Vec3((*given)[at], (*given)[at + 1], (*given)[at + 2]) : Vec3(0.0);
  };
  MotionLeg leg{.velocity_mps = vector(first), .acceleration_mps2 = vector(first + 3)};
  if (is_later) leg.from_s = given->front();
  if (given->size() == first + 7) leg.turn_radps.z = given->back() * std::numbers::pi / 180.0;
  return leg;
}

/// Of three numbers as in pictures.
glm::vec3 linear_rgb(std::span<const double> srgb) {
  const auto light = [&](std::size_t i) { return static_cast<float>(image::light_of_srgb(srgb[i])); };
  return {light(0), light(1), light(2)};
}

/// Three parts of a colour, each from 0 to 1; empty: other words.
std::optional<std::vector<double>> colour_of(Words words) {
  auto read = words.size() == 3 ? numbers(words) : std::nullopt;
  if (!read || std::ranges::any_of(*read, [](double part) { return part < 0.0 || part > 1.0; })) return std::nullopt;
  return read;
}

class Verbs {
 public:
  Verbs(const Store& store, EditNames& names) : store_(store), names_(names) {}

  Expected<EditedLine> line(const std::vector<TextWord>& words) {
    const std::string& verb = words.front().text;
    const Words rest = std::span(words).subspan(1);
    if (verb == "create") return create(rest);
    if (verb == "move") return move(rest);
    if (verb == "go") return go(rest);
    if (verb == "hide" || verb == "show") return hide(rest, verb == "hide");
    if (verb == "remove") return remove(rest);
    if (verb == "import") return import_model(rest);
    if (verb == "like") return like(rest);
    if (verb == "board") return board(rest);
    if (verb == "picture") return picture(rest);
    if (verb == "text") return text(rest);
    if (verb == "color") return color(rest);
    if (verb == "hang") return hang(rest);
    if (verb == "solid") return solid(rest);
    if (verb == "repaint") return repaint(rest);
    auto command = command_from_words(words, {store_, names_.own_ids, nullptr, &names_.fresh});
    if (!command) return tl::unexpected(command.error());
    learn(*command);
    return EditedLine{{std::move(*command)}};
  }

 private:
  void learn(const MotionSet& set) {
    if (set.motion.legs.empty())
      names_.going.erase(set.node);
    else
      names_.going.insert(set.node);
  }
  std::optional<NodeId> object(const TextWord& word) const {
    const auto id = node_of({store_, names_.own_ids, nullptr, &names_.fresh}, word);
    return id && *id != no_node ? id : std::nullopt;
  }
  static tl::unexpected<Error> no_node_called(const TextWord& word) {
    return wrong(fmt::format("there is no node {:.80}", word.text), "names a node");
  }
  /// Ids that are used are not free, and names of objects are known at once.
  void learn(const Command& command) {
    learn_worn(names_.paints, command);
    if (const auto* motion = std::get_if<MotionSet>(&command)) return learn(*motion);
    if (const auto* create = std::get_if<NodeCreate>(&command)) {
      if (create->node >= names_.next && create->node - names_.own_ids < replication::ids_per_session)
        names_.next = create->node + 1;
      if (create->type == NodeType::object) names_.objects.insert(create->node);
    } else if (const auto* named = std::get_if<NodeNameSet>(&command)) {
      const Node* node = store_.find(named->node);
      if (names_.objects.contains(named->node) || (node && node->type() == NodeType::object))
        names_.fresh[named->name] = named->node;
    }
  }
  Expected<NodeId> free_ids(std::string_view name) const {
    if (name.size() > most_name_bytes)
      return wrong(fmt::format("a name of {} bytes", name.size()),
                   fmt::format("NAME, at most {} bytes", most_name_bytes));
    if (is_free(names_.next)) return names_.next;
    // An editor that has gone through its ids begins anew, behind things that are there still.
    const NodeId anew = std::max(names_.own_ids, names_.kept_to);
    if (is_free(anew)) return anew;
    const auto& nodes = store_.nodes();
    for (auto node = nodes.lower_bound(anew);
         node != nodes.end() && node->first - names_.own_ids < replication::ids_per_session; ++node)
      if (is_free(node->first + 1)) return node->first + 1;
    return failure("this editor has used all its ids", "septet edit", "remove things, or connect again");
  }
  /// True if far more ids than any one line makes are free from this one on.
  bool is_free(NodeId first) const {
    constexpr NodeId most_of_a_line = 2048;
    if (first - names_.own_ids > replication::ids_per_session - most_of_a_line) return false;
    const auto taken = store_.nodes().lower_bound(first);
    return taken == store_.nodes().end() || taken->first - first >= most_of_a_line;
  }
  EditedLine keep(Made made) {
    for (const Command& command : made.commands) learn(command);
    names_.next = made.next;
    return {std::move(made.commands), std::move(made.messages)};
  }
  /// What the things wore before goes, where nobody wears it.
  EditedLine keep_paint(Made made) {
    const std::vector<Command> left_over = take_place(names_.paints, store_, made.commands);
    made.commands.insert(made.commands.end(), left_over.begin(), left_over.end());
    return keep(std::move(made));
  }
  /// The same name again replaces.
  EditedLine keep_in_place_of(const TextWord& name, Made made) {
    const auto before = object({name.text, true});
    EditedLine line;
    if (before) line.commands = removal(*before);
    EditedLine kept = keep(std::move(made));
    line.commands.insert(line.commands.end(), std::make_move_iterator(kept.commands.begin()),
                         std::make_move_iterator(kept.commands.end()));
    line.messages = std::move(kept.messages);
    return line;
  }
  std::vector<Command> removal(NodeId object) {
    std::vector<Command> commands = removal_of(object, store_, names_.own_ids, {});
    forget_destroyed(names_, commands);
    return commands;
  }

  Expected<EditedLine> create(Words words) {
    constexpr std::string_view usage = "create NAME [X Y Z [HEADING_DEG]]";
    if (words.empty()) return wrong("a name is missing", usage);
    const auto transform = transform_of(words.subspan(1));
    if (!transform) return wrong("a place is three or four numbers", usage);
    const auto id = free_ids(words[0].text);
    if (!id) return tl::unexpected(id.error());
    return keep_in_place_of(
        words[0],
        {{NodeCreate{*id, NodeType::object}, NodeNameSet{*id, words[0].text}, TransformSet{*id, *transform}}, *id + 1});
  }
  Expected<EditedLine> move(Words words) {
    constexpr std::string_view usage = "move NODE X Y Z [HEADING_DEG], or X Y Z QW QX QY QZ SCALE_X SCALE_Y SCALE_Z";
    if (words.size() < 4) return wrong("a node and its place are needed", usage);
    const auto id = object(words[0]);
    if (!id) return no_node_called(words[0]);
    const auto whole = whole_transform_of(words.subspan(1));
    auto transform = whole ? whole : transform_of(words.subspan(1));
    if (!transform) return wrong("a place is three or four numbers, or ten", usage);
    const Node* node = store_.find(*id);
    const auto* now = node ? std::get_if<ObjectData>(&node->data) : nullptr;
    if (now && !whole) {
      transform->scale = now->transform.scale;
      if (words.size() == 4) transform->rotation = now->transform.rotation;
    }
    EditedLine line{{TransformSet{*id, *transform}}};
    // Whose line ever set it in motion; one of this editor's may not be in the mirror yet.
    const bool was_sent_going = names_.going.erase(*id) > 0;
    if (was_sent_going || (now && !now->motion.legs.empty())) line.commands.emplace_back(MotionSet{*id, {}});
    return line;
  }
  Expected<EditedLine> go(Words words) {
    constexpr std::string_view usage = "go NODE VX VY VZ [AX AY AZ [TURN_DEGPS]] [then AFTER_S VX VY VZ …]";
    if (words.empty()) return wrong("a node is missing", usage);
    const auto id = object(words[0]);
    if (!id) return no_node_called(words[0]);
    MotionSet motion{*id, {}, true};
    for (Words rest = words.subspan(1);;) {
      const auto then = std::ranges::find(rest, "then", &TextWord::text);
      const auto leg = leg_of(rest.first(static_cast<std::size_t>(then - rest.begin())), !motion.motion.legs.empty());
      if (!leg) return wrong("a velocity is three numbers, an acceleration three more, a turn one more", usage);
      motion.motion.legs.push_back(*leg);
      if (then == rest.end()) {
        learn(motion);
        return EditedLine{{std::move(motion)}};
      }
      rest = rest.subspan(static_cast<std::size_t>(then - rest.begin()) + 1);
    }
  }
  Expected<EditedLine> hide(Words words, bool hidden) {
    if (words.size() != 1) return wrong("one node is needed", hidden ? "hide NODE" : "show NODE");
    if (const auto id = object(words[0])) return EditedLine{{HideSet{*id, hidden}}};
    // A participant, who has a root once something was said of it.
    const auto number = participant(words[0]);
    if (!number) return no_node_called(words[0]);
    const auto first = free_ids("");
    if (!first) return tl::unexpected(first.error());
    Made made{{}, *first};
    const NodeId root = root_of(*number, made);
    made.commands.emplace_back(HideSet{root, hidden});
    return keep(std::move(made));
  }
  Expected<EditedLine> remove(Words words) {
    if (words.size() != 1) return wrong("one node is needed", "remove NODE");
    const auto id = object(words[0]);
    if (!id) return no_node_called(words[0]);
    return EditedLine{removal(*id)};
  }
  Expected<EditedLine> import_model(Words words) {
    constexpr std::string_view usage = "import NAME FILE.glb [X Y Z [HEADING_DEG]]";
    if (words.size() < 2) return wrong("a name and a file are needed", usage);
    const auto transform = transform_of(words.subspan(2));
    if (!transform) return wrong("a place is three or four numbers", usage);
    const auto first = free_ids(words[0].text);
    if (!first) return tl::unexpected(first.error());
    auto made = make_model(words[0].text, words[1].text, *transform, *first);
    if (!made) return tl::unexpected(made.error());
    return keep_in_place_of(words[0], std::move(*made));
  }
  /// The same shapes and children, not copies of them: both change with these.
  Expected<EditedLine> like(Words words) {
    constexpr std::string_view usage = "like NAME NODE [X Y Z [HEADING_DEG]]";
    if (words.size() < 2) return wrong("a name and an object are needed", usage);
    const auto transform = transform_of(words.subspan(2));
    if (!transform) return wrong("a place is three or four numbers", usage);
    const auto pattern = object(words[1]);
    const Node* node = pattern ? store_.find(*pattern) : nullptr;
    const auto* seen = node ? std::get_if<ObjectData>(&node->data) : nullptr;
    if (!seen) return wrong(fmt::format("there is no object {:.80}", words[1].text), usage);
    const auto first = free_ids(words[0].text);
    if (!first) return tl::unexpected(first.error());
    Transform placed = *transform;
    placed.scale = seen->transform.scale;
    Made made{{NodeCreate{*first, NodeType::object}, NodeNameSet{*first, words[0].text}, TransformSet{*first, placed}},
              *first + 1};
    for (const auto& [id, link] : seen->links) made.commands.emplace_back(LinkSet{*first, id, link});
    for (const auto& [id, group] : node->tag_groups) {
      if (group.name == solid_group || group.name == participant_tag_group) continue;
      made.commands.emplace_back(TagGroupSet{*first, id, group.name});
      for (const auto& [tag, value] : group.tags) made.commands.emplace_back(TagSet{*first, id, tag, value});
    }
    return keep_in_place_of(words[0], std::move(made));
  }
  Expected<EditedLine> board(Words words) {
    constexpr std::string_view usage = "board NAME WIDTH_M HEIGHT_M [X Y Z [HEADING_DEG]]";
    if (words.size() < 3) return wrong("a name, a width and a height are needed", usage);
    const auto size = numbers(words.subspan(1, 2));
    const auto transform = transform_of(words.subspan(3));
    const auto is_size = [](double m) { return m >= 0.001 && m <= 1000.0; };
    if (!size || !transform || !is_size((*size)[0]) || !is_size((*size)[1]))
      return wrong("width and height are metres from 0.001 to 1000, a place is three or four numbers", usage);
    const auto first = free_ids(words[0].text);
    if (!first) return tl::unexpected(first.error());
    Made made = make_board(words[0].text, (*size)[0], (*size)[1], *transform, *first);
    learn_paints(names_.paints, made.commands);
    return keep_in_place_of(words[0], std::move(made));
  }
  Expected<EditedLine> wear(const TextWord& node, const image::Image& shown) {
    const auto id = object(node);
    if (!id) return no_node_called(node);
    const auto first = free_ids("");
    if (!first) return tl::unexpected(first.error());
    return keep_paint(make_picture(store_, *id, shown, *first));
  }
  Expected<EditedLine> picture(Words words) {
    if (words.size() != 2) return wrong("a node and a file are needed", "picture NODE FILE.png");
    const auto shown = image::read_png(words[1].text);
    if (!shown) return tl::unexpected(shown.error());
    if (shown->width > gltf::largest_picture_px || shown->height > gltf::largest_picture_px)
      return wrong(fmt::format("the picture has more than {} pixels a side", gltf::largest_picture_px),
                   "picture NODE FILE.png");
    return wear(words[0], *shown);
  }
  Expected<EditedLine> text(Words words) {
    if (words.size() != 2 || words[1].text.size() > 500)
      return wrong("a node and a text are needed", "text NODE \"TEXT\"");
    const auto painted = painted_text(words[1].text, {0, 0, 0}, {255, 255, 255});
    if (!painted) return tl::unexpected(painted.error());
    return wear(words[0], *painted);
  }
  Expected<EditedLine> color(Words words) {
    constexpr std::string_view usage = "color NODE RED GREEN BLUE, each from 0 to 1, as in pictures (sRGB)";
    const auto rgb = words.empty() ? std::nullopt : colour_of(words.subspan(1));
    if (!rgb) return wrong("a node and three numbers from 0 to 1 are needed", usage);
    const auto id = object(words[0]);
    if (!id) return no_node_called(words[0]);
    const auto first = free_ids("");
    if (!first) return tl::unexpected(first.error());
    return keep_paint(make_colour(store_, *id, linear_rgb(*rgb), *first));
  }

  /// What hangs on a participant, and its paint, are of this root's; made by `made` where it is not there yet.
  NodeId root_of(std::uint32_t number, Made& made) const {
    const std::string root = std::string(prototype_prefix) + participant_prototype(number);
    if (const auto known = object({root, true})) return *known;
    const NodeId id = made.next++;
    made.commands = {NodeCreate{id, NodeType::object}, NodeNameSet{id, root}};
    return id;
  }
  /// A number, or a name of the scenario's.
  std::optional<std::uint32_t> participant(const TextWord& word) const {
    if (const auto number = numbers(std::span(&word, 1))) {
      if (!(number->front() >= 0.0 && number->front() <= 4e9)) return std::nullopt;
      return static_cast<std::uint32_t>(std::nearbyint(number->front()));
    }
    for (const auto& [name, number] : participant_names(store_))
      if (name == word.text) return number;
    return std::nullopt;
  }

  /// A link of each thing's own, by its id; on another object from the last one down, as its own parts have the first.
  Expected<EditedLine> hang(Words words) {
    constexpr std::string_view usage =
        "hang NODE PARENT, a node of this editor's own, and a participant's number or name, or another object";
    const auto number = words.size() == 2 ? participant(words[1]) : std::nullopt;
    const auto id = words.empty() ? std::nullopt : object(words[0]);
    const auto other = words.size() == 2 && !number ? object(words[1]) : std::nullopt;
    if (!(number || other) || !id || *id - names_.own_ids >= replication::ids_per_session || other == id)
      return wrong("a thing and what it hangs on are needed", usage);
    const auto first = free_ids("");
    if (!first) return tl::unexpected(first.error());
    Made made{{}, *first};
    const NodeId parent = number ? root_of(*number, made) : *other;
    const auto place = static_cast<PartId>(*id - names_.own_ids);
    const auto link = number ? place : static_cast<PartId>(replication::ids_per_session - 1 - place);
    made.commands.emplace_back(LinkSet{parent, link, {"child", *id, 0}});
    return keep(std::move(made));
  }
  /// Ids of the group and the tags by which a node is solid: those that it has, else a group that models and paint leave
  /// free.
  struct SolidIds {
    PartId group = 0xFF00, solid = 0, mass = 1;
    bool has_mass = false;
  };
  /// Null: a node that is still to come.
  static SolidIds solid_ids(const Node* node) {
    SolidIds ids;
    const auto named = [](std::string_view name) {
      return [name](const auto& entry) { return entry.second.name == name; };
    };
    if (!node) return ids;
    const auto group = std::ranges::find_if(node->tag_groups, named(solid_group));
    if (group == node->tag_groups.end()) return ids;
    const std::map<PartId, Tag>& tags = group->second.tags;
    ids.group = group->first;
    const auto solid = std::ranges::find_if(tags, named(solid_tag)), mass = std::ranges::find_if(tags, named(mass_tag));
    ids.solid = solid == tags.end() ? free_tag(tags, 0) : solid->first;
    ids.has_mass = mass != tags.end();
    ids.mass = ids.has_mass ? mass->first : free_tag(tags, static_cast<PartId>(ids.solid + 1));
    return ids;
  }
  static PartId free_tag(const std::map<PartId, Tag>& tags, PartId from) {
    while (tags.contains(from)) ++from;
    return from;
  }
  Expected<EditedLine> solid(Words words) {
    constexpr std::string_view usage = "solid NODE [off | KG]";
    const bool off = words.size() == 2 && words[1].text == "off";
    const auto mass_kg = words.size() == 2 && !off ? numbers(words.subspan(1)) : std::nullopt;
    if (words.empty() || (words.size() != 1 && !off && !mass_kg))
      return wrong("one node is needed, and off or a mass in kg at most", usage);
    const auto id = object(words[0]);
    if (!id) return no_node_called(words[0]);
    const SolidIds ids = solid_ids(store_.find(*id));
    EditedLine line{{TagGroupSet{*id, ids.group, std::string(solid_group)},
                     TagSet{*id, ids.group, ids.solid, {std::string(solid_tag), !off}}}};
    if (mass_kg)
      line.commands.emplace_back(TagSet{*id, ids.group, ids.mass, {std::string(mass_tag), mass_kg->front()}});
    else if (ids.has_mass && !off)
      line.commands.emplace_back(TagDestroy{*id, ids.group, ids.mass});
    return line;
  }
  Expected<EditedLine> repaint(Words words) {
    constexpr std::string_view usage = "repaint PARTICIPANT RED GREEN BLUE, each from 0 to 1, as in pictures (sRGB)";
    const auto number = words.empty() ? std::nullopt : participant(words[0]);
    const auto rgb = words.empty() ? std::nullopt : colour_of(words.subspan(1));
    if (!number || !rgb) return wrong("a participant's number or name and three numbers from 0 to 1 are needed", usage);
    const auto first = free_ids("");
    if (!first) return tl::unexpected(first.error());
    Made made{{}, *first};
    const NodeId root = root_of(*number, made);
    made.commands.emplace_back(TagGroupSet{root, 0, "draw"});
    made.commands.emplace_back(TagSet{root, 0, 0, {"paint", Vec3(linear_rgb(*rgb))}});
    return keep(std::move(made));
  }

  const Store& store_;
  EditNames& names_;
};

/// Matches names with * and ?.
bool matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, after = 0;
  while (n < name.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n]) && pattern[p] != '*')
      ++p, ++n;
    else if (p < pattern.size() && pattern[p] == '*')
      star = p++, after = n;
    else if (star != std::string_view::npos)
      p = star + 1, n = ++after;
    else
      return false;
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace

Expected<EditedLine> edit_of(const std::vector<TextWord>& words, const Store& store, EditNames& names) {
  auto line = Verbs(store, names).line(words);
  if (!line) return line;
  for (const Command& command : line->commands)  // A server ends the connection of who sends what is out of range.
    if (auto valid = validate(command); !valid) return tl::unexpected(valid.error());
  return line;
}

Expected<Lifetime> lifetime_of(const std::vector<TextWord>& words, const Store& store, const EditNames& names) {
  constexpr std::string_view usage = "lifetime NODE SECONDS, a node of this editor's own and more than 0 seconds";
  const auto seconds = words.size() == 3 ? numbers(std::span(words).last(1)) : std::nullopt;
  if (!seconds || !(seconds->front() > 0.0 && seconds->front() <= longest_lifetime_s))
    return wrong("a thing and how long it is there are needed", usage);
  const auto id = node_of({store, names.own_ids, nullptr, &names.fresh}, words[1]);
  if (!id || *id - names.own_ids >= replication::ids_per_session)
    return wrong(fmt::format("{:.80} is not of this editor's own", words[1].text), usage);
  return Lifetime{words[1].text, *id, seconds->front()};
}

void forget_destroyed(EditNames& names, std::span<const Command> batch) {
  for (const Command& command : batch)
    if (const auto* destroy = std::get_if<NodeDestroy>(&command)) {
      std::erase_if(names.fresh, [&](const auto& entry) { return entry.second == destroy->node; });
      names.going.erase(destroy->node);
    }
}

Expected<std::vector<NodeId>> found_nodes(const std::vector<TextWord>& words, const Store& store, const Snapshot& now) {
  constexpr std::string_view usage = "find [NAME] [type TYPE] [tag GROUP.TAG] [near X Y METRES]";
  constexpr std::array types{"object", "geometry", "material", "bitmap"};
  std::string_view pattern = "*", type, group, tag;
  std::optional<std::vector<double>> near;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string& word = words[i].text;
    const std::size_t left = words.size() - i - 1;
    if (word == "type" && left >= 1) {
      type = words[++i].text;
    } else if (word == "tag" && left >= 1 && words[i + 1].text.find('.') != std::string::npos) {
      const std::string_view both = words[++i].text;
      group = both.substr(0, both.find('.')), tag = both.substr(both.find('.') + 1);
    } else if (word == "near" && left >= 3) {
      near = numbers(std::span(words).subspan(i + 1, 3));
      if (!near) return wrong("near is two coordinates and a distance", usage);
      i += 3;
    } else if (i == 1) {
      pattern = word;
    } else {
      return wrong(fmt::format("{:.80} is not understood", word), usage);
    }
  }
  std::vector<NodeId> found;
  for (const auto& [id, node] : store.nodes()) {
    const auto* object = std::get_if<ObjectData>(&node.data);
    if (type.empty() ? !object : type != types[static_cast<std::size_t>(node.type())]) continue;
    if (!matches(pattern, node.name) || (!group.empty() && !find_tag(node, group, tag))) continue;
    if (near && !object) continue;
    if (near) {
      const Vec3 at_m = shown_pose(node, now).position_m;
      if (std::hypot(at_m.x - (*near)[0], at_m.y - (*near)[1]) > (*near)[2]) continue;
    }
    found.push_back(id);
    if (found.size() > most_nodes_found) break;
  }
  return found;
}

}  // namespace septet::editor
