#include <doctest/doctest.h>

#include "engine/world/people.hpp"

namespace septet {

TEST_CASE("a wish for people is read in any order, with what it leaves out as usual") {
  CHECK(*read_people_wish("") == PeopleWish{});
  CHECK(*read_people_wish("count=0") == PeopleWish{0, PeopleWish{}.radius_m});
  CHECK(*read_people_wish("radius_m=300 count=40") == PeopleWish{40, 300.0});
}

TEST_CASE("a wish for people of another form, or out of range, is refused") {
  for (const char* text :
       {"40", "count=", "count=-1", "count=1001", "radius_m=10", "radius_m=nan", "people=4", "count=4,"})
    CHECK_MESSAGE(!read_people_wish(text).has_value(), text);
}

}  // namespace septet
