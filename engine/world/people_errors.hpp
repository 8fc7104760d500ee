#pragma once
/// Errors that people make in traffic: their kinds, how often each is made, the wish that somebody is overlooked, and what
/// the log is told of them. As texts:
///
///     overlook=6 late_brake=20 telephone=10 red=2      rates, by the hour in which one vehicle drives
///     who=1007 whom=the grey car                       a wish; both words may be missing
///
/// Pure functions.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/expected.hpp"
#include "engine/world/snapshot.hpp"

namespace septet {

enum class PeopleError : std::uint8_t {
  overlook,    ///< He does not see one other for a whole encounter.
  late_brake,  ///< He notices seconds later that the one ahead brakes, once.
  telephone,   ///< He notices nothing new for some seconds.
  red,         ///< He passes a light that has just turned red.
};
inline constexpr std::array<std::string_view, 4> people_error_names{"overlook", "late_brake", "telephone", "red"};
inline std::string_view name_of(PeopleError kind) { return people_error_names[static_cast<std::size_t>(kind)]; }

/// Impulses to err, by kind, in an hour in which one vehicle drives. An impulse becomes an error at the next occasion.
struct PeopleErrorRates {
  std::array<double, people_error_names.size()> per_hour{};

  bool any() const { return per_hour != decltype(per_hour){}; }
  bool operator==(const PeopleErrorRates&) const = default;
};
inline constexpr double most_errors_per_hour = 1000.0;

/// Kinds that are not named have the rate 0. Error: another form, or a rate below 0 or above the most.
Expected<PeopleErrorRates> read_error_rates(std::string_view text);
/// With all kinds.
std::string text_of(const PeopleErrorRates& rates);

/// The wish that somebody is overlooked.
struct OverlookWish {
  std::optional<ParticipantId> who;  ///< Of the traffic; empty: the next one who would have to give way.
  std::string whom;                  ///< Name of an entity; empty: the driver's car.
  bool operator==(const OverlookWish&) const = default;
};
/// Error: another form.
Expected<OverlookWish> read_overlook_wish(std::string_view text);
std::string text_of(const OverlookWish& wish);

/// How an error ended.
enum class ErrorEnd : std::uint8_t {
  parted,   ///< The two were near and have parted.
  touched,  ///< They have touched.
  seen,     ///< He notices again.
  passed,   ///< He has passed the red light.
  stood,    ///< He had to stand before it after all.
  unmet,    ///< Nobody came near, or nobody had to give way.
  gone,     ///< One of them is not there any more.
};

/// Beginning or end of an error, for the log.
struct ToldError {
  PeopleError kind = PeopleError::overlook;
  std::optional<ParticipantId> who, whom;  ///< Without `who`: a wish for which there was no occasion.
  double lasted_s = 0.0;                   ///< At its end; of a wish without an occasion, for which it waited.
  std::optional<ErrorEnd> end;             ///< Empty: it begins.
  std::optional<double> nearest_m;  ///< At an overlook's end: least distance of the two outlines; 0: they touched.
};
/// Kind of the event that tells of one; its participant is `who`.
inline constexpr std::string_view people_error_event = "error_of_people";
/// Its detail.
std::string text_of(const ToldError& told);

}  // namespace septet
