// Rigs, film scripts and vehicles of any bytes; cameras follow the path of accepted shots.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "engine/document/toml_table.hpp"
#include "engine/film_script/film_script.hpp"
#include "engine/physics/vehicle/read_vehicle.hpp"
#include "engine/rig/rig.hpp"
#include "sim-client/film/camera_path.hpp"

namespace {

/// An error is a message that names its place; a refused text has no other effect.
template <class Value>
void check_refusal(const septet::Expected<Value>& read) {
  if (!read && (read.error().what.empty() || !read.error().where.starts_with("fuzz.toml"))) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace septet;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check_refusal(document::top_keys_of_toml(text, "fuzz.toml"));
  const auto rig = rig::read_rig(text, "fuzz.toml");
  check_refusal(rig);
  if (rig) {
    rig::driving_screens(*rig);
    rig::point_ahead(*rig, rig::screen_ahead(*rig));
  }
  const auto script = film::read_script(text, "fuzz.toml");
  check_refusal(script);
  if (script)
    for (const film::Shot& shot : script->shots)
      if ((shot.to_s - shot.from_s) / shot.speed < 1000.0)
        if (const auto path = film::camera_path(shot, 25.0))
          for (const film::Look& look : *path)
            if (!(glm::length(look.direction()) < 1.001)) std::abort();
  check_refusal(vehicle::read_vehicle(text, "fuzz.toml"));
  return 0;
}
