#include "sim-server/drive/stock_things.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "engine/scene/command_text.hpp"
#include "engine/scene/drawn_object.hpp"
#include "engine/scene/solid_box.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::server {
namespace {

constexpr std::size_t most_looks_of_kind = 24;
constexpr std::array<std::string_view, 12> single_things{
    "tree",       "building", "town building", "town house", "street lamp", "street furniture",
    "parked car", "sign",     "gantry",        "pole",       "object",      "traffic light"};

void add_vehicles(const scene::Store& generated, std::vector<page::StockThing>& stock) {
  for (const VehicleModel& model : vehicle_models()) {
    const std::string name(model.name);
    const scene::Node* node = generated.find(scene::NodeType::object, std::string(scene::prototype_prefix) + name);
    if (!node) continue;
    stock.push_back({model.kind == ParticipantKind::pedestrian ? "person" : "vehicle", name,
                     scene::word_of({generated}, node->id), model.length_m, model.width_m});
  }
}

/// The shape's name; the object's kind where it says no more.
std::string name_of_look(const scene::Store& generated, const scene::DrawnObject& drawn, std::string_view kind) {
  const scene::Node* geometry = generated.find(drawn.geometry);
  return geometry && !geometry->name.empty() ? geometry->name : std::string(kind);
}

}  // namespace

std::string_view kind_of_object(std::string_view name) { return name.substr(0, name.find('/')); }

bool is_single_thing(std::string_view kind) { return std::ranges::find(single_things, kind) != single_things.end(); }

std::vector<page::StockThing> stock_things(const scene::Store& generated) {
  std::vector<page::StockThing> stock;
  add_vehicles(generated, stock);
  std::set<std::pair<scene::NodeId, scene::FaceMaterials>> seen;
  std::map<std::string, std::size_t, std::less<>> looks;
  std::map<std::pair<std::string, std::string>, int> called;
  for (const auto& [id, node] : generated.nodes()) {
    if (node.type() != scene::NodeType::object) continue;
    const std::string kind(kind_of_object(node.name));
    if (!is_single_thing(kind) || looks[kind] >= most_looks_of_kind) continue;
    const scene::DrawnObject drawn = scene::read_object(node);
    if (drawn.geometry == scene::no_node || !seen.emplace(drawn.geometry, drawn.materials).second) continue;
    const auto read = scene::read_solid(generated, id);
    if (!read || !read->box) continue;
    ++looks[kind];
    std::string name = name_of_look(generated, drawn, kind);
    if (const int number = ++called[{kind, name}]; number > 1) name += fmt::format(" {}", number);
    stock.push_back({kind, std::move(name), scene::word_of({generated}, id), read->box->size_m.x, read->box->size_m.y});
  }
  std::ranges::stable_sort(stock, {}, [](const page::StockThing& thing) { return std::tie(thing.kind, thing.name); });
  return stock;
}

}  // namespace septet::server
