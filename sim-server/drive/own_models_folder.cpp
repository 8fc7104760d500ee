#include "sim-server/drive/own_models_folder.hpp"

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/core/printable.hpp"
#include "engine/scenery/model_size.hpp"
#include "engine/world/vehicle_model.hpp"

namespace septet::server {
namespace {

namespace fs = std::filesystem;

bool is_gltf(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".glb" || extension == ".gltf";
}

/// The glTF files of a folder, in the order of their names.
Expected<std::vector<fs::path>> gltf_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (is_gltf(entry->path())) files.push_back(entry->path());
  if (error)
    return failure(
        fmt::format("the models' folder \"{}\" cannot be read: {}", printable(folder.string()), error.message()),
        "--models", "give a folder with files NAME.glb");
  std::ranges::sort(files);
  return files;
}

std::vector<std::string_view> replaceable_names() {
  std::vector<std::string_view> names;
  for (const VehicleModel& model : vehicle_models()) names.push_back(model.name);
  for (const std::string_view name : scenery::replaceable_things()) names.push_back(name);
  return names;
}

}  // namespace

Expected<OwnModelsFolder> read_own_models(const fs::path& folder) {
  const auto files = gltf_files(folder);
  if (!files) return tl::unexpected(files.error());
  OwnModelsFolder read;
  if (files->empty())
    read.messages.push_back(
        fmt::format("the models' folder \"{}\" has no .glb and no .gltf", printable(folder.string())));
  for (const fs::path& file : *files) {
    const std::string name = file.stem().string(), where = printable(file.string());
    if (!scenery::is_replaceable(name))
      return failure(fmt::format("nothing is called \"{}\"", printable(name, 80)), where,
                     fmt::format("call it {}", fmt::join(replaceable_names(), ", ")));
    if (read.models.contains(name))
      return failure(fmt::format("{} is replaced by two files", name), where, "keep one of .glb and .gltf");
    auto model = scenery::read_own_model(file);
    if (!model) return tl::unexpected(model.error());
    for (const std::string& left_out : model->left_out) read.messages.push_back(fmt::format("{}: {}", where, left_out));
    if (const auto doubt = scenery::doubted_size(*model))
      read.messages.push_back(fmt::format("{}: {}; {}", where, doubt->what, doubt->remedy));
    if (const auto index = find_vehicle_model(name))
      if (const auto differs = scenery::size_differs(*model, vehicle_models()[*index]))
        read.messages.push_back(fmt::format("{}: {}", where, *differs));
    read.models.emplace(name, std::move(*model));
  }
  return read;
}

}  // namespace septet::server
