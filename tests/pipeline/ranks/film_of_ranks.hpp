#pragma once
/// A small traced film, by one program and by several that mpirun starts.

#include <csignal>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/effects/ice/ice_keyframe.hpp"
#include "engine/geometry/shapes.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/command_codec.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {

/// mpirun needs permission to run as root, as the gate does.
inline const std::map<std::string, std::string> for_mpirun{{"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                                                           {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"}};

/// Matt ground at the driver's car's starting place, and icicles above it, which throw light on it.
inline void record_ground(logging::SessionWriter& writer) {
  scene::Store store;
  scene::SceneBuilder builder(store, [&](const scene::Command& command) {
    Bytes bytes;
    scene::encode(command, bytes);
    writer.record(logging::SceneEdit{0, std::move(bytes)});
  });
  scene::ObjectParameters ground;
  ground.geometry = builder.add_mesh("ground", geometry::box({80.0f, -20.0f, -0.5f}, {120.0f, 20.0f, 0.0f}));
  ground.materials.push_back(builder.add_material("earth", {.roughness = 1.0f}));
  builder.add_object("ground", ground);
}
inline EffectKeyframe icicles() {
  ice::StillIce still;
  for (const double y_m : {-1.5, 0.0, 1.5}) still.rows.push_back({{98.0, y_m, 1.2}, {102.0, y_m, 1.2}, 0.8, 3});
  return {ice::effect_id, ice::keyframe_kind, ice::encode(still), 0};
}

struct SmallFilm {
  const TemporaryFolder folder;
  std::string samples = "6", size = "152x104";

  explicit SmallFilm(bool with_ice = false) {
    auto writer = logging::must_create(folder / "session.sqlite");
    if (with_ice) record_ground(writer);
    for (Tick tick = 0; tick <= 60; ++tick) {
      Snapshot snapshot = logging::drive_snapshot(tick);
      if (with_ice) snapshot.effects.push_back(icicles());
      writer.record(logging::taken(snapshot));
    }
    REQUIRE(writer.finish().has_value());
    write_text(folder / "shots.toml", "[[shot]]\nfrom_s = 0\nto_s = 0.08\ndistance_m = 6\npitch_deg = -20\n");
  }
  std::vector<std::string> arguments(const fs::path& out, const std::vector<std::string>& more) const {
    std::vector<std::string> all{(folder / "session.sqlite").string(),
                                 "--shots",
                                 (folder / "shots.toml").string(),
                                 "--out",
                                 out.string(),
                                 "--size",
                                 size,
                                 "--renderer",
                                 "traced",
                                 "--samples",
                                 samples,
                                 "--fps",
                                 "25"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  program::ChildProcess begin(const fs::path& out, const std::vector<std::string>& more) const {
    return start("septet-film", arguments(out, more), log(out), for_mpirun);
  }
  Ended make(const fs::path& out, const std::vector<std::string>& more = {}) const {
    fs::remove(log(out));
    return run("septet-film", arguments(out, more), log(out), for_mpirun);
  }
  fs::path log(const fs::path& out) const { return folder / (out.filename().string() + ".err"); }
};

/// The pictures of a film's folder by name; it holds nothing else but its record.
inline std::map<std::string, std::string> pictures_in(const fs::path& folder) {
  std::map<std::string, std::string> pictures;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    if (name == "film.json") continue;
    CHECK_MESSAGE(name.extension() == ".png", name.string());
    pictures[name.string()] = text_of(entry.path());
  }
  return pictures;
}

/// True if tiles of a frame are kept there.
inline bool has_tiles(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".tiles" && entry.file_size(error) > 0 && !error) return true;
  return false;
}

/// Processes whose parent is this one.
inline std::vector<int> children_of(int parent) {
  std::vector<int> children;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string id = entry.path().filename();
    if (id.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string stat = text_of(entry.path() / "stat");
    const auto after_name = stat.rfind(") ");
    if (after_name != std::string::npos && std::atoi(stat.c_str() + after_name + 4) == parent)
      children.push_back(std::stoi(id));
  }
  return children;
}

/// mpirun below the program that starts it; empty: not there.
inline std::optional<int> mpirun_of(int launcher) {
  for (const int child : children_of(launcher))
    if (text_of(fmt::format("/proc/{}/comm", child)) == "mpirun\n") return child;
  return std::nullopt;
}
/// The program of this number below mpirun.
inline std::optional<int> rank_of(int mpirun, int number) {
  const std::string wanted = fmt::format("OMPI_COMM_WORLD_RANK={}", number) + '\0';
  for (const int child : children_of(mpirun))
    if (text_of(fmt::format("/proc/{}/environ", child)).find(wanted) != std::string::npos) return child;
  return std::nullopt;
}

}  // namespace septet::pipeline
