#pragma once
/// Application of each command to the store. Every function checks everything first and only then makes changes.

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "engine/scene/command_validation.hpp"
#include "engine/scene/content_weight.hpp"
#include "engine/scene/store.hpp"

namespace septet::scene {

/// Application of one command.
struct Store::Application {
  Store& store;
  const Command& command;

  tl::unexpected<Error> no(std::string what, std::string remedy) const {
    return refuse(command, std::move(what), std::move(remedy));
  }
  Expected<Node*> node(NodeId id) const {
    const auto found = store.nodes_.find(id);
    if (found == store.nodes_.end()) return no("there is no such node", "create the node first");
    return &found->second;
  }
  template <class Data>
  Expected<std::pair<Node*, Data*>> node_with(NodeId id) const {
    auto found = node(id);
    if (!found) return tl::unexpected(found.error());
    Data* data = std::get_if<Data>(&(*found)->data);
    if (!data) return no("the node is of another type", "name a node of the command's type");
    return std::pair{*found, data};
  }
  /// Replaces `before` in the account by `after`, or refuses.
  Expected<void> charge(std::uint64_t before, std::uint64_t after) const {
    const std::uint64_t total = store.content_bytes_ - before + after;
    if (after > before && total > store.limits_.bytes)
      return no(fmt::format("the store would hold {} bytes of {}", total, store.limits_.bytes),
                "destroy content or raise StoreLimits::bytes");
    store.content_bytes_ = total;
    return {};
  }
  /// Gives the node the next revision. `drawn`: a picture may show the change.
  std::uint64_t touch(Node& changed, bool drawn = true) const {
    changed.revision = ++store.revision_;
    if (drawn) changed.drawn_revision = changed.revision;
    store.changes_.add(changed.revision, {changed.id, 0, 0, 0});
    return changed.revision;
  }

  /// Sets one entry of a map of parts.
  template <class Key, class Part>
  Expected<void> set_part(Node& owner, std::map<Key, Part>& parts, Key id, const Part& value, bool drawn = true) const {
    const auto found = parts.find(id);
    if (auto ok = charge(found == parts.end() ? 0 : weight(found->second), weight(value)); !ok) return ok;
    if (found == parts.end())
      parts.emplace(id, value);
    else
      found->second = value;
    touch(owner, drawn);
    return {};
  }
  /// Destroys a part; false where it does not exist.
  template <class Key, class Part>
  bool destroy_part(Node& owner, std::map<Key, Part>& parts, Key id, bool drawn = true) const {
    const auto found = parts.find(id);
    if (found == parts.end()) return false;
    store.content_bytes_ -= weight(found->second);
    parts.erase(found);
    touch(owner, drawn);
    return true;
  }

  /// Finds the object and applies `change` to it.
  template <class Change>
  Expected<void> with_object(NodeId id, Change change) const {
    const auto object = node_with<ObjectData>(id);
    if (!object) return tl::unexpected(object.error());
    change(*object->second);
    touch(*object->first);
    return {};
  }
  /// Copies a run into an array that must contain it; `first` and the run count single values.
  template <class T>
  Expected<void> copy_run(const std::vector<T>& run, std::uint64_t first, std::vector<T>& into) const {
    if (first > into.size() || run.size() > into.size() - first)
      return no(fmt::format("values {} to {} of {}", first, first + run.size(), into.size()),
                "set the size first and stay within it");
    std::copy(run.begin(), run.end(), into.begin() + static_cast<std::ptrdiff_t>(first));
    return {};
  }
  template <class Run, class T>
  Expected<void> set_layer_run(const Run& c, std::vector<T> GeometryLayer::*values, bool real) const {
    const auto found = node_with<GeometryData>(c.node);
    if (!found) return tl::unexpected(found.error());
    const auto layer = found->second->layers.find(c.layer);
    if (layer == found->second->layers.end() || is_real_layer(layer->second.type) != real)
      return no("there is no such layer of this kind", "create the layer first");
    const std::uint32_t width = layer_width(layer->second.type);
    if (c.values.size() % width != 0) return no("a vertex or polygon is incomplete", "send all values of each");
    if (auto ok = copy_run(c.values, std::uint64_t{c.first} * width, layer->second.*values); !ok) return ok;
    layer->second.revision = touch(*found->first);
    return {};
  }

  template <class Subscription>
  requires std::is_same_v<Subscription, NodeIndexSubscribe> || std::is_same_v<Subscription, NodeSubscribe> ||
      std::is_same_v<Subscription, PartSubscribe>
          Expected<void>
  operator()(const Subscription&) const {
    return no("a subscription does not change a store", "hand it to the replication server");
  }
  Expected<void> operator()(const NodeCreate& c) const;
  Expected<void> operator()(const NodeDestroy& c) const;
  Expected<void> operator()(const NodeNameSet& c) const;
  Expected<void> operator()(const TagGroupSet& c) const;
  Expected<void> operator()(const TagGroupDestroy& c) const;
  Expected<void> operator()(const TagSet& c) const;
  Expected<void> operator()(const TagDestroy& c) const;
  Expected<void> operator()(const TransformSet& c) const;
  Expected<void> operator()(const HideSet& c) const;
  Expected<void> operator()(const MotionSet& c) const;
  Expected<void> operator()(const LinkSet& c) const;
  Expected<void> operator()(const LinkDestroy& c) const;
  Expected<void> operator()(const GeometrySizeSet& c) const;
  Expected<void> operator()(const GeometryLayerSet& c) const;
  Expected<void> operator()(const GeometryLayerDestroy& c) const;
  Expected<void> operator()(const VerticesSet& c) const;
  Expected<void> operator()(const PolygonsSet& c) const;
  Expected<void> operator()(const LayerIntegersSet& c) const;
  Expected<void> operator()(const LayerRealsSet& c) const;
  Expected<void> operator()(const CreaseSet& c) const;
  Expected<void> operator()(const FragmentSet& c) const;
  Expected<void> operator()(const FragmentDestroy& c) const;
  Expected<void> operator()(const BitmapSizeSet& c) const;
  Expected<void> operator()(const BitmapLayerSet& c) const;
  Expected<void> operator()(const BitmapLayerDestroy& c) const;
  Expected<void> operator()(const BitmapTilesSet& c) const;
};

}  // namespace septet::scene
