#include "program/resources.hpp"

#include <cstdlib>
#include <set>

#include <fmt/core.h>

#include "program/child_process.hpp"

namespace septet::program {
namespace fs = std::filesystem;
namespace {

bool is_data_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "rigs", ignored) && fs::is_directory(folder / "scenarios", ignored);
}

/// The file of this extension in a folder: the one named like the folder, else the only one.
fs::path file_in(const fs::path& folder, std::string_view extension) {
  std::error_code ignored;
  fs::path own = folder / (fs::weakly_canonical(folder, ignored).filename().string() + std::string(extension));
  if (fs::is_regular_file(own, ignored)) return own;
  fs::path only;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() != extension) continue;
    if (!only.empty()) return {};
    only = entry.path();
  }
  return only;
}

std::string names_in(const fs::path& folder, std::string_view extension) {
  std::set<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.is_directory(ignored) ? !file_in(entry.path(), extension).empty() : entry.path().extension() == extension)
      names.insert(entry.path().stem().string());
  }
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

Expected<fs::path> data_folder() {
  if (const char* chosen = std::getenv("SEPTET_DATA")) {
    if (is_data_folder(chosen)) return fs::path(chosen);
    return failure("it holds no rigs/ and scenarios/", fmt::format("SEPTET_DATA={}", chosen),
                   "point it at Septet's folder");
  }
  if (const fs::path installed = own_folder().parent_path() / "share/septet"; is_data_folder(installed))
    return installed;
  std::error_code ignored;
  for (const fs::path& start : {own_folder(), fs::current_path(ignored)})
    for (fs::path folder = start; !folder.empty(); folder = folder.parent_path()) {
      if (is_data_folder(folder)) return folder;
      if (folder == folder.root_path()) break;
    }
  return failure("cannot find the folders rigs/ and scenarios/", "data",
                 "run Septet inside its tree or set SEPTET_DATA");
}

Expected<fs::path> find_resource(const std::string& name, std::string_view kind, std::string_view extension) {
  std::error_code ignored;
  if (fs::is_regular_file(name, ignored)) return fs::path(name);
  if (fs::is_directory(name, ignored))
    if (const fs::path file = file_in(name, extension); !file.empty()) return file;
  const auto data = data_folder();
  if (!data) return tl::unexpected(data.error());
  const fs::path place = *data / kind;
  if (name.find('/') == std::string::npos && !name.empty()) {
    if (fs::is_directory(place / name, ignored))
      if (const fs::path file = file_in(place / name, extension); !file.empty()) return file;
    const fs::path file = place / (name + std::string(extension));
    if (fs::is_regular_file(file, ignored)) return file;
  }
  return failure(fmt::format("there is no such {} file", extension), name,
                 fmt::format("give a file, or one of: {}", names_in(place, extension)));
}

}  // namespace septet::program
