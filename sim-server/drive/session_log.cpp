#include "sim-server/drive/session_log.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <variant>

#include <fmt/core.h>

#include "engine/core/version.hpp"
#include "engine/road/body_lanes.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/scene/command_codec.hpp"
#include "engine/world/crash_record.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/solid.hpp"
#include "logging/session/input_hash.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/session/subject.hpp"
#include "logging/study/best_list.hpp"
#include "logging/study/lesson/debrief.hpp"
#include "logging/study/lesson/lesson.hpp"
#include "logging/study/measures/collisions.hpp"
#include "logging/study/report/report.hpp"
#include "logging/study/report/summary.hpp"
#include "sim-server/drive/what_if/braking_earlier.hpp"
#include "sim-server/drive/who_is_who.hpp"

namespace septet::server {
namespace {

std::string now_utc() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::map<std::string, std::string> parameters_of(const LoadedDrive& drive) {
  std::map<std::string, std::string> parameters;
  for (const auto& parameter : drive.parameters) parameters[parameter.name] = parameter.value;
  return parameters;
}

}  // namespace

Expected<SessionLog> SessionLog::create(const LoadedDrive& drive, const ServerOptions& drive_options, Tick first,
                                        const SessionFile& file) {
  logging::SessionInfo info;
  info.septet_version = version;
  info.git_revision = revision;
  info.started_utc = now_utc();
  info.ticks_per_second = simulation::tick_rate_hz;
  info.participant = drive_options.participant;
  info.seeds["drive"] = drive_options.seed;
  info.parameters = parameters_of(drive);
  info.files = drive.sources;
  info.other["driver"] = drive.rig.car.source == rig::CarSource::simulated_driver ? drive.rig.car.driver : "";
  info.other["traffic"] = drive_options.traffic;
  info.other["compiler"] = __VERSION__;
  if (drive_options.log_samples_only) info.other["log"] = "samples";
  if (first > 0) info.other[logging::begun_at_row] = std::to_string(first);
  logging::Subject subject;
  for (const auto& text : drive_options.about)
    if (auto added = add_to_subject(subject, text); !added) return tl::unexpected(added.error());
  info.other.merge(logging::meta_of(subject));
  info.other.merge(who_is_who(*drive.model));
  for (const auto& [key, value] : file.meta) info.other[key] = value;
  logging::WriterOptions options;
  const bool real_time = !drive_options.lockstep && !drive_options.no_screens;
  // Queue for half a minute of a blocked disk, so that the driver does not notice. Drives that run as fast as they can
  // wait anyway.
  if (real_time) options.queue_bytes = std::size_t{256} << 20;
  auto writer = logging::SessionWriter::create(drive_options.out / file.name, info, options);
  if (!writer) return tl::unexpected(writer.error());
  SessionLog log(std::move(*writer), drive.model, real_time, drive_options.log_samples_only);
  log.digest_.add(info);
  log.observer_.glances.settings.areas = logging::glance_areas(drive.rig);
  return log;
}

void SessionLog::record_scene(const scene::Store& store) {
  scene::describe_store(store, [&](const scene::Command& command) { record_edits(0, std::span(&command, 1)); });
}

void SessionLog::record_edits(Tick from, std::span<const scene::Command> changes) {
  if (samples_only_) return;
  for (const scene::Command& command : changes) {
    Bytes bytes;
    scene::encode(command, bytes);
    logging::SceneEdit edit{from, std::move(bytes)};
    digest_.add(edit);
    writer_.record(std::move(edit));
  }
}

void SessionLog::record_tick(std::shared_ptr<const TakenSnapshot> taken, const std::vector<simulation::Event>& events) {
  const Snapshot& snapshot = taken->snapshot();
  tick_ = snapshot.tick;
  simulated_time_s_ = snapshot.simulated_time_s;
  bad_numbers_ = snapshot.diagnostics.bad_numbers;
  game_ = snapshot.game;
  record_events(events);
  // The search for the leader runs only for samples, ten times a second.
  const auto leader =
      logging::is_sample_due(tick_, simulation::tick_rate_hz) ? find_leader(snapshot, model_->roads) : std::nullopt;
  auto observation = logging::observe(observer_, snapshot, leader);
  for (auto& event : observation.events) record(std::move(event));
  if (observation.sample) {
    if (sampled_) sampled_(*observation.sample);
    digest_.add(*observation.sample);
    writer_.record(*observation.sample);
  }
  if (samples_only_) return;
  digest_.add_tick(tick_, simulated_time_s_, snapshot.state_hash);
  writer_.record(std::move(taken));
}

void SessionLog::record_events(const std::vector<simulation::Event>& events) {
  for (const auto& event : events)
    record(logging::Event{tick_, simulated_time_s_, event.kind, event.participant, event.detail});
}

std::optional<std::string> SessionLog::take_warning() {
  const double waited_s = writer_.waited_s();
  if (!real_time_ || waited_s < told_waited_s_ + 0.1) return std::nullopt;
  told_waited_s_ = waited_s;
  record_message("log_slow", fmt::format("waited_s={:.2f}", waited_s));
  return fmt::format(
      "log: the disk is too slow for this drive, which has waited {:.1f} s for it so far; nothing is lost", waited_s);
}

void SessionLog::record_input(logging::InputRecord input) {
  logging::add_to_hash(input, inputs_hash_);
  writer_.record(std::move(input));
}

logging::DriveOutcome SessionLog::outcome(const ServeResult& result, const std::vector<HostedScreen>& screens) const {
  logging::DriveOutcome outcome;
  outcome.end = result.end;
  if (result.error) outcome.error = describe(*result.error);
  outcome.ticks = result.ticks;
  outcome.simulated_s = result.simulated_s;
  outcome.wall_s = result.wall_s;
  outcome.state_hash = result.state_hash;
  outcome.inputs_hash = inputs_hash_.value();
  outcome.late_ticks = result.late_ticks;
  outcome.bad_numbers = bad_numbers_;
  outcome.lost_records = writer_.lost_records();
  outcome.log_waited_s = writer_.waited_s();
  for (const HostedScreen& screen : screens) {
    logging::ScreenOutcome seen;
    const auto report = screen.report.value_or(control::ScreenReport{});
    seen.name = screen.name;
    seen.frames = std::max(screen.frames,
                           report.frames);  // The host counts across restarts; the screen loses none in transit.
    seen.frames_off_tick = report.frames_off_tick;
    seen.datagrams_lost = report.datagrams_lost;
    seen.datagrams_repaired = report.datagrams_repaired;
    seen.refused_ticks = report.refused_ticks;
    seen.frame_ms_p50 = report.frame_ms_p50;
    seen.frame_ms_p99 = report.frame_ms_p99;
    seen.submit_ms_p50 = report.submit_ms_p50;
    seen.submit_ms_p99 = report.submit_ms_p99;
    seen.report_to_picture_ms_p50 = screen.report_to_picture.quantile_ms(0.5);
    seen.report_to_picture_ms_p99 = screen.report_to_picture.quantile_ms(0.99);
    seen.connected_s = screen.connected_s;
    seen.left_s = screen.left_s;
    seen.left_behind_s = screen.left_behind_s;
    seen.has_reported = screen.report.has_value();
    outcome.screens.push_back(std::move(seen));
  }
  return outcome;
}

Expected<void> SessionLog::finish(const logging::DriveOutcome& outcome) {
  return writer_.finish({{"ended_why", std::string(name_of(outcome.end))},
                         {"outcome", to_json(outcome)},
                         {logging::digest_row, to_json(digest_)}});
}

std::optional<std::string> SessionLog::remark() const {
  if (!writer_.is_still_read()) return std::nullopt;
  return "the log is whole; another program has it open, so session.sqlite-wal stays beside it: copy both";
}

std::string SessionLog::ending(const ServeResult& result) const {
  std::string text = fmt::format("the drive ended after {:.1f} s: {}", result.simulated_s, text_of(result.end));
  if (bad_numbers_ > 0)
    text += fmt::format("; {} numbers went bad and were reset: look for bad_number in the log", bad_numbers_);
  if (const auto lost = writer_.lost_records(); lost > 0)
    text += fmt::format("; the log lacks the last {} records", lost);
  if (real_time_ && writer_.waited_s() >= 0.1)
    text += fmt::format("; the disk was too slow and made the drive wait for {:.1f} s", writer_.waited_s());
  return text;
}

void SessionLog::record_message(const std::string& kind, const std::string& text) {
  record(logging::Event{tick_, simulated_time_s_, kind, std::nullopt, text});
}

void SessionLog::record_command(Tick before, const simulation::OperatorCommand& command) {
  if (std::holds_alternative<simulation::PutCar>(command)) logging::break_off(observer_.lane_changes);
  const std::string text = simulation::text_of(command);
  if (const auto solid = named_solid(text)) solids_.insert_or_assign(solid->participant, std::string(solid->name));
  record(logging::Event{before, simulated_time_s_, std::string(operator_command_event), std::nullopt, text});
}

/// A contact with a solid tells whose place it stands in: numbers serve again, and a log's reader knows no scene.
void SessionLog::name_solid(logging::Event& event) const {
  const bool by_participant = event.kind == "collision";
  if (!by_participant && event.kind != "crash_of_others" && event.kind != crash_event) return;
  const auto with = by_participant ? std::nullopt : logging::number_in_detail(event.detail, "with");
  const auto struck = by_participant ? event.participant
                      : with         ? std::optional(static_cast<ParticipantId>(*with))
                                     : std::nullopt;
  const auto solid = struck ? solids_.find(*struck) : solids_.end();
  if (solid != solids_.end()) event.detail += name_of_struck(solid->second);
}

void SessionLog::record(logging::Event event) {
  name_solid(event);
  if (happened_) happened_(event);
  if (heard_) heard_(event);
  digest_.add(event);
  writer_.record(std::move(event));
}

std::optional<logging::Leader> find_leader(const Snapshot& snapshot, const road::RoadNetwork& roads) {
  const DriverCar& car = snapshot.driver_car;
  const Participant* self = find_participant(snapshot, car.participant);
  if (!self || car.lane == 0) return std::nullopt;
  const double direction = road::runs_along_s(roads, {car.road, car.lane, car.road_s_m, 0.0}) ? 1.0 : -1.0;
  const VehicleModel& own = vehicle_models()[self->model];
  const Vec3 forward = self->world_from_vehicle.orientation * Vec3(1, 0, 0);
  std::optional<logging::Leader> leader;
  for (const Participant& other : snapshot.participants) {
    if (other.id == self->id) continue;
    const Vec3 away = other.world_from_vehicle.position_m - self->world_from_vehicle.position_m;
    const double ahead_m = glm::dot(away, forward);
    if (glm::dot(away, away) > 260.0 * 260.0 || ahead_m < 0.0) continue;
    const road::RoadPosition hint{car.road, car.road_s_m + direction * ahead_m, 0.0};
    const auto& position = other.world_from_vehicle.position_m;
    const auto place = road::locate(roads, {position.x, position.y}, &hint);
    if (!place || place->position.road != car.road) continue;
    const VehicleModel model = shape_of(other);
    const Vec3 heads = other.world_from_vehicle.orientation * Vec3(1, 0, 0);
    const road::BodyOutline body{std::atan2(heads.y, heads.x), model.rear_overhang_m, model.front_m(), model.width_m};
    if (!road::drivable_lanes_under(roads, place->position, body).contains(car.lane)) continue;
    // The driver's station refers to the front axle; gaps are between bumpers, along the driver's lane.
    const double to_rear_axle =
        direction * road::length_along_lane_m(roads, {car.road, car.lane, car.road_s_m, 0.0}, place->position.s_m);
    const double own_front = own.front_m() - own.wheelbase_m;
    const double gap = to_rear_axle - model.rear_overhang_m - own_front;
    if (gap < -2.0 || gap > 250.0 || (leader && gap > leader->distance_gap_m)) continue;
    leader = logging::Leader{other.id, gap, gap + model.length_m, glm::length(other.velocity_mps)};
  }
  return leader;
}

Expected<std::vector<std::string>> write_standing(const LoadedDrive& drive, const ServerOptions& options,
                                                  const std::optional<GameStanding>& game) {
  std::vector<std::string> lines;
  const auto session = logging::SessionReader::open(options.out / "session.sqlite");
  if (!session) return tl::unexpected(session.error());
  const std::string screen = options.no_screens ? "" : "screens/" + rig::screen_ahead(drive.rig).name;
  const bool is_lesson = std::ranges::count(drive.sources, logging::lesson_role, &logging::SourceFile::role) > 0;
  std::string what_if;
  // Nobody is there to learn from a drive without screens, unless it is a lesson.
  if (is_lesson || !options.no_screens) {
    const auto sentence = braking_earlier(*session);
    if (sentence && *sentence) what_if = **sentence;
    if (!sentence) lines.push_back("nothing is offered to learn from the collision: " + describe(sentence.error()));
  }
  const auto debrief = logging::write_debrief(*session, options.out, screen, what_if);
  if (!debrief) return tl::unexpected(debrief.error());
  if (*debrief) lines.push_back(fmt::format("{}: {}", (options.out / "debrief.html").string(), **debrief));
  if (!what_if.empty()) lines.push_back(what_if);
  // A game that was abandoned has no place.
  if (!game || game->end == GameEnd::none) return lines;
  const std::string played =
      fmt::format("{:.0f} points, level {}, {:.0f} s", game->points, game->level, game->survived_s);
  if (session->info().other.contains(logging::begun_at_row)) {
    lines.push_back(played + "; no place in the list: it did not begin at its start");
    return lines;
  }
  const char* const ends[] = {"", "lost", "crash", "time"};
  const auto list = std::filesystem::absolute(options.out).parent_path() / "best-list.json";
  const auto place = logging::enter_best_list(
      list, {std::filesystem::path(options.scenario).stem().string(), options.participant, game->points,
             game->survived_s, game->level, ends[static_cast<std::size_t>(game->end)], session->info().started_utc});
  if (!place) {
    lines.push_back(played + "; " + describe(place.error()));
    return lines;
  }
  lines.push_back(fmt::format("{}: {}; place {} of those who played here", list.string(), played, *place));
  return lines;
}

Expected<void> write_results(const LoadedDrive& drive, const ServerOptions& options,
                             const logging::DriveOutcome& outcome) {
  const auto reader = logging::SessionReader::open(options.out / "session.sqlite");
  const auto log = reader.and_then(logging::summarise_log);
  logging::DriveSummary summary{.scenario = std::filesystem::path(options.scenario).stem().string(),
                                .rig = drive.rig.name,
                                .vehicle = drive.vehicle_name(),
                                .participant = options.participant,
                                .subject = {},
                                .parameters = parameters_of(drive),
                                .seed = options.seed,
                                .outcome = outcome,
                                .log = {}};
  for (const auto& text : options.about)
    if (auto added = add_to_subject(summary.subject, text); !added) return added;
  if (log) summary.log = *log;
  if (auto written = logging::write_summary(options.out / "summary.json", summary); !written) return written;
  if (!log) return tl::unexpected(log.error());
  return logging::write_report(*reader, options.out / "report.html", outcome);
}

}  // namespace septet::server
