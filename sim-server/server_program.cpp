#include "sim-server/server_program.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>
#include <thread>

#include <fmt/core.h>

#include "car-io/driving_keys.hpp"
#include "engine/core/printable.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/net/allowed_clients_watch.hpp"
#include "engine/net/multicast_probe.hpp"
#include "engine/scene/builder.hpp"
#include "engine/scenery/vehicles/debris_looks.hpp"
#include "engine/scenery/vehicles/vehicles.hpp"
#include "engine/scenery/world/road_world.hpp"
#include "logging/recorded_scene.hpp"
#include "program/clock.hpp"
#include "program/console.hpp"
#include "program/go_word.hpp"
#include "program/stop_signal.hpp"
#include "sim-server/drive/can_seat.hpp"
#include "sim-server/drive/drive_loader.hpp"
#include "sim-server/drive/drive_sound.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/operator_desk.hpp"
#include "sim-server/drive/own_models_folder.hpp"
#include "sim-server/drive/traffic_choice.hpp"
#include "sim-server/host/remote_car.hpp"
#include "sim-server/host/replay_source.hpp"
#include "sim-server/host/serve.hpp"

namespace septet::server {
namespace {

/// What a signal means for the drive.
std::optional<logging::DriveEnd> end_by_signal() {
  const auto signal = program::stop_signal();
  if (!signal) return std::nullopt;
  program::obey_stop_signal();
  switch (*signal) {
    case SIGINT:
      return logging::DriveEnd::interrupted;
    case SIGHUP:
      return logging::DriveEnd::hung_up;
    case SIGUSR1:
      return logging::DriveEnd::no_screens;
    default:
      return logging::DriveEnd::terminated;
  }
}

struct Sockets {
  net::UdpSocket lane, tick;
};

Expected<Sockets> open_sockets(const ServerOptions& options, const rig::Network& network, bool one_machine) {
  std::uint32_t ip = one_machine ? net::loopback_ip : 0;
  if (!network.interface_address.empty()) {
    const auto parsed = net::parse_ip(network.interface_address, "rig, network.interface_address");
    if (!parsed) return tl::unexpected(parsed.error());
    ip = *parsed;
  }
  auto lane = net::UdpSocket::open({{ip, options.any_port ? std::uint16_t{0} : network.scene_port}});
  if (!lane) return tl::unexpected(lane.error());
  auto tick = net::UdpSocket::open({{ip, 0}});
  if (!tick) return tl::unexpected(tick.error());
  return Sockets{std::move(*lane), std::move(*tick)};
}

/// Multicast if the rig wants it, or if it does not mind and the machine's own loopback carries it.
Expected<void> choose_transport(const rig::Network& network, Sockets& sockets, bool any_port, control::Welcome& welcome,
                                program::ProgressLine& progress) {
  if (network.transport == rig::TickTransport::unicast) return {};
  const auto group_ip = net::parse_ip(network.tick_group, "rig, network.tick_group");
  if (!group_ip) return tl::unexpected(group_ip.error());
  const std::uint32_t interface_ip = sockets.tick.local_address().ip;
  // Two drives on one machine must not hear each other's group: the port follows the scene lane's.
  const auto port = any_port ? static_cast<std::uint16_t>(sockets.lane.local_address().port ^ 1u) : network.tick_port;
  const net::Address group{*group_ip, port};
  if (network.transport == rig::TickTransport::automatic) {
    const auto probe = net::probe_multicast(group, interface_ip);
    progress.message(fmt::format("tick lane: {} ({})", probe.works ? "multicast" : "unicast", probe.reason));
    if (!probe.works) return {};
  }
  if (auto set = sockets.tick.set_multicast({interface_ip, 1, true}); !set) return set;
  welcome.group_ip = group.ip;
  welcome.group_port = group.port;
  welcome.interface_ip = interface_ip;
  return {};
}

/// Whether all screens of the rig, and its car, are this machine's own.
bool is_one_machine(const rig::Rig& rig) {
  if (rig.network.server_address != "127.0.0.1") return false;
  for (const auto& screen : rig.screens)
    if (!screen.machine.empty()) return false;
  return rig.car.machine.empty();
}

/// What screens connect to.
struct Endpoint {
  net::Identity identity;
  std::vector<net::AllowedClient> allowed;
  Sockets sockets;
};

Expected<Endpoint> open_endpoint(const ServerOptions& options, const rig::Rig& rig) {
  auto identity = net::load_or_create_identity(options.keys / "server.key");
  if (!identity) return tl::unexpected(identity.error());
  auto allowed = net::load_allowed_clients(options.keys / "allowed-clients");
  if (!allowed) return tl::unexpected(allowed.error());
  auto sockets = open_sockets(options, rig.network, is_one_machine(rig));
  if (!sockets) return tl::unexpected(sockets.error());
  return Endpoint{*identity, std::move(*allowed), std::move(*sockets)};
}

/// The source of ticks with what it stands on.
struct Drive {
  LoadedDrive loaded;
  scene::Store store;
  std::optional<logging::SessionReader> session;  ///< Of a replay.
  std::optional<SessionLog> log;                  ///< Of a drive.
  bool by_person = false;                         ///< A person drives, not a simulated driver.
  std::shared_ptr<RemoteCar> remote_car;          ///< Of a drive whose car is on another machine.
  std::unique_ptr<TickSource> source;
  LiveDrive* live = nullptr;  ///< The source, of a drive.
};

Expected<void> prepare_replay(const ServerOptions& options, Drive& drive) {
  auto session = logging::SessionReader::open(options.replay);
  if (!session) return tl::unexpected(session.error());
  drive.session.emplace(std::move(*session));
  const auto rig_text = read_regular_file(options.rig);
  if (!rig_text) return tl::unexpected(rig_text.error());
  auto rig = rig::read_rig(*rig_text, options.rig);
  if (!rig) return tl::unexpected(rig.error());
  drive.loaded.rig = std::move(*rig);
  drive.loaded.sources.push_back({"rig", options.rig, *rig_text});
  if (auto restored = logging::restore_scene(*drive.session, drive.store); !restored) return restored;
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

/// The seat that command line and rig ask for; `car` says in the end what it became.
Expected<DriverSeat> choose_seat(const ServerOptions& options, rig::Car& car,
                                 const std::shared_ptr<const simulation::Model>& model,
                                 const car_io::OpenHidDevice& can_controls, program::ProgressLine& progress) {
  const auto let_drive = [&](const std::string& driver) {
    car.source = rig::CarSource::simulated_driver;
    car.driver = driver;
  };
  if (!options.driver.empty()) let_drive(options.driver);
  const bool is_real_time = !options.lockstep && !options.no_screens;
  auto seat = open_driver_seat(car, options.seed, model, can_controls, is_real_time);
  if (!seat || seat->car) return seat;
  if (car.source == rig::CarSource::automatic) progress.message("the rig's car is not plugged in: a keyboard drives");
  car.source = rig::CarSource::keyboard;
  if (is_real_time) return seat;
  progress.message("without a window nobody can press keys: the simulated driver drives");
  let_drive(car.driver);
  return open_driver_seat(car, options.seed, model, {}, is_real_time);
}

Expected<void> prepare_drive(const ServerOptions& options, Drive& drive, program::ProgressLine& progress) {
  auto parameters = read_parameters(options.parameters);
  if (!parameters) return tl::unexpected(parameters.error());
  auto loaded = load_drive({options.scenario, options.rig, options.seed, options.vehicle, std::move(*parameters)});
  if (!loaded) return tl::unexpected(loaded.error());
  drive.loaded = std::move(*loaded);
  for (const auto& warning : drive.loaded.warnings) progress.message("not used: " + warning);
  // Also where nobody looks on: a whole log keeps the scene, so that the drive can be shown later.
  if (!options.no_screens || !options.log_samples_only) {
    OwnModelsFolder own;
    if (!options.models.empty()) {
      auto read = read_own_models(options.models);
      if (!read) return tl::unexpected(read.error());
      own = std::move(*read);
      for (const auto& message : own.messages) progress.message(message);
    }
    scene::SceneBuilder builder(drive.store);
    scenery::build_vehicles(builder, &own.models);
    scenery::build_debris_looks(builder);
    scenery::build_road_world(builder, drive.loaded.model->roads, options.seed,
                              {.own = &own.models, .raised = drive.loaded.model->raised.get()});
  }
  auto can = open_can_seat(drive.loaded.rig, options.rig);
  if (!can) return tl::unexpected(can.error());
  if (can->notice) progress.message(describe(*can->notice));
  auto seat = choose_seat(options, drive.loaded.rig.car, drive.loaded.model, can->controls, progress);
  if (!seat) return tl::unexpected(seat.error());
  seat->show = std::move(can->show);
  seat->bus_is_lost = std::move(can->is_lost);
  const auto& sound = drive.loaded.rig.sound;
  seat->shakes_by_sound = sound && sound->speakers == rig::Sound::Speakers::surround_51;
  drive.by_person = !seat->look;
  if (const auto& tracking = drive.loaded.rig.head; tracking && drive.by_person) {
    auto tracker = car_io::HeadTracker::open(*tracking);
    if (!tracker) return tl::unexpected(tracker.error());
    seat->head = std::move(*tracker);
  }
  drive.remote_car = seat->remote;
  auto traffic = open_traffic(options.traffic, *drive.loaded.model);
  if (!traffic) return tl::unexpected(traffic.error());
  auto source = LiveDrive::start(drive.loaded.model, std::move(*traffic), std::move(*seat));
  if (!source) return tl::unexpected(source.error());
  drive.live = source->get();
  drive.source = std::move(*source);
  return {};
}

/// 0 for a drive that lasts until it is ended; one that is to last, however short, has a tick.
std::uint64_t ticks_of(double seconds, double tick_rate_hz) {
  return seconds > 0.0 ? std::max<std::uint64_t>(static_cast<std::uint64_t>(std::llround(seconds * tick_rate_hz)), 1)
                       : 0;
}

/// A picture is kept once a second, and of a drive that is shorter one: at a tick that is drawn in lockstep.
std::uint32_t picture_every(std::uint64_t ticks, std::uint64_t draw_every_ticks, double tick_rate_hz) {
  const auto second = static_cast<std::uint64_t>(tick_rate_hz);
  return static_cast<std::uint32_t>(ticks == 0 || ticks >= second ? second : ticks - ticks % draw_every_ticks);
}

/// Begins the log, once everything that could be missing is there: a failed start leaves no file behind.
Expected<void> begin_drive(const ServerOptions& options, Drive& drive) {
  std::error_code error;
  std::filesystem::create_directories(options.out, error);
  if (error) return failure(error.message(), options.out.string(), "choose a folder that can be written with --out");
  const std::filesystem::path session = options.out / "session.sqlite";
  if (std::filesystem::exists(session, error))
    return failure(
        "a drive lies there already, and a log is never overwritten", session.string(),
        fmt::format("give another folder with --out, or move that drive aside first, which `septet drive` does by "
                    "itself: mv '{0}' '{0}.1'",
                    options.out.string()));
  auto log = SessionLog::create(drive.loaded, options);
  if (!log) return tl::unexpected(log.error());
  drive.log.emplace(std::move(*log));
  drive.log->record_scene(drive.store);
  drive.live->log_to(*drive.log);
  return {};
}

/// Closes the log and writes summary and report. A log that cannot be closed is the drive's end, unless something else was.
void finish_log(const ServerOptions& options, Drive& drive, ServeResult& result,
                const std::vector<HostedScreen>& screens, program::ProgressLine& progress) {
  SessionLog& log = *drive.log;
  const auto failed = [&](const Error& error) {
    if (result.end == logging::DriveEnd::log_failed) return;  // That has been said.
    progress.message(fmt::format("septet-server: {}", describe(error)));
    if (exit_status(result.end) == logging::failed_status) return;
    result.end = logging::DriveEnd::log_failed;
    result.error = error;
  };
  if (const auto finished = log.finish(log.outcome(result, screens)); !finished) failed(finished.error());
  if (const auto remark = log.remark()) progress.message(*remark);
  if (const auto written = write_results(drive.loaded, options, log.outcome(result, screens)); !written)
    failed(written.error());
  const auto lines = write_standing(drive.loaded, options, log.game());
  if (!lines) return failed(lines.error());
  for (const std::string& line : *lines) progress.message(line);
}

void show(const Progress& now, program::ProgressLine& progress) {
  // Time passed begins anew when the driver has taken the controls.
  if (!progress.is_due(now.wall_s)) return;
  const std::string total = now.total_s > 0.0 ? fmt::format(" of {:.0f}", now.total_s) : "";
  progress.show(fmt::format("{:6.1f}{} s driven, {:.0f} s passed, {}", now.simulated_s, total, now.wall_s, now.what));
}

}  // namespace

Expected<logging::DriveEnd> run_server(ServerOptions options) {
  if (options.replay.empty())
    if (auto known = check_names(options); !known) return tl::unexpected(known.error());
  if (auto found = find_files(options); !found) return tl::unexpected(found.error());
  program::ProgressLine progress;
  Drive drive;
  auto prepared = options.replay.empty() ? prepare_drive(options, drive, progress) : prepare_replay(options, drive);
  if (!prepared) return tl::unexpected(prepared.error());
  const rig::Rig& rig = drive.loaded.rig;
  ServeOptions serve_options{.lockstep = options.lockstep,
                             .ticks = ticks_of(options.seconds, drive.source->tick_rate_hz())};
  if (serve_options.ticks > 0)
    serve_options.draw_every_ticks = std::min(serve_options.draw_every_ticks, serve_options.ticks);
  std::optional<Endpoint> endpoint;
  std::optional<ScreenHostOptions> for_screens;
  if (!options.no_screens) {
    auto opened = open_endpoint(options, rig);
    if (!opened) return tl::unexpected(opened.error());
    endpoint.emplace(std::move(*opened));
    ScreenHostOptions& host_options = for_screens.emplace(ScreenHostOptions{
        .identity = endpoint->identity, .session = net::random_session_id(), .allowed = std::move(endpoint->allowed)});
    host_options.welcome = {.rig = drive.loaded.source("rig"),
                            .lockstep = options.lockstep,
                            .tick_rate_hz = drive.source->tick_rate_hz(),
                            .picture_every_ticks = picture_every(serve_options.ticks, serve_options.draw_every_ticks,
                                                                 drive.source->tick_rate_hz()),
                            .thumbnails = options.page_port.has_value()};
    host_options.max_datagram_bytes = rig.network.max_payload_bytes;
    host_options.limits.max_datagram_bytes = rig.network.max_payload_bytes;
    // A screen that compiles its shaders is silent for a while and costs nobody anything: ticks do not wait for it in real
    // time, and in lockstep it is waited for anyway.
    host_options.limits.timeout_s = options.lockstep ? 60.0 : 5.0;
    host_options.least_playout_delay_s = rig.network.playout_delay_ticks / drive.source->tick_rate_hz();
    for (const auto& screen : rig.screens) host_options.screens.push_back(screen.name);
    host_options.drivers = rig::driving_screens(rig);
    host_options.car = drive.remote_car;
    if (auto chosen =
            choose_transport(rig.network, endpoint->sockets, options.any_port, host_options.welcome, progress);
        !chosen)
      return tl::unexpected(chosen.error());
  }
  std::unique_ptr<OperatorDesk> desk;
  if (options.page_port) {
    if (!drive.live) return failure("a session that is shown again has no operator", "--page", "leave --page away");
    auto opened = OperatorDesk::open(options, drive.loaded, *drive.live);
    if (!opened) return tl::unexpected(opened.error());
    desk = std::move(*opened);
    progress.message("operator's page: " + desk->url());
    if (!desk->speaks()) progress.message("espeak-ng is not installed: a word to the student is text alone");
  }
  // From here on there is something to be ended in order.
  program::catch_stop_signals();
  if (options.replay.empty())
    if (auto begun = begin_drive(options, drive); !begun) return tl::unexpected(begun.error());
  ServeEnvironment environment;
  environment.now_s = program::monotonic_s;
  environment.wait = [](double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); };
  environment.end_requested = [&] {
    const auto by_signal = end_by_signal();
    return by_signal || !desk ? by_signal : desk->end_requested();
  };
  ScreenHost* host = nullptr;
  const auto hosted = [&]() -> const std::vector<HostedScreen>& {
    static const std::vector<HostedScreen> none;
    return host ? host->screens() : none;
  };
  program::GoWord console;
  environment.attend = [&](const std::shared_ptr<const TakenSnapshot>& newest, const std::string& what) {
    if (drive.live && drive.live->actuators_cut() && console.take_rearm())
      if (const auto why_not = drive.live->rearm_actuators("console"))
        progress.message("fan, shaker and wheel force stay at 0: " + *why_not);
    if (desk) desk->attend(newest, what, hosted(), program::monotonic_s());
    if (desk && host) host->look_at(desk->watched(), program::monotonic_s());
  };
  if (desk) {
    desk->log_to(*drive.log);
    environment.is_paused = [&] { return desk->is_paused(); };
    environment.word = [&] { return desk->word(); };
  }
  environment.report = [&](const Progress& now) { show(now, progress); };
  environment.message = [&](const std::string& text) {
    progress.message(text);
    if (drive.log) drive.log->record_message("screen", text);
  };
  environment.show = [&](const std::string& text) { progress.message(text); };
  if (rig.sound && !options.no_sound && !options.lockstep && !options.no_screens)
    environment.hear =
        drive_sound(rig, drive.live ? drive.loaded.model : nullptr, drive.session ? &*drive.session : nullptr,
                    drive.store, environment.message, [&drive] {
                      // The shaker hangs on the same device, and what it plays on is nobody's any more.
                      if (drive.live) drive.live->cut_actuators("the sound has stopped");
                    });
  ServeResult result;
  std::vector<HostedScreen> screens;
  if (!endpoint) {
    program::announce("ready 0");
    result = run_headless(*drive.source, serve_options.ticks, environment);
  } else {
    Sockets& sockets = endpoint->sockets;
    ScreenHost screen_host(sockets.lane, sockets.tick, drive.store, std::move(*for_screens));
    host = &screen_host;
    program::announce(fmt::format("ready {}", sockets.lane.local_address().port));
    environment.wait = [&](double seconds) {
      const net::UdpSocket* waiting[] = {&sockets.lane};
      net::wait_readable(waiting, seconds);
    };
    environment.told_to_go = [&] { return console.said() || (desk && desk->told_to_go()); };
    net::AllowedClientsWatch watch(options.keys / "allowed-clients");
    environment.changed_list = [&]() -> std::optional<std::vector<net::AllowedClient>> {
      auto list = watch.changed(program::monotonic_s());
      if (!list) return std::nullopt;
      environment.message(*list ? fmt::format("allowed-clients has changed: {} clients may connect", (*list)->size())
                                : "allowed-clients has changed, and the old list still holds: " +
                                      describe(list->error()));
      return *list ? std::optional(std::move(**list)) : std::nullopt;
    };
    const bool by_keyboard = drive.by_person && rig.car.source == rig::CarSource::keyboard;
    host->give_notice({"", by_keyboard});
    if (by_keyboard) progress.message(car_io::driving_keys_text());
    if (drive.by_person && !options.start_now)
      serve_options.wait_for_driver =
          by_keyboard ? "Press any key to start" : "Press a pedal or turn the wheel to start";
    if (drive.live) serve_options.about = printable(drive.loaded.model->scenario.header.description, 200);
    const double wait_s =
        options.wait_for_screens_s < 0.0 ? std::numeric_limits<double>::infinity() : options.wait_for_screens_s;
    serve_options.wait_for_screens_s = wait_s;
    result = serve(*drive.source, *host, serve_options, environment);
    screens = host->screens();
    host = nullptr;
  }
  if (desk) desk->show_end(fmt::format("ended: {}", text_of(result.end)), screens, program::monotonic_s());
  progress.close();
  if (result.error) progress.message(fmt::format("septet-server: {}", describe(*result.error)));
  if (drive.log) finish_log(options, drive, result, screens, progress);
  program::announce(fmt::format("ended {} {}", name_of(result.end),
                                drive.log ? drive.log->ending(result) : std::string(text_of(result.end))));
  return result.end;
}

}  // namespace septet::server
