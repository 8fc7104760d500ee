#include "sim-server/drive/told_on_page.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "engine/world/call.hpp"

namespace septet::server {
namespace {

/// Commands of an operator are left out, since another event reports them with the operator's name.
constexpr std::array unheard{std::string_view("scenario"),   std::string_view("mirror_glance"),
                             std::string_view("turn"),       std::string_view("fracture"),
                             std::string_view("visibility"), logging::operator_command_kind};
/// Kinds whose detail is a sentence.
constexpr std::array sentences{std::string_view("screen"), std::string_view("car"), std::string_view("traffic")};

bool is_name(std::string_view word) {
  return !word.empty() &&
         std::ranges::all_of(word, [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; });
}

/// What the sound tells (host/live_sound.hpp), taken apart: "no sound: DEVICE: WHY; REMEDY", "sound: DEVICE". Empty for
/// another sentence.
std::optional<page::PageEvent> told_of_sound(const logging::Event& event) {
  constexpr std::string_view none = "no sound: ", some = "sound: ";
  const std::string_view text = event.detail;
  if (text.starts_with(some))
    return page::PageEvent{
        event.simulated_time_s, "sound", {{"device", std::string(text.substr(some.size()))}}, event.detail};
  // A device may have any name; the remedy may have a semicolon too.
  const auto remedy = text.find("; "), why = text.substr(0, remedy).rfind(": ");
  if (!text.starts_with(none) || remedy == text.npos || why < none.size()) return std::nullopt;
  return page::PageEvent{event.simulated_time_s,
                         "no_sound",
                         {{"device", std::string(text.substr(none.size(), why - none.size()))},
                          {"why", std::string(text.substr(why + 2, remedy - why - 2))},
                          {"remedy", std::string(text.substr(remedy + 2))}},
                         event.detail};
}

}  // namespace

std::vector<std::pair<std::string, std::string>> values_of(std::string_view detail) {
  std::vector<std::pair<std::string, std::string>> values;
  while (!detail.empty()) {
    const std::string_view word = detail.substr(0, detail.find(' '));
    detail.remove_prefix(std::min(word.size() + 1, detail.size()));
    const auto equals = word.find('=');
    // Text by a person comes last and may contain equals signs too.
    const bool is_free = !values.empty() && (values.back().first == "note" || values.back().first == "reason" ||
                                             values.back().first == "text");
    if (equals != word.npos && is_name(word.substr(0, equals)) && !is_free)
      values.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    else if (values.empty())
      values.emplace_back("what", word);
    else
      values.back().second += ' ' + std::string(word);
  }
  for (auto& [name, value] : values)
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
  return values;
}

std::vector<std::pair<std::string, std::string>> values_of(std::string_view kind, std::string_view detail) {
  if (kind == call_event)
    if (const auto call = read_call(detail)) return words_of(*call);
  return values_of(detail);
}

std::optional<page::PageEvent> told_on_page(const logging::Event& event) {
  if (std::ranges::find(unheard, event.kind) != unheard.end()) return std::nullopt;
  if (auto sound = event.kind == "screen" ? told_of_sound(event) : std::nullopt) return sound;
  if (std::ranges::find(sentences, event.kind) != sentences.end())
    return page::PageEvent{event.simulated_time_s, "message", {}, event.detail};
  page::PageEvent told{.simulated_s = event.simulated_time_s,
                       .kind = event.kind,
                       .values = values_of(event.kind, event.detail),
                       .text = event.kind};
  std::ranges::replace(told.text, '_', ' ');
  std::string separator = ": ";
  for (const auto& [name, value] : told.values) {
    std::string words = name == "what" ? "" : name + ' ';
    std::ranges::replace(words, '_', ' ');
    told.text += fmt::format("{}{}{}", separator, words, value);
    separator = ", ";
  }
  return told;
}

}  // namespace septet::server
