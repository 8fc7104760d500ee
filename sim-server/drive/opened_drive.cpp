#include "sim-server/drive/opened_drive.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/roadside/parked_cars.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scene/edit_file.hpp"
#include "engine/scene/participant_root.hpp"
#include "engine/scenery/vehicles/debris_looks.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "logging/session/recorded_scene.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "sim-server/drive/kept_state.hpp"
#include "sim-server/drive/own_models_folder.hpp"
#include "sim-server/drive/seat/can_seat.hpp"
#include "sim-server/drive/seat/tracked_head.hpp"
#include "sim-server/drive/traffic_choice.hpp"
#include "sim-server/drive/who_is_who.hpp"
#include "sim-server/host/replay_source.hpp"

namespace septet::server {
namespace {

Expected<void> open_replay(const ServerOptions& options, OpenedDrive& drive, program::ProgressLine& line) {
  auto session = logging::SessionReader::open(options.replay);
  if (!session) return tl::unexpected(session.error());
  drive.session.emplace(std::move(*session));
  const auto rig_text = read_regular_file(options.rig);
  if (!rig_text) return tl::unexpected(rig_text.error());
  auto rig = rig::read_rig(*rig_text, options.rig);
  if (!rig) return tl::unexpected(rig.error());
  drive.loaded.rig = std::move(*rig);
  drive.loaded.sources.push_back({"rig", options.rig, *rig_text});
  if (!options.eyes.empty()) {
    auto eyes = logging::find_stay(*drive.session, options.eyes, "--eyes");
    if (!eyes) return tl::unexpected(eyes.error());
    drive.eyes = std::move(*eyes);
  }
  auto scene = logging::RecordedScene::open(*drive.session);
  if (!scene) return tl::unexpected(scene.error());
  drive.recorded_scene.emplace(std::move(*scene));
  if (auto begun = drive.recorded_scene->advance(0, drive.store); !begun) return begun;
  if (drive.store.nodes().empty())
    line.message(printable(options.replay.string()) +
                 ": it keeps no scene, so the screens show sky and instruments, no road and nobody; replay a session "
                 "that septet drive recorded");
  auto source = ReplaySource::start(*drive.session, options.replay_from_s);
  if (!source) return tl::unexpected(source.error());
  drive.source = std::move(*source);
  return {};
}

Expected<std::vector<scenario::ParameterValue>> read_parameters(const std::vector<std::string>& texts) {
  std::vector<scenario::ParameterValue> parameters;
  for (const auto& text : texts) {
    auto parameter = scenario::parse_parameter(text);
    if (!parameter) return tl::unexpected(parameter.error());
    if (std::ranges::find(parameters, parameter->name, &scenario::ParameterValue::name) != parameters.end())
      return failure(fmt::format("{} is given twice", parameter->name), "--parameter", "give each parameter one value");
    parameters.push_back(std::move(*parameter));
  }
  return parameters;
}

/// Roots for what hangs on those who have names, by which editors mean them (CONVENTIONS.md).
void add_names(scene::SceneBuilder& builder, const simulation::Model& model) {
  for (const auto& [id, name] : participant_names(model)) {
    const scene::NodeId root = builder.add_prototype(scene::participant_prototype(id));
    builder.apply(scene::TagGroupSet{root, 1, std::string(scene::participant_tag_group)});
    builder.apply(scene::TagSet{root, 1, 0, {std::string(scene::participant_name_tag), name}});
  }
}

Expected<void> build_scene(const ServerOptions& options, OpenedDrive& drive, program::ProgressLine& line) {
  OwnModelsFolder own;
  if (!options.models.empty()) {
    auto read = read_own_models(options.models);
    if (!read) return tl::unexpected(read.error());
    own = std::move(*read);
    for (const auto& message : own.messages) line.message(message);
  }
  scene::SceneBuilder builder(drive.store);
  const road::RoadNetwork& roads = drive.loaded.model->roads;
  scenery::build_vehicles(builder, &own.models,
                          roadside::parked_cars({roads, roadside::usual_overrun_m}, options.seed));
  scenery::build_debris_looks(builder);
  scenery::build_road_world(builder, roads, options.seed,
                            {.own = &own.models, .raised = drive.loaded.model->raised.get()});
  add_names(builder, *drive.loaded.model);
  if (const auto& obstacles = drive.loaded.model->obstacles) drive.standing = StandingThings(drive.store, *obstacles);
  if (!options.save.empty() || options.page_port || options.page_handover) drive.generated = drive.store;
  if (options.edits.empty()) return {};
  const auto edits = read_regular_file(options.edits);
  if (!edits) return tl::unexpected(edits.error());
  return scene::apply_edits(drive.store, *edits, printable(options.edits.string()));
}

/// The seat requested by command line and rig; `car` is changed to the actual one.
Expected<DriverSeat> choose_seat(const ServerOptions& options, rig::Car& car,
                                 const std::shared_ptr<const simulation::Model>& model,
                                 const car_io::OpenHidDevice& can_controls, program::ProgressLine& line) {
  const auto let_drive = [&](const std::string& driver) {
    car.source = rig::CarSource::simulated_driver;
    car.driver = driver;
  };
  if (!options.driver.empty()) let_drive(options.driver);
  const bool is_real_time = !options.lockstep && !options.no_screens;
  auto seat = open_driver_seat(car, options.seed, model, can_controls, is_real_time);
  if (!seat || seat->car) return seat;
  if (car.source == rig::CarSource::automatic) line.message("the rig's car is not plugged in: a keyboard drives");
  car.source = rig::CarSource::keyboard;
  if (is_real_time) return seat;
  line.message("without a window nobody can press keys: the simulated driver drives");
  let_drive(car.driver);
  return open_driver_seat(car, options.seed, model, {}, is_real_time);
}

/// The seat with all its devices.
Expected<DriverSeat> furnish_seat(const ServerOptions& options, OpenedDrive& drive, program::ProgressLine& line) {
  rig::Rig& rig = drive.loaded.rig;
  auto can = open_can_seat(rig, options.rig);
  if (!can) return tl::unexpected(can.error());
  if (can->notice) line.message(describe(*can->notice));
  auto seat = choose_seat(options, rig.car, drive.loaded.model, can->controls, line);
  if (!seat) return seat;
  if (can->instruments) seat->devices.push_back(std::move(can->instruments));
  seat->shakes_by_sound = rig.sound && rig.sound->speakers == rig::Sound::Speakers::surround_51;
  if (rig.head && !seat->is_driven_by_a_device()) {
    auto tracker = car_io::HeadTracker::open(*rig.head);
    if (!tracker) return tl::unexpected(tracker.error());
    seat->devices.push_back(std::make_unique<TrackedHead>(std::move(*tracker)));
  }
  return seat;
}

/// The drive's start, or the state that the options name.
Expected<simulation::State> first_state(const ServerOptions& options, const simulation::Model& model,
                                        std::unique_ptr<traffic::TrafficEngine> traffic) {
  if (options.begin_from.empty()) return simulation::initial_state(model, std::move(traffic));
  const auto session = logging::SessionReader::open(options.begin_from);
  if (!session) return tl::unexpected(session.error());
  return kept_state(*session, model, options.begin_at_s, std::move(traffic));
}

Expected<void> open_live(const ServerOptions& options, OpenedDrive& drive, program::ProgressLine& line) {
  auto parameters = read_parameters(options.parameters);
  if (!parameters) return tl::unexpected(parameters.error());
  auto loaded = load_drive({.scenario = options.scenario,
                            .rig = options.rig,
                            .seed = options.seed,
                            .vehicle = options.vehicle,
                            .motion = options.motion,
                            .parameters = std::move(*parameters)});
  if (!loaded) return tl::unexpected(loaded.error());
  drive.loaded = std::move(*loaded);
  for (const auto& warning : drive.loaded.warnings) line.message("not used: " + warning);
  // Needed without screens too: a complete log contains the scene, so that the drive can be replayed.
  if (!options.no_screens || !options.log_samples_only)
    if (auto built = build_scene(options, drive, line); !built) return built;
  auto seat = options.motion.empty() ? furnish_seat(options, drive, line) : Expected<DriverSeat>(DriverSeat{});
  if (!seat) return tl::unexpected(seat.error());
  drive.by_person = options.motion.empty() && !seat->is_driven_by_a_device();
  drive.remote_car = seat->remote;
  auto traffic = open_traffic(options.traffic, *drive.loaded.model);
  if (!traffic) return tl::unexpected(traffic.error());
  auto state = first_state(options, *drive.loaded.model, std::move(*traffic));
  if (!state) return tl::unexpected(state.error());
  auto source = LiveDrive::start(drive.loaded.model, std::move(*state), std::move(*seat));
  if (!options.to.empty())
    if (auto guided = source->command(simulation::GuideDriver{options.to}); !guided)
      return failure(guided.error().what, "--to", guided.error().remedy);
  drive.live = source.get();
  drive.source = std::move(source);
  return {};
}

}  // namespace

Expected<std::unique_ptr<OpenedDrive>> open_drive(const ServerOptions& options, program::ProgressLine& line) {
  auto drive = std::make_unique<OpenedDrive>();
  auto opened = options.replay.empty() ? open_live(options, *drive, line) : open_replay(options, *drive, line);
  if (!opened) return tl::unexpected(opened.error());
  return drive;
}

}  // namespace septet::server
