#include "engine/world/people.hpp"

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "engine/core/printable.hpp"

namespace septet {
namespace {

template <class Number>
bool read_as(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

tl::unexpected<Error> no_people(std::string what) {
  return failure(std::move(what), "people",
                 fmt::format("write count=N, at most {}, radius_m=R from {:g} to {:g}, or both", most_people,
                             least_people_radius_m, most_people_radius_m));
}

}  // namespace

Expected<PeopleWish> read_people_wish(std::string_view text) {
  constexpr std::string_view count = "count=", radius = "radius_m=";
  PeopleWish wish;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    if (word.starts_with(count)) {
      if (!read_as(word.substr(count.size()), wish.count) || wish.count > most_people)
        return no_people("the number of people is out of range");
    } else if (word.starts_with(radius)) {
      if (!read_as(word.substr(radius.size()), wish.radius_m) ||
          !(wish.radius_m >= least_people_radius_m && wish.radius_m <= most_people_radius_m))
        return no_people("the radius within which people walk is out of range");
    } else {
      return no_people(fmt::format("\"{}\" says nothing of people", printable(word)));
    }
  }
  return wish;
}

}  // namespace septet
