#include "car-io/can/dbc_draft.hpp"

#include <utility>

namespace septet::car_io::dbc {

std::optional<std::size_t> Draft::add(std::string_view name) {
  if (messages_.size() == most_messages) return std::nullopt;
  messages_.emplace_back().name = name;
  return messages_.size() - 1;
}

void Draft::leave_unread(std::size_t place, const Error& why) { unread_.try_emplace(place, why); }

std::optional<std::size_t> Draft::take_number(std::size_t place, std::uint64_t number) {
  const auto [known, is_new] = numbers_.emplace(number, place);
  return is_new ? std::nullopt : std::optional(known->second);
}

std::optional<std::size_t> Draft::take_name(std::size_t place) {
  const auto [known, is_new] = names_.emplace(messages_[place].name, place);
  return is_new ? std::nullopt : std::optional(known->second);
}

std::optional<std::size_t> Draft::find(std::uint64_t number) const {
  const auto found = numbers_.find(number);
  return found == numbers_.end() ? std::nullopt : std::optional(found->second);
}

void Draft::set_period(std::size_t place, double period_ms) {
  if (period_ms > 0.0)
    messages_[place].period_s = period_ms / 1000.0;
  else
    periodless_.insert(messages_[place].name);
}

void Draft::set_format(std::size_t place, FrameFormat format) { formats_[place] = std::move(format); }

bool Draft::is_fd(const FrameFormat& format) const {
  if (format.name) return format.name->ends_with("_FD");
  for (std::size_t i = 0; i < format_names_.size(); ++i)
    if (format.index == static_cast<double>(i)) return format_names_[i].ends_with("_FD");
  constexpr double standard_fd = 14.0, extended_fd = 15.0;
  return format.index == standard_fd || format.index == extended_fd;
}

Database Draft::finish() && {
  const bool has_default_period = default_period_ms_ > 0.0 && default_period_ms_ <= longest_period_ms;
  Database database;
  for (std::size_t i = 0; i < messages_.size(); ++i) {
    Message& message = messages_[i];
    const auto own = formats_.find(i);
    if (own != formats_.end() || default_format_)
      message.is_fd |= is_fd(own != formats_.end() ? own->second : *default_format_);
    if (has_default_period && !message.period_s && !periodless_.contains(message.name))
      message.period_s = default_period_ms_ / 1000.0;
    const auto why = unread_.find(i);
    if (why == unread_.end()) {
      database.messages.push_back(std::move(message));
      continue;
    }
    UnreadMessage& unread = database.unread.emplace_back(UnreadMessage{message.name, {}, std::move(why->second)});
    for (const Signal& signal : message.signals) unread.signals.push_back(signal.name);
  }
  return database;
}

}  // namespace septet::car_io::dbc
