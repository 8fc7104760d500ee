#pragma once
/// Messages of a DBC file while it is read: some are left unread, each for its first reason, and attributes stand far
/// from their message. For dbc.cpp.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "car-io/can/dbc.hpp"
#include "engine/core/expected.hpp"

namespace septet::car_io::dbc {

/// Frame format as in the file: an index, or a name in quotes.
struct FrameFormat {
  double index = 0.0;
  std::optional<std::string> name;
};

/// A message is named by its place, in the file's order.
class Draft {
 public:
  static constexpr std::size_t most_messages = 10'000;
  static constexpr double longest_period_ms = 600'000.0;

  /// Empty, and nothing added, where it has the most.
  std::optional<std::size_t> add(std::string_view name);
  std::size_t size() const { return messages_.size(); }
  Message& operator[](std::size_t place) { return messages_[place]; }

  /// Such a message refuses the file only for a rig that names it. The first reason stays.
  void leave_unread(std::size_t place, const Error& why);
  bool is_unread(std::size_t place) const { return unread_.contains(place); }

  /// The earlier message with that identifier, as the file writes it, or name; the new one takes it where there is none.
  std::optional<std::size_t> take_number(std::size_t place, std::uint64_t number);
  std::optional<std::size_t> take_name(std::size_t place);
  std::optional<std::size_t> find(std::uint64_t number) const;

  /// 0: it has none, and the default is not for it either.
  void set_period(std::size_t place, double period_ms);
  void set_default_period(double period_ms) { default_period_ms_ = period_ms; }

  void set_format(std::size_t place, FrameFormat format);
  void set_default_format(FrameFormat format) { default_format_ = std::move(format); }
  /// The names of the formats, by their index, where the file lists them.
  void set_format_names(std::vector<std::string> names) { format_names_ = std::move(names); }

  Database finish() &&;

 private:
  bool is_fd(const FrameFormat& format) const;

  std::vector<Message> messages_;
  std::map<std::size_t, Error> unread_;  ///< By place, likewise the formats.
  std::map<std::uint64_t, std::size_t> numbers_;
  std::map<std::string, std::size_t> names_;
  std::set<std::string> periodless_;
  double default_period_ms_ = 0.0;
  std::map<std::size_t, FrameFormat> formats_;
  std::optional<FrameFormat> default_format_;
  std::vector<std::string> format_names_;
};

}  // namespace septet::car_io::dbc
