#include "sim-server/drive/drive_loader.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/core.h>

#include "engine/core/check.hpp"
#include "engine/core/hash.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/physics/vehicle/read_vehicle.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/scenario/read/scenario_reader.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "engine/simulation/deviation_text.hpp"
#include "engine/simulation/given_motion.hpp"
#include "engine/simulation/lights_stage.hpp"
#include "engine/simulation/walkways_of_drive.hpp"
#include "logging/study/lesson/lesson.hpp"
#include "program/resources.hpp"
#include "sim-server/drive/departing_drive.hpp"
#include "sim-server/drive/traffic_choice.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

/// Reads a file by its role and by the name that another file gives it.
using ReadSource = std::function<Expected<logging::SourceFile>(const std::string& role, const std::string& name)>;

/// The entity that the driver sits in: the one called "ego" or "Ego", else the first vehicle.
scenario::EntityIndex driver_entity(const scenario::Scenario& scenario) {
  for (const char* name : {"ego", "Ego"})
    if (const auto found = scenario::find_entity(scenario, name)) return *found;
  for (std::size_t i = 0; i < scenario.entities.size(); ++i)
    if (scenario.entities[i].kind == scenario::EntityKind::vehicle) return static_cast<scenario::EntityIndex>(i);
  return scenario::no_entity;
}

/// Hash of all files that the simulation depends on, and of the parameters; rig and lesson are left out.
std::uint64_t hash_of(const std::vector<logging::SourceFile>& sources,
                      std::vector<scenario::ParameterValue> parameters) {
  StateHash hash;
  const auto add = [&](const std::string& text) { hash.add_bytes(std::as_bytes(std::span(text))); };
  for (const auto& source : sources) {
    if (source.role == "rig" || source.role == logging::lesson_role) continue;
    add(source.role);
    add(source.content);
  }
  std::ranges::sort(parameters, {}, &scenario::ParameterValue::name);
  for (const auto& parameter : parameters) {
    add(parameter.name);
    add(parameter.value);
  }
  return hash.value();
}

/// `vehicle` replaces the rig's vehicle, unless it is empty. `has_motion`: the car goes by a table.
Expected<LoadedDrive> load(const ReadSource& read, std::uint64_t seed, const std::string& vehicle, bool has_motion,
                           std::vector<scenario::ParameterValue> parameters) {
  LoadedDrive drive;
  auto model = std::make_shared<simulation::Model>();
  model->seed = seed;
  const auto take = [&](const std::string& role, const std::string& name) -> Expected<logging::SourceFile> {
    auto source = read(role, name);
    if (source) drive.sources.push_back(*source);
    return source;
  };

  const auto rig_source = take("rig", "");
  if (!rig_source) return tl::unexpected(rig_source.error());
  auto rig = rig::read_rig(rig_source->content, rig_source->name);
  if (!rig) return tl::unexpected(rig.error());
  drive.rig = std::move(*rig);
  if (!vehicle.empty()) drive.rig.car.vehicle = vehicle;

  const auto scenario_source = take("scenario", "");
  if (!scenario_source) return tl::unexpected(scenario_source.error());
  scenario::ScenarioFiles files;
  files.read = [&](const std::string& path) {
    return take("catalog", path).map([](const auto& source) { return source.content; });
  };
  files.list = [&](const std::string& folder) -> Expected<std::vector<std::string>> {
    return take("catalog-folder", folder).map([](const auto& source) {
      std::vector<std::string> names;
      for (std::size_t begin = 0, end; begin < source.content.size(); begin = end + 1) {
        end = std::min(source.content.find('\n', begin), source.content.size());
        names.push_back(source.content.substr(begin, end - begin));
      }
      return names;
    });
  };
  std::vector<road::Finding> findings;
  auto scenario =
      scenario::read_scenario(scenario_source->content, scenario_source->name, files, &findings, parameters);
  if (!scenario) return tl::unexpected(scenario.error());
  model->scenario = std::move(*scenario);
  model->driver_entity = driver_entity(model->scenario);
  if (model->driver_entity == scenario::no_entity)
    return failure("the scenario has no vehicle to drive", scenario_source->name, "add a ScenarioObject called Ego");

  const auto road_source = take("road", model->scenario.road_file);
  if (!road_source) return tl::unexpected(road_source.error());
  auto roads = road::read_opendrive(road_source->content, road_source->name, &findings);
  if (!roads) return tl::unexpected(roads.error());
  model->roads = std::move(*roads);
  if (const auto buildable = scenery::check_world_size(model->roads); !buildable)
    return failure(buildable.error().what, road_source->name, buildable.error().remedy);
  model->obstacles = std::make_shared<const roadside::Obstacles>(model->roads, seed);
  model->raised = std::make_shared<const roadside::RaisedAreas>(model->roads);
  if (!model->scenario.signals.empty())
    model->lights = simulation::switched_lights(roadside::RoadShape(model->roads, roadside::usual_overrun_m),
                                                model->scenario.signals);
  model->walkways = std::make_shared<const traffic::WalkwayGraph>(
      simulation::walkways_of(model->roads, *model->obstacles, *model->raised, model->lights));
  model->yield_lines = traffic::yield_lines(model->roads);
  if (!model->raised->complete())
    drive.warnings.push_back(road_source->name +
                             ": too many kerbs and islands, or too large ones; the rest is not met");

  const auto car_source = take("vehicle", drive.rig.car.vehicle);
  if (!car_source) return tl::unexpected(car_source.error());
  auto car = vehicle::read_vehicle(car_source->content, car_source->name);
  if (!car) return tl::unexpected(car.error());
  model->car = *car;
  if (has_motion) {
    const auto motion_source = take(std::string(motion_role), "");
    if (!motion_source) return tl::unexpected(motion_source.error());
    auto motion = simulation::read_motion(motion_source->content, motion_source->name);
    if (!motion) return tl::unexpected(motion.error());
    model->motion = std::make_shared<const simulation::GivenMotion>(std::move(*motion));
  }
  for (const auto& finding : findings) drive.warnings.push_back(describe(finding.error));
  model->sources_hash = hash_of(drive.sources, parameters);
  drive.model = std::move(model);
  drive.parameters = std::move(parameters);
  return drive;
}

