#include "engine/world/people_errors.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

#include <fmt/format.h>

#include "engine/core/printable.hpp"

namespace septet {
namespace {

constexpr std::size_t longest_name = 200;

template <class Number>
bool read_number(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

std::string_view name_of(ErrorEnd end) {
  constexpr std::array<std::string_view, 7> names{"parted", "touched", "seen", "passed", "stood", "unmet", "gone"};
  return names[static_cast<std::size_t>(end)];
}

tl::unexpected<Error> no_rates(std::string what) {
  return failure(std::move(what), "errors of people",
                 fmt::format("write overlook=N late_brake=N telephone=N red=N, or some of them, each from 0 to {:g} an "
                             "hour of driving",
                             most_errors_per_hour));
}

tl::unexpected<Error> no_wish(std::string what) {
  return failure(
      std::move(what), "overlook",
      "write nothing, who=NUMBER of a vehicle of the traffic, whom=NAME of an entity, or both in this order");
}

}  // namespace

Expected<PeopleErrorRates> read_error_rates(std::string_view text) {
  PeopleErrorRates rates;
  std::array<bool, people_error_names.size()> is_given{};
  if (text.empty()) return no_rates("no rate is given");
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    const auto equals = word.find('=');
    const auto found = std::ranges::find(people_error_names, word.substr(0, equals));
    if (equals == word.npos || found == people_error_names.end())
      return no_rates(fmt::format("\"{}\" is no kind of error with a rate", printable(word)));
    const auto kind = static_cast<std::size_t>(found - people_error_names.begin());
    if (is_given[kind]) return no_rates(fmt::format("{} is given twice", *found));
    is_given[kind] = true;
    double& rate = rates.per_hour[kind];
    if (!read_number(word.substr(equals + 1), rate) || !(rate >= 0.0 && rate <= most_errors_per_hour))
      return no_rates(fmt::format("the rate of {} is out of range", *found));
  }
  return rates;
}

std::string text_of(const PeopleErrorRates& rates) {
  std::string text;
  for (std::size_t kind = 0; kind < people_error_names.size(); ++kind)
    text += fmt::format("{}{}={}", kind == 0 ? "" : " ", people_error_names[kind], rates.per_hour[kind]);
  return text;
}

Expected<OverlookWish> read_overlook_wish(std::string_view text) {
  constexpr std::string_view who = "who=", whom = "whom=";
  OverlookWish wish;
  if (text.starts_with(who)) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    ParticipantId id = 0;
    if (!read_number(word.substr(who.size()), id)) return no_wish("this is no participant's number");
    wish.who = id;
  }
  if (text.empty()) return wish;
  wish.whom = text.starts_with(whom) ? text.substr(whom.size()) : "";
  if (wish.whom.empty() || wish.whom.size() > longest_name || !printable_characters(wish.whom))
    return no_wish("it is not told who overlooks whom");
  return wish;
}

std::string text_of(const OverlookWish& wish) {
  return fmt::format("{}{}{}{}", wish.who ? fmt::format("who={}", *wish.who) : "",
                     wish.who && !wish.whom.empty() ? " " : "", wish.whom.empty() ? "" : "whom=", wish.whom);
}

std::string text_of(const ToldError& told) {
  std::string text = fmt::format("state={} kind={}", told.end ? "ends" : "begins", name_of(told.kind));
  if (told.whom) text += fmt::format(" whom={}", *told.whom);
  if (!told.end) return text;
  text += fmt::format(" lasted_s={:.2f} ended={}", told.lasted_s, name_of(*told.end));
  if (told.nearest_m) text += fmt::format(" nearest_m={:.2f}", *told.nearest_m);
  return text;
}

}  // namespace septet
