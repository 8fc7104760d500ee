#include "engine/scenario/model/misc_object.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/world/breakable_names.hpp"

namespace septet::scenario {
namespace {

constexpr std::array<std::string_view, 4> flat_ones{"crosswalk", "parkingSpace", "patch", "roadMark"};
constexpr std::array<std::string_view, 9> fixed_ones{"building",   "gantry",        "pole", "railing",   "soundBarrier",
                                                     "streetLamp", "trafficIsland", "tree", "vegetation"};

bool is_one_of(auto& words, std::string_view word) { return std::ranges::find(words, word) != words.end(); }

}  // namespace

ObjectForm object_form(const Entity& entity) {
  if (entity.kind != EntityKind::misc_object) return ObjectForm::none;
  if (is_one_of(breakable_names, entity.type_name)) return ObjectForm::breakable;
  if (is_one_of(flat_ones, entity.category)) return ObjectForm::flat;
  const BoundingBox& box = entity.box;
  return box.length_m > 0.0 && box.width_m > 0.0 && box.height_m > 0.0 ? ObjectForm::box : ObjectForm::none;
}

double pushed_kg(const Entity& box) {
  const bool stands_fast =
      !(box.mass_kg > 0.0) || box.mass_kg > heaviest_pushed_kg || is_one_of(fixed_ones, box.category);
  return stands_fast ? INFINITY : box.mass_kg;
}

Vec3 foot_of_box_m(const Entity& entity) { return entity.box.centre_m - Vec3(0.0, 0.0, 0.5 * entity.box.height_m); }

}  // namespace septet::scenario
