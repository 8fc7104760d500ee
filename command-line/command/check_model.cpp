#include "command-line/command/check_model.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "engine/core/printable.hpp"
#include "engine/gltf/gltf.hpp"
#include "engine/scenery/own_models.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::server {
namespace {

/// The factor to metres that a size hints at: nothing on a road is longer than a hundred metres or smaller than a
/// hand's breadth.
std::optional<double> likely_scale(double longest_m) {
  constexpr double centimetres = 0.01, millimetres = 0.001, most_m = 100.0, least_m = 0.05;
  if (longest_m > 10.0 * most_m) return millimetres;
  if (longest_m > most_m) return centimetres;
  if (longest_m < least_m) return 1.0 / centimetres;
  return std::nullopt;
}

std::string parts_of(const gltf::Model& model) {
  std::map<std::string, int> counts;
  for (const gltf::Part& part : model.parts)
    if (!part.name.empty()) ++counts[printable(part.name.substr(0, part.name.find('.')), 80)];
  if (counts.empty()) return "no part moves or shines on its own";
  std::string text;
  for (const auto& [name, count] : counts)
    text += (text.empty() ? "" : ", ") + (count > 1 ? fmt::format("{} × {}", count, name) : name);
  return "parts that move or shine: " + text;
}

std::string materials_of(const gltf::Model& model) {
  std::string names;
  // The last look is the reader's own.
  for (std::size_t i = 0; i + 1 < model.looks.size(); ++i)
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", model.looks[i].name);
  return fmt::format("materials: {}; {} pictures", names.empty() ? "none" : names, model.pictures.size());
}

}  // namespace

CheckedModel check_model(const std::filesystem::path& file) {
  CheckedModel checked;
  const std::string where = printable(file.string());
  const auto warn = [&](const std::string& what, const char* remedy) {
    checked.findings.push_back({road::Severity::warning, 0, {what, where, remedy}});
  };
  const auto model = scenery::read_own_model(file);
  if (!model) {
    checked.findings.push_back({road::Severity::error, 0, model.error()});
    return checked;
  }
  for (const std::string& passed_over : model->left_out)
    warn(passed_over, "expect it to be drawn so, or change it in a modelling program");
  const glm::vec3 size_m = model->most_m - model->least_m;
  const double longest_m = std::max({size_m.x, size_m.y, size_m.z});
  if (const auto scale = likely_scale(longest_m))
    warn(fmt::format("its longest side is {:.3g} m, as if its lengths were no metres", longest_m),
         *scale > 1.0    ? "scale it by 100, if it is too small"
         : *scale < 0.01 ? "scale it by 0.001, if its lengths are millimetres"
                         : "scale it by 0.01, if its lengths are centimetres");
  if (const auto index = find_vehicle_model(file.stem().string()))
    if (const auto differs = scenery::size_differs(*model, vehicle_models()[*index]))
      warn(*differs, "give it the size of the catalogue's, or expect collisions beside what is seen");
  std::size_t triangles = 0;
  for (const gltf::Part& part : model->parts) triangles += part.mesh.polygons.size();
  checked.found.push_back(fmt::format(
      "{} triangles; {:.2f} m long (glTF's z, forward), {:.2f} m wide (x, left), {:.2f} m high (y, up), from {:.2f} m "
      "above its origin on",
      triangles, size_m.x, size_m.y, size_m.z, model->least_m.z));
  checked.found.push_back(parts_of(*model));
  checked.found.push_back(materials_of(*model));
  return checked;
}

}  // namespace septet::server
