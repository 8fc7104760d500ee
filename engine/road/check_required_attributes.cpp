#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "engine/road/rule_checks.hpp"

namespace septet::road {
namespace {

/// Attributes required by all schemas of 1.5 to 1.8, except those that the reader requires already; the schema of 1.4
/// requires none. A line's parent tells those of marks from those of the plan.
struct Required {
  std::string_view parent, element, attributes;
};
constexpr std::string_view cubic = "a b c d";
constexpr std::array<Required, 24> required{{
    {"header", "offset", "x y z hdg"},
    {"road", "type", "s type"},
    {"elevationProfile", "elevation", cubic},
    {"lateralProfile", "superelevation", cubic},
    {"lateralProfile", "shape", cubic},
    {"lanes", "laneOffset", cubic},
    {"lane", "width", cubic},
    {"lane", "border", cubic},
    {"lane", "height", "sOffset inner outer"},
    {"lane", "speed", "sOffset max"},
    {"lane", "material", "sOffset friction"},
    {"lane", "access", "sOffset"},
    {"lane", "rule", "sOffset value"},
    {"lane", "roadMark", "sOffset type color"},
    {"type", "line", "length space sOffset tOffset"},
    {"explicit", "line", "length sOffset tOffset"},
    {"geometry", "paramPoly3", "pRange"},
    {"objects", "object", "id zOffset"},
    {"object", "repeat", "s length distance tStart tEnd heightStart heightEnd zOffsetStart zOffsetEnd"},
    {"objects", "bridge", "id length type"},
    {"objects", "tunnel", "id length type"},
    {"outline", "cornerRoad", "dz height"},
    {"outline", "cornerLocal", "z height"},
    {"signals", "signal", "id dynamic orientation type subtype"},
}};

void check(const CheckedFile& file, const pugi::xml_node& node, std::string_view attributes) {
  while (!attributes.empty()) {
    const auto end = std::min(attributes.find(' '), attributes.size());
    const std::string name(attributes.substr(0, end));
    attributes.remove_prefix(std::min(end + 1, attributes.size()));
    if (node.attribute(name.c_str())) continue;
    file.findings.warning(node, fmt::format("attribute {} is missing", name), fmt::format("add {}=\"…\"", name),
                          "asam.net:xodr:1.0.0:xml.valid_schema");
  }
}

class Walker : public pugi::xml_tree_walker {
 public:
  explicit Walker(const CheckedFile& file) : file_(file) {}

  bool for_each(pugi::xml_node& node) override {
    if (node.type() != pugi::node_element) return true;
    const std::string_view element = node.name(), parent = node.parent().name();
    for (const Required& one : required)
      if (one.element == element && one.parent == parent) check(file_, node, one.attributes);
    return true;
  }

 private:
  const CheckedFile& file_;
};

}  // namespace

void check_required_attributes(const CheckedFile& file) {
  if (!file.is_at_least(5)) return;
  Walker walker(file);
  pugi::xml_node root = file.root;
  root.traverse(walker);
}

}  // namespace septet::road
