#include "command-line/command/edit/edit_output.hpp"

#include <ostream>
#include <variant>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"
#include "engine/editor/shown_pose.hpp"
#include "engine/world/vehicle_model.hpp"
#include "sim-server/drive/told_on_page.hpp"

namespace septet::server {
namespace {

using Json = nlohmann::json;

Json of(const Vec3& v) { return {v.x, v.y, v.z}; }
Json of(const Quat& q) { return {q.w, q.x, q.y, q.z}; }

Json of(const control::DriveEvent& event) {
  Json fields = Json::object();
  for (const auto& [name, value] : values_of(event.kind, event.detail)) fields[name] = value;
  return {{"tick", event.tick},
          {"time_s", event.simulated_time_s},
          {"name", event.kind},
          {"participant", event.has_participant ? Json(event.participant) : Json(nullptr)},
          {"fields", std::move(fields)}};
}

void put(std::ostream& out, const Json& object) {
  // Names may hold any bytes.
  out << object.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n' << std::flush;
}

}  // namespace

void EditOutput::hello(const std::string& name, double tick_rate_hz, bool lockstep, Tick tick,
                       const std::vector<std::pair<std::string, std::uint32_t>>& names) const {
  if (!json_) return;
  Json by_name = Json::object();
  for (const auto& [text, number] : names) by_name[text] = number;
  put(out_, {{"type", "hello"},
             {"name", name},
             {"tick_rate_hz", tick_rate_hz},
             {"lockstep", lockstep},
             {"tick", tick},
             {"participants", std::move(by_name)}});
}

void EditOutput::done(std::uint64_t request, Tick tick, const std::vector<std::string>& messages) const {
  if (json_)
    return put(out_, {{"type", "answer"}, {"request", request}, {"ok", true}, {"tick", tick}, {"messages", messages}});
  // What writes a file shows nothing.
  out_ << (tick == 0 ? fmt::format("{}: done\n", request)
                     : fmt::format("{}: done, shown from tick {} on\n", request, tick));
  for (const std::string& message : messages) out_ << "  " << printable(message) << '\n';
  out_ << std::flush;
}

void EditOutput::refused(std::uint64_t request, const FailedLines& failed) const {
  if (json_) {
    const FailedLine& first = failed.lines.front();
    Json failures = Json::array();
    for (const FailedLine& one : failed.lines)
      failures.push_back({{"line", one.line}, {"text", one.text}, {"node", one.node}, {"why", one.why}});
    return put(out_, {{"type", "answer"},
                      {"request", request},
                      {"ok", false},
                      {"line", first.line},
                      {"text", first.text},
                      {"why", first.why},
                      {"failures", std::move(failures)},
                      {"others", failed.others}});
  }
  for (const FailedLine& one : failed.lines)
    out_ << fmt::format("{}: nothing is done, for line {} ({}): {}\n", request, one.line, printable(one.text, 80),
                        printable(one.why));
  if (failed.others > 0) out_ << fmt::format("{}: {} more commands could not be done\n", request, failed.others);
  out_ << std::flush;
}

void EditOutput::nodes(std::uint64_t request, const std::vector<scene::NodeId>& found, const scene::TextNames& names,
                       const Snapshot& now) const {
  Json list = Json::array();
  for (const scene::NodeId id : found) {
    const scene::Node* node = names.store.find(id);
    const auto* object = node ? std::get_if<scene::ObjectData>(&node->data) : nullptr;
    const RigidTransform pose = object ? editor::shown_pose(*node, now) : RigidTransform{};
    const std::string word = scene::word_of(names, id);
    if (!json_) {
      out_ << word;
      if (object)
        out_ << fmt::format("  at {:.2f} {:.2f} {:.2f}{}", pose.position_m.x, pose.position_m.y, pose.position_m.z,
                            object->hidden ? ", hidden" : "");
      out_ << '\n';
      continue;
    }
    Json entry{{"node", word}, {"id", id}, {"name", node ? node->name : ""}};
    if (object) {
      const glm::vec3 scale = object->transform.scale;
      entry["position"] = of(pose.position_m);
      entry["wxyz"] = of(pose.orientation);
      entry["scale"] = {scale.x, scale.y, scale.z};
      entry["visible"] = !object->hidden;
    }
    list.push_back(std::move(entry));
  }
  if (json_) return put(out_, {{"type", "nodes"}, {"request", request}, {"nodes", std::move(list)}});
  out_ << fmt::format("{}: {} found\n", request, found.size()) << std::flush;
}

void EditOutput::lines(std::uint64_t request, const std::vector<std::string>& lines) const {
  if (json_) return put(out_, {{"type", "lines"}, {"request", request}, {"lines", lines}});
  for (const std::string& line : lines) out_ << line << '\n';
  out_ << std::flush;
}

void EditOutput::tick(const Snapshot& snapshot, std::span<const control::DriveEvent> events,
                      std::uint64_t dropped) const {
  Json happened = Json::array();
  for (const control::DriveEvent& event : events) happened.push_back(of(event));
  Json everybody = Json::array();
  for (const Participant& p : snapshot.participants)
    everybody.push_back({{"id", p.id},
                         {"model", vehicle_models()[p.model].name},
                         {"position", of(p.world_from_vehicle.position_m)},
                         {"wxyz", of(p.world_from_vehicle.orientation)},
                         {"velocity", of(p.velocity_mps)}});
  const DriverCar& car = snapshot.driver_car;
  put(out_, {{"type", "tick"},
             {"tick", snapshot.tick},
             {"time_s", snapshot.simulated_time_s},
             {"everybody", std::move(everybody)},
             {"events", std::move(happened)},
             {"dropped_events", dropped},
             {"collisions", snapshot.diagnostics.collisions},
             {"rain_mm_per_h", snapshot.environment.rain_mm_per_h},
             {"visibility_m", snapshot.environment.visibility_m},
             {"car",
              {{"id", car.participant},
               {"speed_mps", car.speed_mps},
               {"gear", car.gear},
               {"steering_wheel_rad", car.steering_wheel_rad},
               {"accelerator", car.accelerator},
               {"brake", car.brake},
               {"clutch", car.clutch},
               {"yaw_rate_radps", car.yaw_rate_radps},
               {"gaze_heading_rad", car.gaze_heading_rad},
               {"road", car.road},
               {"lane", car.lane},
               {"road_s_m", car.road_s_m},
               {"lateral_position_m", car.lateral_position_m},
               {"lane_width_m", car.lane_width_m}}}});
}

void EditOutput::message(const std::string& text) const {
  if (json_) return put(out_, {{"type", "message"}, {"text", text}});
  out_ << printable(text) << '\n' << std::flush;
}

void EditOutput::end(const std::string& why) const {
  if (json_) put(out_, {{"type", "end"}, {"why", why}});
}

}  // namespace septet::server