Expected<logging::SourceFile> from_disk(const std::string& role, const fs::path& path) {
  return read_regular_file(path).map([&](std::string text) {
    return logging::SourceFile{role, path.string(), std::move(text)};
  });
}

}  // namespace

const std::string& LoadedDrive::source(std::string_view role) const {
  const auto found = std::ranges::find(sources, role, &logging::SourceFile::role);
  SEPTET_CHECK(found != sources.end(), "a drive without {}", role);
  return found->content;
}

std::string LoadedDrive::vehicle_name() const {
  const auto found = std::ranges::find(sources, "vehicle", &logging::SourceFile::role);
  return found == sources.end() ? "" : fs::path(found->name).stem().string();
}

namespace {

/// Adds the lesson, NAME.lesson.toml beside the scenario NAME.xosc, if there is one.
Expected<void> add_lesson(const fs::path& scenario, LoadedDrive& drive) {
  const fs::path path = fs::path(scenario).replace_extension(".lesson.toml");
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  auto source = from_disk(std::string(logging::lesson_role), path);
  if (!source) return tl::unexpected(source.error());
  if (const auto lesson = logging::read_lesson(source->content, source->name); !lesson)
    return tl::unexpected(lesson.error());
  drive.sources.push_back(std::move(*source));
  return {};
}

}  // namespace

Expected<LoadedDrive> load_drive(const DriveFiles& files) {
  const fs::path scenario_folder = fs::path(files.scenario).parent_path();
  auto drive = load(
      [&](const std::string& role, const std::string& name) -> Expected<logging::SourceFile> {
        if (role == "rig") return from_disk(role, files.rig);
        if (role == "scenario") return from_disk(role, files.scenario);
        if (role == motion_role) return from_disk(role, files.motion);
        if (role == "vehicle")
          return program::find_resource(name, "vehicles", ".toml").and_then([&](const fs::path& path) {
            return from_disk(role, path);
          });
        if (role == "catalog-folder") {
          const auto names = scenario::files_in(scenario_folder.string()).list(name);
          if (!names) return tl::unexpected(names.error());
          std::string text;
          for (const auto& entry : *names) text += (text.empty() ? "" : "\n") + entry;
          return logging::SourceFile{role, name, text};
        }
        if (role == "catalog")
          return scenario::files_in(scenario_folder.string()).read(name).map([&](std::string text) {
            return logging::SourceFile{role, name, std::move(text)};
          });
        return from_disk(role, scenario_folder / name);
      },
      files.seed, files.vehicle, !files.motion.empty(), files.parameters);
  if (!drive) return drive;
  if (auto added = add_lesson(files.scenario, *drive); !added) return tl::unexpected(added.error());
  return drive;
}

Expected<LoadedDrive> load_drive(const logging::SessionInfo& session, const std::string& where) {
  constexpr auto altered = "it was altered, or written by another version of Septet: use an unaltered copy";
  const auto seed = session.seeds.find("drive");
  std::vector<scenario::ParameterValue> parameters;
  for (const auto& [name, value] : session.parameters) parameters.push_back({name, value});
  if (const auto traffic = session.other.find("traffic"); traffic != session.other.end())
    if (const auto known = check_traffic(traffic->second); !known) return failure(known.error().what, where, altered);
  auto drive = load(
      [&](const std::string& role, const std::string& name) -> Expected<logging::SourceFile> {
        for (const auto& source : session.files)
          if (source.role == role && (!role.starts_with("catalog") || source.name == name)) return source;
        return failure(fmt::format("the session holds no {}{}{}", role, name.empty() ? "" : " ", name), where, altered);
      },
      seed == session.seeds.end() ? 1 : seed->second, {},
      std::ranges::count(session.files, motion_role, &logging::SourceFile::role) > 0, std::move(parameters));
  // Names the session first: the fault is in its copy of a file, and the file of that name on disk may be right.
  if (!drive && !drive.error().where.starts_with(where))
    return failure(drive.error().what, fmt::format("{}, its file {}", where, drive.error().where), altered);
  if (!drive) return drive;
  const auto departs = session.other.find(motion_deviation_row);
  if (departs == session.other.end()) return drive;
  const auto deviation = simulation::read_deviation(departs->second, where);
  if (!deviation) return failure(deviation.error().what, where, altered);
  if (!drive->model->motion) return failure("it departs from a table that it does not hold", where, altered);
  return departing_drive(std::move(*drive), *deviation);
}

}  // namespace septet::server
