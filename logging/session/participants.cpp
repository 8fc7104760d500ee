#include "logging/session/participants.hpp"

#include <charconv>
#include <optional>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "engine/core/printable.hpp"
#include "engine/document/json.hpp"
#include "engine/world/rider.hpp"
#include "engine/world/solid.hpp"
#include "logging/session/shallow_json.hpp"

namespace septet::logging {
namespace {

constexpr std::size_t longest_name_bytes = 100, most_listed = 12;

std::optional<ParticipantId> number_in(std::string_view text) {
  ParticipantId number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

Expected<ParticipantNames> names_of_scenario(const SessionReader& session) {
  ParticipantNames names;
  const auto& other = session.info().other;
  const auto row = other.find("participant_names");
  if (row == other.end()) return names;
  const auto json = shallow_json(row->second);
  bool is_written = json && json->is_object();
  if (is_written)
    for (const auto& [key, value] : json->items()) {
      const auto number = number_in(key);
      is_written = is_written && number && value.is_string();
      if (is_written) names.emplace(*number, value.get<std::string>());
    }
  if (!is_written)
    return failure("the meta row participant_names is not what Septet writes", session.path().string(),
                   "it was altered or damaged: use an unaltered copy");
  return names;
}

}  // namespace

Expected<ParticipantNames> participant_names(const SessionReader& session) {
  auto names = names_of_scenario(session);
  if (!names) return names;
  const auto events = session.events();
  if (!events) return tl::unexpected(events.error());
  for (const Event& event : *events)
    if (event.kind == operator_command_kind)
      if (const auto solid = named_solid(event.detail))
        names->insert_or_assign(solid->participant, std::string(solid->name));
  ParticipantNames riders;
  for (const auto& [number, name] : *names)
    if (number < first_rider_participant) riders.emplace(rider_of(number), name + " rider");
  names->merge(riders);
  return names;
}

std::optional<ParticipantId> number_of(const ParticipantNames& names, std::string_view text) {
  for (const auto& [number, name] : names)
    if (name == text) return number;
  return number_in(text);
}

std::string called(const Stay& stay) {
  const std::string_view model = vehicle_models()[stay.model].name;
  if (stay.name.empty()) return fmt::format("{} ({})", stay.number, model);
  return fmt::format("{} {} ({})", stay.number, printable(stay.name, longest_name_bytes), model);
}

std::string called(const ParticipantNames& names, const Participant& participant) {
  const auto name = names.find(participant.id);
  return called(Stay{.number = participant.id,
                     .name = name == names.end() ? std::string() : name->second,
                     .model = participant.model});
}

std::string called(const ParticipantNames& names, ParticipantId number) {
  const auto name = names.find(number);
  return name == names.end() ? fmt::format("{}", number)
                             : fmt::format("{} {}", number, printable(name->second, longest_name_bytes));
}

Expected<std::vector<Stay>> stays_of(const SessionReader& session) {
  const auto names = participant_names(session);
  if (!names) return tl::unexpected(names.error());
  if (const auto shown = session.shown_span_s(); !shown) return tl::unexpected(shown.error());
  auto cursor = session.snapshots();
  if (!cursor) return tl::unexpected(cursor.error());
  std::map<ParticipantId, Stay> stays;
  for (;;) {
    const auto world = cursor->next();
    if (!world) return tl::unexpected(world.error());
    if (!*world) break;
    for (const Participant& participant : (*world)->participants) {
      const auto [stay, is_new] = stays.try_emplace(participant.id);
      if (is_new) {
        const auto name = names->find(participant.id);
        stay->second = {.number = participant.id,
                        .name = name == names->end() ? std::string() : name->second,
                        .model = participant.model,
                        .from_s = (*world)->simulated_time_s};
      }
      stay->second.is_driver |= participant.id == (*world)->driver_car.participant;
      stay->second.to_s = (*world)->simulated_time_s;
    }
  }
  std::vector<Stay> all;
  all.reserve(stays.size());
  for (auto& [number, stay] : stays) all.push_back(std::move(stay));
  return all;
}

Expected<Stay> find_stay(const SessionReader& session, std::string_view text, const std::string& where) {
  const auto names = participant_names(session);
  if (!names) return tl::unexpected(names.error());
  const auto stays = stays_of(session);
  if (!stays) return tl::unexpected(stays.error());
  const auto number = number_of(*names, text);
  for (const Stay& stay : *stays)
    if (number ? stay.number == *number : text == "driver" && stay.is_driver) return stay;
  std::string list;
  for (std::size_t i = 0; i < stays->size() && i < most_listed; ++i)
    list += fmt::format("{}{}", i > 0 ? ", " : "", called((*stays)[i]));
  if (stays->size() > most_listed) list += fmt::format(" and {} more", stays->size() - most_listed);
  return failure(fmt::format("nobody called \"{}\" takes part in the session", printable(text, longest_name_bytes)),
                 where, fmt::format("choose the name or number of one of these: {}", list));
}

}  // namespace septet::logging
