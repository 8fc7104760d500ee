// From an edit of the store to a picture that may be drawn: command, resolver, device. The world is a generated motorway,
// once, and ten of them side by side. Counter: the worst single edit, ms.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "engine/render/renderer.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "tests/benchmarks/must_be.hpp"
#include "tests/shipped_files.hpp"

namespace septet::render {
namespace {

using scene::Command;
using scene::NodeId;
using scene::NodeType;
using scene::Store;

/// Adds a copy of every object and geometry, `east_m` further; materials and images are shared.
void add_copy(Store& store, const Store& world, NodeId offset, double east_m) {
  const auto is_copied = [&](NodeId id) {
    const scene::Node* node = world.find(id);
    return node && (node->type() == NodeType::object || node->type() == NodeType::geometry);
  };
  const auto shifted = [&](NodeId id) { return is_copied(id) ? id + offset : id; };
  for (const auto& entry : world.nodes()) {
    if (!is_copied(entry.first)) continue;
    scene::describe_node(entry.second, [&](Command command) {
      std::visit(
          [&](auto& c) {
            if constexpr (requires { c.node; }) c.node = shifted(c.node);
          },
          command);
      if (auto* link = std::get_if<scene::LinkSet>(&command)) link->value.target = shifted(link->value.target);
      if (auto* placed = std::get_if<scene::TransformSet>(&command)) placed->transform.position_m.x += east_m;
      must_be(store.apply(command));
    });
  }
}

const Store& motorways(int times) {
  static std::map<int, Store> worlds;
  const auto [found, added] = worlds.try_emplace(times);
  if (!added) return found->second;
  const auto network =
      must_be(road::read_opendrive(shipped_text("scenarios/motorway-ambulance/motorway.xodr"), "motorway.xodr"));
  scene::SceneBuilder builder(found->second);
  scenery::build_road_world(builder, network, 1);
  const Store once = found->second;
  const NodeId offset = once.nodes().rbegin()->first;
  for (int i = 1; i < times; ++i) add_copy(found->second, once, offset * static_cast<NodeId>(i), 12e3 * i);
  return found->second;
}

/// Objects that have their geometry alone, or in common with another.
std::vector<NodeId> objects_with_geometry(const Store& store, bool alone) {
  std::map<NodeId, std::vector<NodeId>> users;
  for (const auto& [id, node] : store.nodes())
    if (const auto* object = std::get_if<scene::ObjectData>(&node.data))
      for (const auto& [part, link] : object->links)
        if (link.label == "geometry") users[link.target].push_back(id);
  std::vector<NodeId> objects;
  for (const auto& [geometry, by] : users)
    if ((by.size() == 1) == alone) objects.push_back(by.front());
  return objects;
}

using Edit = std::function<Command(int)>;

scene::TransformSet moved(const Store& store, NodeId id, double metres) {
  scene::Transform transform = std::get<scene::ObjectData>(store.find(id)->data).transform;
  transform.position_m.z += metres;
  return {id, transform};
}

Edit edit_named(const Store& store, std::string_view name) {
  const auto cycle = [](const std::vector<NodeId>& ids, int n) {
    return ids[static_cast<std::size_t>(n) % ids.size()];
  };
  if (name == "move")
    return
        [&store, cycle, ids = objects_with_geometry(store, false)](int n) { return moved(store, cycle(ids, n), 0.1); };
  if (name == "move_alone")
    return
        [&store, cycle, ids = objects_with_geometry(store, true)](int n) { return moved(store, cycle(ids, n), 0.1); };
  if (name == "hide")
    return [cycle, ids = objects_with_geometry(store, false)](int n) {
      return scene::HideSet{cycle(ids, n / 2), n % 2 == 0};
    };
  if (name == "unseen_tag")
    return [cycle, ids = objects_with_geometry(store, false)](int n) {
      return scene::TagGroupSet{cycle(ids, n), 60000, "lab"};
    };
  if (name == "colour")
    for (const auto& [id, node] : store.nodes())
      if (const auto* material = std::get_if<scene::MaterialData>(&node.data))
        for (const auto& [fragment, value] : material->fragments)
          if (std::holds_alternative<scene::ColorFragment>(value))
            return [id = id, fragment = fragment](int n) {
              return scene::FragmentSet{id, fragment,
                                        scene::ColorFragment{{0.01f * static_cast<float>(n % 100), 0.3f, 0.4f}}};
            };
  if (name == "tile") {
    NodeId largest = scene::no_node;
    std::size_t tiles = 0;
    for (const auto& [id, node] : store.nodes())
      if (const auto* bitmap = std::get_if<scene::BitmapData>(&node.data))
        if (!scene::find_layer(*bitmap, "alpha") && scene::tile_count(bitmap->width, bitmap->height, 1) > tiles)
          largest = id, tiles = scene::tile_count(bitmap->width, bitmap->height, 1);
    if (tiles > 0)
      return [largest, tiles](int n) {
        return scene::BitmapTilesSet{largest, 0, static_cast<std::uint32_t>(static_cast<std::size_t>(7 * n) % tiles),
                                     std::vector<std::uint8_t>(64, static_cast<std::uint8_t>(40 * n))};
      };
  }
  throw std::runtime_error("no such edit: " + std::string(name));
}

double ms_of(const std::function<void()>& work) {
  const auto begun = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
}

Renderer small_renderer() { return must_be(Renderer::create({64, 64, DevicePreference::software})); }

void edit_to_picture(benchmark::State& state, std::string_view name, int times) {
  Store store = motorways(times);
  scene::Resolver resolver;
  resolver.update(store);
  Renderer renderer = small_renderer();
  must_be(renderer.upload(resolver.scene()));
  const Edit edit = edit_named(store, name);
  int n = 0;
  double worst_ms = 0.0, resolve_ms = 0.0;
  for (auto unused : state) {
    const Command command = edit(n++);
    const double ms = ms_of([&] {
      must_be(store.apply(command));
      resolve_ms += ms_of([&] { resolver.update(store); });
      must_be(renderer.upload(resolver.scene()));
    });
    state.SetIterationTime(1e-3 * ms);
    worst_ms = std::max(worst_ms, ms);
  }
  state.counters["worst_ms"] = worst_ms;
  state.counters["resolve_ms"] = resolve_ms / n;
  state.counters["instances"] = static_cast<double>(resolver.scene().instances.size());
}

/// Fifty objects move each tick, every other one alone with its mesh; each screen resolves and uploads for itself.
void fifty_moves(benchmark::State& state, int times) {
  constexpr std::size_t screens = 7, moves = 50;
  struct Screen {
    scene::Resolver resolver;
    std::unique_ptr<Renderer> renderer = std::make_unique<Renderer>(small_renderer());
  };
  Store store = motorways(times);
  std::vector<Screen> all(screens);
  for (Screen& screen : all) {
    screen.resolver.update(store);
    must_be(screen.renderer->upload(screen.resolver.scene()));
  }
  const Edit shared = edit_named(store, "move"), alone = edit_named(store, "move_alone");
  double worst_ms = 0.0;
  for (auto unused : state) {
    for (std::size_t i = 0; i < moves; ++i)
      must_be(store.apply((i % 2 == 0 ? shared : alone)(static_cast<int>(i / 2))));
    double tick_ms = 0.0;
    for (Screen& screen : all) {
      const double ms = ms_of([&] {
        screen.resolver.update(store);
        must_be(screen.renderer->upload(screen.resolver.scene()));
      });
      tick_ms = std::max(tick_ms, ms);
    }
    worst_ms = std::max(worst_ms, tick_ms);
    state.SetIterationTime(1e-3 * tick_ms);
  }
  state.counters["worst_ms"] = worst_ms;
}

void many_edits(benchmark::internal::Benchmark* edits) {
  edits->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(100);
}

#define EDIT_TO_PICTURE(EDIT)                                                                                  \
  BENCHMARK_CAPTURE(edit_to_picture, EDIT, #EDIT, 1)->Name("scene/edit_to_picture/" #EDIT)->Apply(many_edits); \
  BENCHMARK_CAPTURE(edit_to_picture, EDIT##_of_ten, #EDIT, 10)                                                 \
      ->Name("scene/edit_to_picture/" #EDIT "_of_ten_worlds")                                                  \
      ->Apply(many_edits)
EDIT_TO_PICTURE(move);
EDIT_TO_PICTURE(move_alone);
EDIT_TO_PICTURE(hide);
EDIT_TO_PICTURE(unseen_tag);
EDIT_TO_PICTURE(colour);
EDIT_TO_PICTURE(tile);
#undef EDIT_TO_PICTURE
BENCHMARK_CAPTURE(fifty_moves, once, 1)->Name("scene/fifty_moves_to_seven_pictures")->Apply(many_edits);

}  // namespace
}  // namespace septet::render
