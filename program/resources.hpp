#pragma once
/// Places of Septet's data: rigs, scenarios and vehicles, by file name or by short name.

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/expected.hpp"

namespace septet::program {

/// The root of the tree of data: SEPTET_DATA; else, of an installed program, `../share/septet`; else the nearest folder
/// above the program (or the working folder) that holds `rigs/` and `scenarios/`.
Expected<std::filesystem::path> data_folder();

/// A rig, scenario or vehicle: the file itself; a folder that holds one file of that extension; or a name below the
/// data folder's `kind` ("rigs", "scenarios", "vehicles"). The error lists the existing names.
Expected<std::filesystem::path> find_resource(const std::string& name, std::string_view kind,
                                              std::string_view extension);

}  // namespace septet::program
