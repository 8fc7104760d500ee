#include "command-line/command/check_model.hpp"

#include <cstddef>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "engine/core/printable.hpp"
#include "engine/gltf/gltf.hpp"
#include "engine/scenery/model_size.hpp"
#include "engine/scenery/own_models.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::server {
namespace {

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

std::string movement_of(const gltf::Model& model) {
  std::size_t moving = 0;
  float period_s = 0.0f;
  for (const gltf::Part& part : model.parts) {
    if (part.keys.empty() || !part.is_there_at_first()) continue;
    ++moving;
    period_s = part.keys.back().at_s;
  }
  return moving == 0 ? "nothing moves by an animation"
                     : fmt::format("{} parts move by animations, which begin again after {:.2f} s", moving, period_s);
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
  if (const auto doubt = scenery::doubted_size(*model)) warn(doubt->what, doubt->remedy);
  if (const auto index = find_vehicle_model(file.stem().string()))
    if (const auto differs = scenery::size_differs(*model, vehicle_models()[*index]))
      warn(*differs, "give it the size of the catalogue's, or expect collisions beside what is seen");
  checked.found.push_back(scenery::told_size(*model));
  checked.found.push_back(parts_of(*model));
  checked.found.push_back(movement_of(*model));
  checked.found.push_back(materials_of(*model));
  return checked;
}

}  // namespace septet::server
