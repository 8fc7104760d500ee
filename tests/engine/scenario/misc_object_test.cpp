#include "engine/scenario/model/misc_object.hpp"

#include <cmath>

#include <doctest/doctest.h>

namespace septet::scenario {
namespace {

Entity thing(const char* name, const char* category, double mass_kg) {
  Entity entity;
  entity.kind = EntityKind::misc_object;
  entity.type_name = name;
  entity.category = category;
  entity.mass_kg = mass_kg;
  entity.box = {{0.1, 0.0, 0.6}, 0.8, 0.7, 1.2};
  return entity;
}

}  // namespace

TEST_CASE("an object is a box unless it breaks, lies flat, or its box holds nothing") {
  CHECK(object_form(thing("bin", "obstacle", 15.0)) == ObjectForm::box);
  CHECK(object_form(thing("hall", "building", 0.0)) == ObjectForm::box);
  CHECK(object_form(thing("traffic-cone", "obstacle", 2.5)) == ObjectForm::breakable);
  CHECK(object_form(thing("arrow", "roadMark", 0.0)) == ObjectForm::flat);
  Entity empty = thing("bin", "obstacle", 15.0);
  empty.box.height_m = 0.0;
  CHECK(object_form(empty) == ObjectForm::none);
  Entity car = thing("saloon", "car", 1450.0);
  car.kind = EntityKind::vehicle;
  CHECK(object_form(car) == ObjectForm::none);
}

TEST_CASE(
    "a box is pushed by its mass, and stands fast without one, if it is too heavy, and if it is fixed in the ground") {
  CHECK(pushed_kg(thing("bin", "obstacle", 15.0)) == 15.0);
  CHECK(pushed_kg(thing("block", "barrier", 900.0)) == 900.0);
  for (const Entity& fast : {thing("bin", "obstacle", 0.0), thing("container", "obstacle", 24'000.0),
                             thing("hall", "building", 100.0), thing("mast", "pole", 80.0)})
    CHECK(std::isinf(pushed_kg(fast)));
}

TEST_CASE("a box stands on the middle of its bottom") {
  const Vec3 foot_m = foot_of_box_m(thing("bin", "obstacle", 15.0));
  CHECK(foot_m == Vec3(0.1, 0.0, 0.0));
}

}  // namespace septet::scenario
