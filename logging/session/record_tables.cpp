#include "logging/session/record_tables.hpp"

#include <charconv>

#include <fmt/core.h>

namespace septet::logging {
namespace {

constexpr std::string_view seed_prefix = "seed.", parameter_prefix = "parameter.";

/// Binds values to the parameters 1, 2, 3, …
class RowBinder {
 public:
  explicit RowBinder(Statement& statement) : statement_(statement) {}
  template <std::integral T>
  RowBinder& add(T value) {
    statement_.bind(next_++, static_cast<std::int64_t>(value));
    return *this;
  }
  template <class T>
  requires(!std::integral<T>) RowBinder& add(const T& value) {
    statement_.bind(next_++, value);
    return *this;
  }
  RowBinder& add_text(std::string_view value) {
    statement_.bind(next_++, value);
    return *this;
  }
  RowBinder& add_bytes(std::span<const std::byte> bytes) {
    statement_.bind(next_++, bytes);
    return *this;
  }
  RowBinder& add_null() {
    statement_.bind_null(next_++);
    return *this;
  }

 private:
  Statement& statement_;
  int next_ = 1;
};

/// Reads the columns 0, 1, 2, …
class RowReader {
 public:
  explicit RowReader(const Statement& row) : row_(row) {}
  void to(double& value) { value = row_.real(next_++); }
  template <std::integral T>
  void to(T& value) {
    value = static_cast<T>(row_.integer(next_++));
  }
  void to(bool& value) { value = row_.integer(next_++) != 0; }
  void to(std::string& value) { value = row_.text(next_++); }
  void to(std::optional<double>& value) {
    value = row_.is_null(next_) ? std::nullopt : std::optional(row_.real(next_));
    ++next_;
  }
  bool is_null() const { return row_.is_null(next_); }
  void skip(int columns = 1) { next_ += columns; }
  std::int64_t integer() { return row_.integer(next_++); }
  Bytes bytes() {
    const auto blob = row_.blob(next_++);
    return {blob.begin(), blob.end()};
  }
  template <class... T>
  void to_all(T&... values) {
    (to(values), ...);
  }

