#include "engine/gltf/extras.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"

namespace septet::gltf {
namespace {

constexpr std::size_t most_extras = 64, most_text_bytes = 1000, most_name_bytes = 60, most_properties_told = 20;

std::optional<double> finite(const Json& json) {
  if (!json.is_number()) return std::nullopt;
  const auto number = json.get<double>();
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<ExtraValue> value_of(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (const auto number = finite(json)) return *number;
  if (json.is_string() && json.get_ref<const std::string&>().size() <= most_text_bytes) return json.get<std::string>();
  if (!json.is_array() || json.size() != 3) return std::nullopt;
  const auto x = finite(json[0]), y = finite(json[1]), z = finite(json[2]);
  if (!x || !y || !z) return std::nullopt;
  return glm::dvec3(*x, *y, *z);
}

}  // namespace

void add_extras(const Json& node, std::vector<Extra>& extras, std::vector<std::string>& left_out) {
  if (!node.is_object() || !node.contains("extras") || !node["extras"].is_object()) return;
  for (const auto& [key, json] : node["extras"].items()) {
    const std::string name = printable(key, most_name_bytes);
    if (std::ranges::find(extras, name, &Extra::name) != extras.end()) continue;
    const auto value = value_of(json);
    if (value && extras.size() < most_extras) {
      extras.push_back({name, *value});
      continue;
    }
    const std::string sentence =
        value ? fmt::format("there are more than {} properties (extras): the rest is not read", most_extras)
              : fmt::format("the property \"{}\" (extras) is no truth, number, short text or list of three numbers",
                            name);
    if (left_out.size() < most_properties_told && std::ranges::find(left_out, sentence) == left_out.end())
      left_out.push_back(sentence);
  }
}

}  // namespace septet::gltf
