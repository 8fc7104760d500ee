#include <doctest/doctest.h>

#include "engine/world/people_errors.hpp"

namespace septet {

TEST_CASE("rates of errors and a wish to be overlooked come back from their texts") {
  PeopleErrorRates rates;
  rates.per_hour = {6.0, 1.0 / 3.0, 0.0, most_errors_per_hour};
  const auto read = read_error_rates(text_of(rates));
  REQUIRE(read.has_value());
  CHECK(*read == rates);
  CHECK(read_error_rates("telephone=2")->per_hour == decltype(rates.per_hour){0.0, 0.0, 2.0, 0.0});
  for (const OverlookWish& wish : {OverlookWish{}, OverlookWish{1007, ""}, OverlookWish{{}, "the grey = car"},
                                   OverlookWish{1007, "the grey car"}}) {
    const auto again = read_overlook_wish(text_of(wish));
    REQUIRE(again.has_value());
    CHECK(*again == wish);
  }
}

TEST_CASE("rates that are none, unknown, twice or out of range, and wishes of another form, are refused") {
  for (const char* text : {"", " ", "overlook", "overlook=", "overlook=-1", "overlook=1001", "overlook=nan", "sleep=1",
                           "red=1 red=1", "red=1  telephone=1", "red=1x"})
    CHECK_MESSAGE(!read_error_rates(text).has_value(), text);
  for (const char* text : {"1007", "who=", "who=-1", "who=me", "whom=", "who=1 1", "whom=a\nb", "him"})
    CHECK_MESSAGE(!read_overlook_wish(text).has_value(), text);
}

TEST_CASE("the log is told who overlooks whom, for how long, how it ended and how near they came") {
  ToldError told{.kind = PeopleError::overlook, .who = 1007, .whom = 1, .lasted_s = 0.0, .end = {}, .nearest_m = {}};
  CHECK(text_of(told) == "state=begins kind=overlook whom=1");
  told.lasted_s = 3.456;
  told.end = ErrorEnd::parted;
  told.nearest_m = 0.814;
  CHECK(text_of(told) == "state=ends kind=overlook whom=1 lasted_s=3.46 ended=parted nearest_m=0.81");
}

}  // namespace septet