 private:
  const Statement& row_;
  int next_ = 0;
};

std::string placeholders(int count) {
  std::string text = "?";
  for (int i = 1; i < count; ++i) text += ",?";
  return text;
}

std::optional<std::uint64_t> parse_unsigned(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

}  // namespace

Expected<Statement> prepare_answer_insert(const Database& database) {
  return database.prepare(
      "INSERT INTO questionnaire(item, question, answer, value, observed_s, censored, reason) "
      "VALUES(?,?,?,?,?,?,?)");
}

Expected<InsertStatements> prepare_inserts(const Database& database) {
  auto snapshot = database.prepare("INSERT INTO snapshots VALUES(?,?,?,?,?)");
  auto input = database.prepare("INSERT INTO driver_inputs VALUES(" + placeholders(16) + ")");
  auto edit = database.prepare("INSERT INTO scene_edits(tick, data) VALUES(?,?)");
  auto sample = database.prepare("INSERT INTO samples VALUES(" + placeholders(26) + ")");
  auto event =
      database.prepare("INSERT INTO events(tick, simulated_time_s, kind, participant, detail) VALUES(?,?,?,?,?)");
  auto answer = prepare_answer_insert(database);
  auto state = database.prepare("INSERT INTO saved_states VALUES(?,?)");
  auto head = database.prepare("INSERT INTO head_positions VALUES(" + placeholders(5) + ")");
  auto actuators = database.prepare("INSERT INTO actuators VALUES(" + placeholders(6) + ")");
  auto fingerprints = database.prepare("INSERT INTO edit_fingerprints VALUES((SELECT max(id) FROM scene_edits),?)");
  for (auto* statement : {&snapshot, &input, &edit, &sample, &event, &answer, &state, &actuators, &head, &fingerprints})
    if (!*statement) return tl::unexpected(statement->error());
  return InsertStatements{std::move(*snapshot), std::move(*input),       std::move(*edit),  std::move(*sample),
                          std::move(*event),    std::move(*answer),      std::move(*state), std::move(*actuators),
                          std::move(*head),     std::move(*fingerprints)};
}

Expected<void> insert_meta(const Database& database, const std::string& key, const std::string& value) {
  auto statement = database.prepare("INSERT OR REPLACE INTO meta VALUES(?,?)");
  if (!statement) return tl::unexpected(statement.error());
  RowBinder(*statement).add_text(key).add_text(value);
  return statement->run();
}

Expected<void> insert_info(const Database& database, const SessionInfo& info) {
  std::map<std::string, std::string> meta = info.other;
  meta["septet_version"] = info.septet_version;
  meta["git_revision"] = info.git_revision;
  meta["started_utc"] = info.started_utc;
  meta["participant"] = info.participant;
  meta["ticks_per_second"] = fmt::format("{}", info.ticks_per_second);
  for (const auto& [name, seed] : info.seeds) meta[std::string(seed_prefix) + name] = fmt::format("{}", seed);
  for (const auto& [name, value] : info.parameters) meta[std::string(parameter_prefix) + name] = value;
  for (const auto& [key, value] : meta)
    if (auto done = insert_meta(database, key, value); !done) return done;
  auto statement = database.prepare("INSERT INTO files VALUES(?,?,?)");
  if (!statement) return tl::unexpected(statement.error());
  for (const SourceFile& file : info.files) {
    RowBinder(*statement).add_text(file.role).add_text(file.name).add_bytes(std::as_bytes(std::span(file.content)));
    if (auto done = statement->run(); !done) return done;
  }
  return {};
}

Expected<void> insert(Statement& statement, const InputRecord& record) {
  RowBinder row(statement);
  row.add(record.tick);
  record.report ? row.add_bytes(*record.report) : row.add_null();
  const DriverInput& input = record.input;
  row.add(input.steering_wheel_rad).add(input.accelerator).add(input.brake).add(input.clutch);
  row.add(static_cast<int>(input.selector)).add(input.gear).add(static_cast<int>(input.indicator));
  row.add(input.hazard_lights).add(input.horn).add(input.low_beam).add(input.high_beam).add(input.parking_brake);
  row.add(input.gaze_heading_rad).add(input.sequence);
  return statement.run();
}

Expected<InputRecord> read_input(const Statement& row) {
  InputRecord record;
  RowReader in(row);
  in.to(record.tick);
  if (in.is_null())
    in.skip();
  else
    record.report = in.bytes();
  DriverInput& input = record.input;
  in.to_all(input.steering_wheel_rad, input.accelerator, input.brake, input.clutch);
  const std::int64_t selector = in.integer();
  in.to(input.gear);
  const std::int64_t indicator = in.integer();
  if (selector < 0 || selector > 4 || indicator < -1 || indicator > 1)
    return failure(
        fmt::format("the driver input of tick {} says selector {} and indicator {}", record.tick, selector, indicator),
        row.where(), "the file is damaged: use a copy");
  input.selector = static_cast<GearSelector>(selector);
  input.indicator = static_cast<IndicatorStalk>(indicator);
  in.to_all(input.hazard_lights, input.horn, input.low_beam, input.high_beam, input.parking_brake,
            input.gaze_heading_rad, input.sequence);
  return record;
}

Expected<void> insert_head(Statement& statement, const InputRecord& record) {
  const Head& head = record.input.head;
  if (head == Head{}) return {};
  RowBinder row(statement);
  row.add(record.tick).add(head.from_rest_m.x).add(head.from_rest_m.y).add(head.from_rest_m.z).add(head.turn_rad);
  return statement.run();
}

Expected<HeadRecord> read_head(const Statement& row) {
  HeadRecord record;
  RowReader in(row);
  in.to(record.tick);
  in.to_all(record.head.from_rest_m.x, record.head.from_rest_m.y, record.head.from_rest_m.z, record.head.turn_rad);
  return record;
}

Expected<void> insert(Statement& statement, const SceneRun& run) {
  RowBinder(statement).add(run.tick).add_bytes(run.data);
  return statement.run();
}

Expected<void> insert_fingerprints(Statement& statement, const SceneRun& run) {
  if (!run.fingerprints) return {};
  RowBinder(statement).add_bytes(*run.fingerprints);
  return statement.run();
}

Expected<SceneRun> read_scene_run(const Statement& row) {
  SceneRun run;
  RowReader in(row);
  in.to(run.tick);
  run.data = in.bytes();
  // An edit whose row is missing has none that agree.
  if (row.columns() > 2 && run.tick > 0) run.fingerprints = in.is_null() ? Bytes() : in.bytes();
  return run;
}

Expected<void> insert(Statement& statement, const StateRecord& state) {
  RowBinder(statement).add(state.tick).add_bytes(state.data);
  return statement.run();
}

Expected<void> insert(Statement& statement, const ActuatorRecord& actuators) {
  RowBinder(statement)
      .add(actuators.tick)
      .add(actuators.fan)
      .add(actuators.vibration)
      .add(actuators.vibration_hz)
      .add(actuators.steering)
      .add(actuators.is_cut);
  return statement.run();
}

Expected<ActuatorRecord> read_actuators(const Statement& row) {
  ActuatorRecord actuators;
  RowReader in(row);
  in.to(actuators.tick);
  in.to(actuators.fan);
  in.to(actuators.vibration);
  in.to(actuators.vibration_hz);
  in.to(actuators.steering);
  in.to(actuators.is_cut);
  return actuators;
}

Expected<StateRecord> read_state(const Statement& row) {
  StateRecord state;
  RowReader in(row);
  in.to(state.tick);
  state.data = in.bytes();
  return state;
}

Expected<void> insert(Statement& statement, const Sample& s) {
  RowBinder row(statement);
  row.add(s.tick).add(s.simulated_time_s).add(s.x_m).add(s.y_m).add(s.z_m).add(s.heading_rad).add(s.speed_mps);
  row.add(s.longitudinal_acceleration_mps2).add(s.lateral_acceleration_mps2).add(s.yaw_rate_radps);
  row.add(s.road).add(s.lane).add(s.road_s_m).add(s.lateral_position_m).add(s.lane_width_m);
  if (s.leader)
    row.add(s.leader->participant)
        .add(s.leader->distance_gap_m)
        .add(s.leader->distance_headway_m)
        .add(s.leader->speed_mps);
  else
    row.add_null().add_null().add_null().add_null();
  row.add(s.steering_wheel_rad).add(s.accelerator).add(s.brake).add(s.clutch).add(s.gear).add(s.lamps.bits);
  row.add(s.gaze_heading_rad);
  return statement.run();
}

Expected<Sample> read_sample(const Statement& row) {
  Sample s;
  RowReader in(row);
  in.to_all(s.tick, s.simulated_time_s, s.x_m, s.y_m, s.z_m, s.heading_rad, s.speed_mps,
            s.longitudinal_acceleration_mps2, s.lateral_acceleration_mps2, s.yaw_rate_radps, s.road, s.lane, s.road_s_m,
            s.lateral_position_m, s.lane_width_m);
  if (in.is_null()) {
    in.skip(4);
  } else {
    Leader& leader = s.leader.emplace();
    in.to_all(leader.participant, leader.distance_gap_m, leader.distance_headway_m, leader.speed_mps);
  }
  in.to_all(s.steering_wheel_rad, s.accelerator, s.brake, s.clutch, s.gear, s.lamps.bits, s.gaze_heading_rad);
  return s;
}

Expected<void> insert(Statement& statement, const Event& event) {
  RowBinder row(statement);
  row.add(event.tick).add(event.simulated_time_s).add_text(event.kind);
  event.participant ? row.add(*event.participant) : row.add_null();
  row.add_text(event.detail);
  return statement.run();
}

Expected<Event> read_event(const Statement& row) {
  Event event;
  RowReader in(row);
  in.to_all(event.tick, event.simulated_time_s, event.kind);
  if (in.is_null())
    in.skip();
  else
    event.participant = static_cast<ParticipantId>(in.integer());
  in.to(event.detail);
  return event;
}

Expected<void> insert(Statement& statement, const QuestionnaireRecord& answer) {
  RowBinder row(statement);
  row.add_text(answer.item).add_text(answer.question);
  answer.answer ? row.add_text(*answer.answer) : row.add_null();
  row.add(answer.value);
  row.add(answer.observed_s).add(answer.censored).add_text(answer.reason);
  return statement.run();
}

Expected<QuestionnaireRecord> read_answer(const Statement& row) {
  QuestionnaireRecord answer;
  RowReader in(row);
  in.to_all(answer.item, answer.question);
  if (in.is_null())
    in.skip();
  else
    in.to(answer.answer.emplace());
  in.to_all(answer.value, answer.observed_s, answer.censored, answer.reason);
  return answer;
}

Expected<SessionInfo> read_info(const Database& database) {
  SessionInfo info;
  auto meta = database.prepare("SELECT key, value FROM meta ORDER BY key");
  if (!meta) return tl::unexpected(meta.error());
  for (;;) {
    const auto row = meta->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) break;
    info.other[meta->text(0)] = meta->text(1);
  }
  const auto move_out = [&](const char* key, std::string& to) {
    if (auto node = info.other.extract(key)) to = std::move(node.mapped());
  };
  std::string rate;
  move_out("septet_version", info.septet_version);
  move_out("git_revision", info.git_revision);
  move_out("started_utc", info.started_utc);
  move_out("participant", info.participant);
  move_out("ticks_per_second", rate);
  const auto [end, error] = std::from_chars(rate.data(), rate.data() + rate.size(), info.ticks_per_second);
  if (error != std::errc() || !(info.ticks_per_second > 0.0))
    return failure(fmt::format("the meta row ticks_per_second says '{}'", rate), database.where(),
                   "this session cannot be used; a number above 0 belongs there");
  for (auto row = info.other.lower_bound(std::string(seed_prefix));
       row != info.other.end() && row->first.starts_with(seed_prefix);) {
    const auto seed = parse_unsigned(row->second);
    if (!seed)
      return failure(fmt::format("the meta row {} says '{}'", row->first, row->second), database.where(),
                     "this session cannot be used; a whole number belongs there");
    info.seeds[row->first.substr(seed_prefix.size())] = *seed;
    row = info.other.erase(row);
  }
  for (auto row = info.other.lower_bound(std::string(parameter_prefix));
       row != info.other.end() && row->first.starts_with(parameter_prefix);) {
    info.parameters[row->first.substr(parameter_prefix.size())] = row->second;
    row = info.other.erase(row);
  }
  auto files = database.prepare("SELECT role, name, content FROM files ORDER BY rowid");
  if (!files) return tl::unexpected(files.error());
  for (;;) {
    const auto row = files->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return info;
    info.files.push_back({files->text(0), files->text(1), files->text(2)});
  }
}

}  // namespace septet::logging
