#include "engine/scene/command.hpp"

namespace septet::scene {
namespace {

constexpr std::array<std::string_view, std::variant_size_v<Command>> command_names = {
    "node index subscribe", "node subscribe",     "part subscribe",
    "node create",          "node destroy",       "node name set",
    "tag group set",        "tag group destroy",  "tag set",
    "tag destroy",          "transform set",      "link set",
    "link destroy",         "light set",          "hide set",
    "geometry size set",    "geometry layer set", "geometry layer destroy",
    "vertices set",         "polygons set",       "layer integers set",
    "layer reals set",      "crease set",         "fragment set",
    "fragment destroy",     "bitmap size set",    "bitmap layer set",
    "bitmap layer destroy", "bitmap tiles set"};

/// The opcode of T, or of the "set" of the object that T destroys.
template <class T>
std::uint64_t kind_of() {
  using Kind = std::conditional_t<
      std::is_same_v<T, NodeDestroy>, NodeCreate,
      std::conditional_t<
          std::is_same_v<T, TagGroupDestroy>, TagGroupSet,
          std::conditional_t<
              std::is_same_v<T, TagDestroy>, TagSet,
              std::conditional_t<
                  std::is_same_v<T, LinkDestroy>, LinkSet,
                  std::conditional_t<std::is_same_v<T, GeometryLayerDestroy>, GeometryLayerSet,
                                     std::conditional_t<std::is_same_v<T, FragmentDestroy>, FragmentSet,
                                                        std::conditional_t<std::is_same_v<T, BitmapLayerDestroy>,
                                                                           BitmapLayerSet, T>>>>>>>;
  return Command(Kind{}).index();
}

std::uint64_t range(std::uint64_t first, std::uint64_t count) { return first << 32 | count; }

}  // namespace

CommandAddress address_of(const Command& command) {
  return std::visit(
      [](const auto& c) {
        using T = std::decay_t<decltype(c)>;
        CommandAddress address{kind_of<T>() << 56, 0};
        if constexpr (requires { c.node; }) address.high |= std::uint64_t{c.node} << 16;
        if constexpr (requires { c.group; }) address.high |= c.group;
        if constexpr (requires { c.link; }) address.high |= c.link;
        if constexpr (requires { c.layer; }) address.high |= c.layer;
        if constexpr (requires { c.fragment; }) address.high |= c.fragment;
        if constexpr (requires { c.tag; }) address.low = c.tag;
        if constexpr (std::is_same_v<T, PartSubscribe>) {
          address.high |= c.part;
          address.low = static_cast<std::uint64_t>(c.kind);
        }
        if constexpr (std::is_same_v<T, CreaseSet>) address.low = static_cast<std::uint64_t>(c.kind);
        if constexpr (std::is_same_v<T, VerticesSet>) address.low = range(c.first, c.positions_m.size());
        if constexpr (std::is_same_v<T, PolygonsSet>) address.low = range(c.first, c.polygons.size());
        if constexpr (std::is_same_v<T, LayerIntegersSet> || std::is_same_v<T, LayerRealsSet>)
          address.low = range(c.first, c.values.size());
        if constexpr (std::is_same_v<T, BitmapTilesSet>) address.low = range(c.first_tile, c.tiles.size());
        return address;
      },
      command);
}

std::string_view name_of(const Command& command) { return command_names[command.index()]; }

}  // namespace septet::scene
