#include <vector>

#include <doctest/doctest.h>

#include "engine/world/people_errors.hpp"
#include "logging/session/records.hpp"
#include "logging/study/report/told_event.hpp"

namespace septet::logging {

TEST_CASE("the report tells which vehicle errs, and how and how near to whom it ended") {
  ToldError told{.kind = PeopleError::overlook, .who = 1007, .whom = 1, .lasted_s = 0.0, .end = {}, .nearest_m = {}};
  const auto sentence = [&] {
    Event event;
    event.kind = people_error_event;
    event.participant = told.who;
    event.detail = text_of(told);
    return tell_events({event}, {}).front().says;
  };
  CHECK(sentence() == "participant 1007 errs: overlook (of participant 1)");
  told.end = ErrorEnd::parted;
  told.nearest_m = 0.8;
  CHECK(sentence() ==
        "participant 1007 errs no more: overlook (of participant 1), parted, 0.80 m apart at the nearest");
}

}  // namespace septet::logging
