#include "engine/scene/command.hpp"

namespace septet::scene {
namespace {

constexpr std::array<std::string_view, std::variant_size_v<Command>> command_names = {"node index subscribe",
                                                                                      "node subscribe",
                                                                                      "part subscribe",
                                                                                      "node create",
                                                                                      "node destroy",
                                                                                      "node name set",
                                                                                      "tag group set",
                                                                                      "tag group destroy",
                                                                                      "tag set",
                                                                                      "tag destroy",
                                                                                      "transform set",
                                                                                      "link set",
                                                                                      "link destroy",
                                                                                      "hide set",
                                                                                      "geometry size set",
                                                                                      "geometry layer set",
                                                                                      "geometry layer destroy",
                                                                                      "vertices set",
                                                                                      "polygons set",
                                                                                      "layer integers set",
                                                                                      "layer reals set",
                                                                                      "crease set",
                                                                                      "fragment set",
                                                                                      "fragment destroy",
                                                                                      "bitmap size set",
                                                                                      "bitmap layer set",
                                                                                      "bitmap layer destroy",
                                                                                      "bitmap tiles set",
                                                                                      "motion set"};

}  // namespace

std::string_view name_of(const Command& command) { return command_names[command.index()]; }

}  // namespace septet::scene
