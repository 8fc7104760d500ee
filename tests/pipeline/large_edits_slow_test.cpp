#include <cstdint>

#include "engine/core/random.hpp"
#include "engine/image/png.hpp"
#include "tests/pipeline/editing_rig.hpp"

namespace septet::pipeline {

TEST_CASE("a program's editor takes a picture of more bytes than a batch holds") {
  EditedDrive drive;
  Random random(3);
  image::Image noise(1024, 1024);
  for (std::uint8_t& byte : noise.rgba) byte = static_cast<std::uint8_t>(random.below(256));
  const fs::path file = drive.folder / "noise.png";
  REQUIRE(image::write_png(file, noise).has_value());
  const auto editor = connect_editor(drive.lab);
  const auto taken = editor->take({"board lab/noise 2 2 20 0 1", "picture lab/noise " + file.string()});
  if (!taken) FAIL(describe(taken.error()));
  CHECK(taken->tick > 0);
  CHECK(editor->scene().find(scene::NodeType::object, "lab/noise") != nullptr);
}

}  // namespace septet::pipeline
