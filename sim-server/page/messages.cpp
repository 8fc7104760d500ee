#include "sim-server/page/messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"
#include "engine/document/json.hpp"
#include "engine/world/participant_shape.hpp"
#include "sim-server/page/web_server.hpp"

namespace septet::page {
namespace {

using document::Json;

tl::unexpected<Error> no_message(std::string what) {
  return failure(std::move(what), "the operator's page", "load the page again");
}

/// A text member, printable and cut to length; empty if there is none.
std::string text_member(const nlohmann::json& object, const char* name, std::size_t most) {
  const auto found = object.find(name);
  if (found == object.end() || !found->is_string()) return {};
  return printable(found->get_ref<const std::string&>(), most);
}

/// A whole number from 0 on; a huge one if there is none.
std::uint64_t count_member(const nlohmann::json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : ~std::uint64_t{0};
}

/// A finite number; not one if there is none.
double number_member(const nlohmann::json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_number() ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

/// A text member as it was written; empty if there is none.
std::string raw_member(const nlohmann::json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// The drive of a message: members of a wrong type are skipped, and Septet's own command line checks the rest.
DriveChoice choice_of(const nlohmann::json& object) {
  const auto text = [&](const char* name, std::size_t most) { return text_member(object, name, most); };
  DriveChoice choice{.scenario = text("scenario", 200),
                     .rig = text("rig", 200),
                     .driver = text("driver", 60),
                     .vehicle = text("vehicle", 200),
                     .participant = text("participant", 400),
                     .group = text("group", 200),
                     .condition = text("condition", 200),
                     .order = text("order", 200),
                     .note = text("note", most_note_characters),
                     .seed = text("seed", 40),
                     .seconds = text("seconds", 40)};
  choice.experiment = text("experiment", 200);
  if (const auto now = object.find("start_now"); now != object.end() && now->is_boolean())
    choice.start_now = now->get<bool>();
  if (const auto parameters = object.find("parameters"); parameters != object.end() && parameters->is_object())
    for (const auto& item : parameters->items())
      if (item.value().is_string() && choice.parameters.size() < 100)
        choice.parameters.emplace_back(printable(item.key(), 200),
                                       printable(item.value().get_ref<const std::string&>(), 200));
  return choice;
}

Answer answer_of(const nlohmann::json& object) {
  Answer answer{.session = count_member(object, "session"),
                .questionnaire = text_member(object, "questionnaire", 200),
                .as = text_member(object, "as", 200),
                .answers = {}};
  if (const auto given = object.find("answers"); given != object.end() && given->is_object())
    for (const auto& item : given->items()) {
      if (answer.answers.size() >= 1000) break;
      const auto& value = item.value();
      std::optional<int> number;
      if (value.is_number_integer() && std::abs(value.get<double>()) < 1e9) number = value.get<int>();
      answer.answers.emplace_back(printable(item.key(), 200), number);
    }
  return answer;
}

/// Rounded: a state is sent ten times a second, and a map needs no micrometres.
Json rounded(double value, double unit) {
  if (!std::isfinite(value)) return nullptr;
  const double scaled = std::round(value / unit);
  if (std::abs(scaled) > 9e15) return nullptr;
  return unit >= 1.0 ? Json(static_cast<std::int64_t>(scaled)) : Json(scaled / std::round(1.0 / unit));
}

double heading_rad(const RigidTransform& pose) {
  const Vec3 ahead = pose.orientation * Vec3(1.0, 0.0, 0.0);
  return std::atan2(ahead.y, ahead.x);
}

/// Everybody: id, model, x and y of the origin, heading, speed; of a box also length and width.
Json everybody(const Snapshot& snapshot) {
  Json list = Json::array();
  for (const Participant& p : snapshot.participants) {
    const Vec3& at = p.world_from_vehicle.position_m;
    Json row = {p.id,
                p.model,
                rounded(at.x, 0.01),
                rounded(at.y, 0.01),
                rounded(heading_rad(p.world_from_vehicle), 0.001),
                rounded(glm::length(p.velocity_mps), 0.1)};
    if (const auto size_m = box_size_of(p))
      row.push_back(rounded(size_m->x, 0.01)), row.push_back(rounded(size_m->y, 0.01));
    list.push_back(std::move(row));
  }
  return list;
}

Json screens_of(const DriveView& view, double tick_rate_hz) {
  Tick foremost = 0;
  for (const auto& screen : view.screens)
    if (screen.live && screen.presented) foremost = std::max(foremost, *screen.presented);
  Json list = Json::array();
  for (const auto& screen : view.screens) {
    Json behind_ms = nullptr;
    if (screen.live && screen.presented)
      behind_ms = rounded(1000.0 * static_cast<double>(foremost - *screen.presented) / tick_rate_hz, 0.1);
    list.push_back({{"name", screen.name},
                    {"live", screen.live},
                    {"frames", screen.frames},
                    {"frame_ms", rounded(screen.frame_ms, 0.1)},
                    {"behind_ms", behind_ms},
                    {"lost", screen.lost_baselines},
                    {"drop_outs", screen.drop_outs}});
  }
  return list;
}

/// RFC 4648, section 4.
std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t three = 0;
    for (std::size_t j = 0; j < 3; ++j)
      three = three << 8 | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j) text += j <= count ? digits[three >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

/// The picture in the form of an <img> source, with the type from its first bytes.
std::string picture_address(std::string_view picture) {
  const bool is_jpeg = picture.starts_with("\xff\xd8");
  return fmt::format("data:image/{};base64,{}", is_jpeg ? "jpeg" : "png", base64(picture));
}

}  // namespace

Expected<BrowserMessage> read_browser_message(std::string_view text) {
  if (text.size() > most_message_bytes) return no_message("the message is too long, and nothing was done");
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.is_object()) return no_message("this is no message, and nothing was done");
  BrowserMessage message;
  const auto id = json.find("id");
  if (id == json.end() || !id->is_number_unsigned())
    return no_message("the message has no number, and nothing was done");
  message.id = id->get<std::uint64_t>();
  const std::string wish = text_member(json, "do", 40);
  const auto flag = [&](const char* name) {
    const auto found = json.find(name);
    return found != json.end() && found->is_boolean() && found->get<bool>();
  };
  if (wish == "take")
    message.wish = Take{text_member(json, "name", most_name_characters), flag("by_force")};
  else if (wish == "release")
    message.wish = Release{};
  else if (wish == "pause")
    message.wish = Pause{};
  else if (wish == "go_on")
    message.wish = GoOn{};
  else if (wish == "rearm")
    message.wish = Rearm{};
  else if (wish == "end")
    message.wish = End{text_member(json, "reason", most_note_characters), flag("participant_stops")};
  else if (wish == "mark")
    message.wish = Mark{text_member(json, "note", most_note_characters)};
  else if (wish == "change")
    message.wish = Change{raw_member(json, "command")};
  else if (wish == "edit")
    message.wish = Edit{raw_member(json, "lines")};
  else if (wish == "find_near")
    message.wish = FindNear{number_member(json, "x_m"), number_member(json, "y_m"), number_member(json, "within_m")};
  else if (wish == "save_edits")
    message.wish = SaveEdits{text_member(json, "name", most_name_characters)};
  else if (wish == "rate")
    message.wish = Rate{static_cast<int>(std::min<std::uint64_t>(count_member(json, "value"), 1000))};
  else if (wish == "start")
    message.wish = Start{choice_of(json)};
  else if (wish == "cancel")
    message.wish = Cancel{};
  else if (wish == "look")
    message.wish = Look{count_member(json, "session"), text_member(json, "file", 40)};
  else if (wish == "say")
    message.wish =
        Say{text_member(json, "text", most_word_characters), text_member(json, "language", 8), flag("aloud")};
  else if (wish == "brake")
    message.wish = Brake{flag("held")};
  else if (wish == "back")
    message.wish = Back{static_cast<double>(std::min<std::uint64_t>(count_member(json, "seconds"), 3600))};
  else if (wish == "restart")
    message.wish = Restart{static_cast<double>(count_member(json, "at_s"))};
  else if (wish == "make")
    message.wish = Make{count_member(json, "session"), text_member(json, "what", 10)};
  else if (wish == "stop_making")
    message.wish = StopMaking{};
  else if (wish == "watch")
    message.wish = Watch{text_member(json, "screen", most_name_characters)};
  else if (wish == "answer")
    message.wish = answer_of(json);
  else
    return no_message("no such wish is known, and nothing was done");
  return message;
}

std::string refusal_text(std::string_view message, const Error& why) {
  std::uint64_t number = 0;
  bool is_number = false;
  // Read member by member: the number is found although what comes behind it is cut or spoiled.
  const auto look = [&](int depth, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
    using Event = nlohmann::json::parse_event_t;  // clang 14 takes no "using enum" of an alias.
    if (depth == 1 && event == Event::key) is_number = parsed == "id";
    if (depth == 1 && event == Event::value && std::exchange(is_number, false) && parsed.is_number_unsigned())
      number = parsed.get<std::uint64_t>();
    return true;
  };
  [[maybe_unused]] const auto rest = nlohmann::json::parse(message, look, false);
  return answer_text(number, why.what);
}

namespace {

Json lesson_of(const DriveFacts& facts) {
  if (!facts.lesson) return nullptr;
  const LessonFacts& lesson = *facts.lesson;
  Json tasks = Json::array();
  for (const LessonTaskFacts& task : lesson.tasks)
    tasks.push_back({{"says", task.says},
                     {"measure", task.measure},
                     {"unit", task.unit},
                     {"bound", rounded(task.bound, 0.01)},
                     {"at_most", task.is_at_most}});
  return {{"title", lesson.title},
          {"aim", lesson.aim},
          {"pass_mark", lesson.pass_mark},
          {"shortest_s", lesson.shortest_s},
          {"tasks", std::move(tasks)}};
}

}  // namespace

std::string hello_text(const DriveFacts& facts, const RoadMap& map, std::uint64_t browser) {
  Json shapes = Json::array();
  for (const auto& shape : map.shapes) {
    Json points = Json::array();
    for (const Vec2& point : shape.points_m) {
      points.push_back(rounded(point.x, 0.1));
      points.push_back(rounded(point.y, 0.1));
    }
    shapes.push_back({{"kind", static_cast<int>(shape.kind)}, {"points", std::move(points)}});
  }
  Json models = Json::array();
  for (const VehicleModel& model : vehicle_models())
    models.push_back({{"name", std::string(model.name)},
                      {"kind", static_cast<int>(model.kind)},
                      {"length", model.length_m},
                      {"width", model.width_m},
                      {"rear", model.rear_overhang_m}});
  Json conditions = Json::array();
  for (const Adjustable& condition : facts.conditions)
    conditions.push_back({{"name", condition.name},
                          {"least", document::number(condition.least)},
                          {"most", document::number(condition.most)}});
  Json rating = nullptr;
  if (facts.rating)
    rating = {{"title", facts.rating->title},
              {"text", facts.rating->text},
              {"least", facts.rating->least},
              {"labels", facts.rating->labels}};
  Json restart = nullptr;
  if (facts.kept_states) restart = {{"from_s", facts.kept_states->from_s}, {"every_s", facts.kept_states->every_s}};
  return document::line_of({{"type", "hello"},
                            {"schema", schema},
                            {"you", browser},
                            {"lesson", lesson_of(facts)},
                            {"scenario", facts.scenario},
                            {"rig", facts.rig},
                            {"vehicle", facts.vehicle},
                            {"participant", facts.participant},
                            {"seed", std::to_string(facts.seed)},
                            {"planned_s", facts.planned_s},
                            {"driver", facts.driver},
                            {"has_traffic", facts.has_traffic},
                            {"rating", std::move(rating)},
                            {"speaks", facts.speaks},
                            {"restart", std::move(restart)},
                            {"faults", facts.faults},
                            {"things", facts.things},
                            {"conditions", std::move(conditions)},
                            {"models", std::move(models)},
                            {"road", std::move(shapes)}});
}

std::string state_text(const DriveView& view, const DriveFacts& facts, std::uint64_t number,
                       const std::optional<Commander>& commander, std::size_t browsers) {
  Json json = {{"type", "state"},
               {"seq", number},
               {"phase", view.phase},
               {"paused", view.is_paused},
               {"wall_s", rounded(view.wall_s, 0.001)},
               {"real_time_factor", rounded(view.real_time_factor, 0.01)},
               {"browsers", browsers},
               {"commander", nullptr},
               {"leader", nullptr},
               {"actuators", nullptr},
               {"screens", screens_of(view, facts.tick_rate_hz)},
               {"triggers", view.triggers},
               {"hazards", view.hazards},
               {"instructor_brakes", view.instructor_brakes},
               {"faults", view.faults}};
  json["fault"] = view.fault ? Json(*view.fault) : Json(nullptr);
  json["alarm"] = view.alarm;
  if (view.has_actuators) json["actuators"] = {{"cut", json["fault"]}};
  if (commander) json["commander"] = {{"browser", commander->browser}, {"name", commander->name}};
  json["rating"] = {{"minute", view.rating.minute}, {"answered", view.rating.value.has_value()}};
  if (view.rating.value) json["rating"]["value"] = *view.rating.value;
  Json entities = Json::array();
  for (const auto& [name, is_there] : view.entities) entities.push_back({{"name", name}, {"shown", is_there}});
  json["entities"] = std::move(entities);
  Json lying = Json::array();
  for (const ThingView& thing : view.lying)
    lying.push_back(
        {{"id", thing.id}, {"name", thing.name}, {"x_m", rounded(thing.x_m, 0.01)}, {"y_m", rounded(thing.y_m, 0.01)}});
  json["lying"] = std::move(lying);
  Json conditions = Json::array();
  for (const double value : view.conditions) conditions.push_back(rounded(value, 0.0001));
  json["conditions"] = std::move(conditions);
  if (view.leader)
    json["leader"] = {{"id", view.leader->participant},
                      {"gap_m", rounded(view.leader->gap_m, 0.1)},
                      {"speed_mps", rounded(view.leader->speed_mps, 0.1)}};
  if (!view.newest) return document::line_of(json);
  const Snapshot& snapshot = view.newest->snapshot();
  const DriverCar& car = snapshot.driver_car;
  json["tick"] = snapshot.tick;
  json["sim_s"] = rounded(snapshot.simulated_time_s, 0.001);
  json["car"] = {{"speed_mps", rounded(car.speed_mps, 0.01)},
                 {"gear", car.gear},
                 {"rpm", rounded(car.engine_radps * 30.0 / std::numbers::pi, 1.0)},
                 {"accelerator", rounded(car.accelerator, 0.01)},
                 {"brake", rounded(car.brake, 0.01)},
                 {"wheel_rad", rounded(car.steering_wheel_rad, 0.001)},
                 {"lane", car.lane},
                 {"road_s_m", rounded(car.road_s_m, 0.1)},
                 {"lateral_m", rounded(car.lateral_position_m, 0.01)},
                 {"lane_width_m", rounded(car.lane_width_m, 0.01)}};
  json["collisions"] = snapshot.diagnostics.collisions;
  json["everybody"] = everybody(snapshot);
  return document::line_of(json);
}

std::string answer_text(std::uint64_t id, const std::optional<std::string>& why_not) {
  Json json = {{"type", "answer"}, {"id", id}, {"ok", !why_not}};
  if (why_not) json["why"] = *why_not;
  return document::line_of(json);
}

std::string thumbnail_text(const std::string& screen, std::string_view picture) {
  return document::line_of({{"type", "thumbnail"}, {"screen", screen}, {"picture", picture_address(picture)}});
}

std::string large_picture_text(const std::string& screen, std::string_view picture) {
  return document::line_of({{"type", "large_picture"}, {"screen", screen}, {"picture", picture_address(picture)}});
}

std::string event_text(const PageEvent& event) {
  Json values = Json::object();
  for (const auto& [name, value] : event.values) values[name] = value;
  return document::line_of({{"type", "event"},
                            {"sim_s", rounded(event.simulated_s, 0.01)},
                            {"kind", event.kind},
                            {"values", std::move(values)},
                            {"text", event.text}});
}

std::string lesson_text(const LessonView& lesson) {
  Json tasks = Json::array(), faults = Json::array();
  for (const LessonTaskView& task : lesson.tasks)
    tasks.push_back({{"mark", task.mark ? rounded(*task.mark, 0.1) : Json(nullptr)},
                     {"severity", task.severity},
                     {"faults", task.faults}});
  for (const LessonFaultView& fault : lesson.faults)
    faults.push_back({{"number", fault.number},
                      {"task", fault.task},
                      {"from_s", rounded(fault.from_s, 0.1)},
                      {"to_s", rounded(fault.to_s, 0.1)},
                      {"worst", rounded(fault.worst, 0.1)},
                      {"at", fault.at},
                      {"severity", fault.severity}});
  return document::line_of({{"type", "lesson"},
                            {"tasks", std::move(tasks)},
                            {"mark", lesson.mark ? rounded(*lesson.mark, 0.1) : Json(nullptr)},
                            {"passed", lesson.passed},
                            {"faults", std::move(faults)}});
}

std::string still_text(std::uint32_t fault, std::string_view picture) {
  return document::line_of({{"type", "still"}, {"fault", fault}, {"picture", picture_address(picture)}});
}

}  // namespace septet::page
