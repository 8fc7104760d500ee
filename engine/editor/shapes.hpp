#pragma once
/// Things that an editor makes, as commands: models from files, boards, and what is painted on them.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/image/image.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"

namespace septet::editor {

/// Commands that make nodes with the ids from `first` on.
struct Made {
  std::vector<scene::Command> commands;
  scene::NodeId next = 0;               ///< First id that is still free.
  std::vector<std::string> messages{};  ///< Of a file: its size by axes, and what is left out.
};

/// An object of that name, below which the file's parts lie. Error: as of read_gltf, or a file that cannot be read.
Expected<Made> make_model(const std::string& name, const std::filesystem::path& file, const scene::Transform& transform,
                          scene::NodeId first);
/// A board that stands upright, its middle at the object's origin; it is seen from both sides and reads from +x.
Made make_board(const std::string& name, double width_m, double height_m, const scene::Transform& transform,
                scene::NodeId first);
/// A material with this picture in the place of the first of the object and what is below it, or of this colour in the
/// place of all: `object` may be one that the store has not yet, then it is a board.
Made make_picture(const scene::Store& store, scene::NodeId object, const image::Image& picture, scene::NodeId first);
Made make_colour(const scene::Store& store, scene::NodeId object, glm::vec3 linear_rgb, scene::NodeId first);

/// Text, as large as fits, on a picture of 256 lines.
Expected<image::Image> painted_text(const std::string& text, image::Color ink, image::Color ground);

}  // namespace septet::editor
