#include "engine/gltf/passed_over.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"

namespace septet::gltf {
namespace {

constexpr std::array<std::string_view, 5> applied{"KHR_mesh_quantization", "KHR_texture_transform",
                                                  "KHR_materials_emissive_strength", "KHR_materials_transmission",
                                                  "KHR_materials_unlit"};
/// A hostile file names any number of extensions.
constexpr std::size_t most_extensions_told = 20;

std::string extension_name(const Json& extension) {
  return extension.is_string() ? printable(extension.get<std::string>(), 60) : std::string("?");
}

/// "mesh \"car\" (and 2 more)", of the elements of a list of the file's that `is_one` accepts; empty where none is.
std::string those(const Json& file, const char* list, const char* word,
                  const std::function<bool(const Json&)>& is_one) {
  const Json& elements = list_of(file, list);
  std::string first;
  std::size_t count = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!is_one(elements[i]) || count++ > 0) continue;
    const std::string name = printable(text_in(elements[i], "name"), 80);
    first = name.empty() ? fmt::format("{} {}", word, i) : fmt::format("{} \"{}\"", word, name);
  }
  return count < 2 ? first : fmt::format("{} (and {} more)", first, count - 1);
}

bool any_primitive(const Json& mesh, const std::function<bool(const Json&)>& is_one) {
  const Json& primitives = list_of(mesh, "primitives");
  return std::any_of(primitives.begin(), primitives.end(), is_one);
}

}  // namespace

Expected<void> check_required_extensions(const Container& container) {
  for (const Json& extension : list_of(*container.json, "extensionsRequired"))
    if (const std::string name = extension_name(extension); std::ranges::find(applied, name) == applied.end())
      return failure(fmt::format("it requires {}, which is not done", name), container.where,
                     "export it without this extension, or without requiring it");
  return {};
}

std::vector<std::string> passed_over(const Container& container) {
  const Json& file = *container.json;
  std::vector<std::string> sentences;
  for (const Json& extension : list_of(file, "extensionsUsed"))
    if (const std::string name = extension_name(extension);
        sentences.size() < most_extensions_told && std::ranges::find(applied, name) == applied.end())
      sentences.push_back(fmt::format("{} is not done: what it changes is drawn without it", name));
  const auto tell = [&](const std::string& which, const char* what) {
    if (!which.empty()) sentences.push_back(fmt::format("{} {}", which, what));
  };
  const auto meshes_with = [&](const std::function<bool(const Json&)>& is_one) {
    return those(file, "meshes", "mesh", [&](const Json& mesh) { return any_primitive(mesh, is_one); });
  };
  constexpr std::int64_t triangle_list = 4;
  tell(meshes_with([](const Json& primitive) { return index_in(primitive, "mode", triangle_list) < triangle_list; }),
       "has points or lines, which are not drawn");
  tell(those(file, "materials", "material",
             [](const Json& material) {
               const Json& through = extension_in(material, "KHR_materials_transmission");
               return through.is_object() && through.contains("transmissionTexture");
             }),
       "lets light through as a texture says, which is a constant here: its factor");
  tell(those(file, "cameras", "camera", [](const Json&) { return true; }), "is not read");
  const std::int64_t shown = index_in(file, "scene", 0);
  if (const Json& scenes = list_of(file, "scenes"); scenes.size() > 1)
    sentences.push_back(fmt::format("scene {} of {} is read alone", shown, scenes.size()));
  return sentences;
}

}  // namespace septet::gltf
