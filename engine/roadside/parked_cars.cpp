#include "engine/roadside/parked_cars.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "engine/core/check.hpp"
#include "engine/core/random.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/roadside/town.hpp"
#include "engine/world/paint.hpp"

namespace septet::roadside {
namespace {

constexpr double least_width_m = 1.9, before_and_behind_m = 0.9, share_taken = 0.45;
constexpr std::array<std::string_view, 8> models{"hatchback", "hatchback", "saloon", "estate",
                                                 "hatchback", "suv",       "mpv",    "van"};

class Row {
 public:
  Row(const RoadShape& roads, road::RoadIndex index, int lane, std::vector<ParkedCar>& cars)
      : roads_(roads), index_(index), lane_(lane), cars_(cars) {}

  void fill(const road::LaneSection& section, double from_m, double to_m, Random& random) {
    double s = from_m + random.uniform(0.0, 4.0);
    while (s < to_m && cars_.size() < most_parked_cars) {
      const std::string_view name = models[random.below(models.size())];
      const bool taken = random.uniform() < share_taken;
      const auto paint = static_cast<std::uint8_t>(random.below(body_colors.size()));
      const double askew_m = random.uniform(-0.05, 0.05);
      const auto model = find_vehicle_model(name);
      SEPTET_CHECK(model.has_value(), "no vehicle model {}", name);
      const double length_m = vehicle_models()[*model].length_m, end_m = s + length_m + before_and_behind_m;
      if (end_m > to_m) return;
      if (taken && is_wide(section, s) && is_wide(section, end_m))
        place(section, *model, paint, 0.5 * (s + end_m), askew_m);
      s = end_m;
    }
  }

 private:
  bool is_wide(const road::LaneSection& section, double s_m) const {
    return road::lane_borders(roads_.road(index_), section, lane_, s_m).width_m() >= least_width_m;
  }

  void place(const road::LaneSection& section, ModelIndex index, std::uint8_t paint, double s_m, double askew_m) {
    const road::Road& road = roads_.road(index_);
    const VehicleModel& model = vehicle_models()[index];
    const double t_m = road::lane_borders(road, section, lane_, s_m).centre_t_m() + askew_m;
    const road::RoadPoint at = roads_.at(index_, s_m, t_m);
    const bool along = road::runs_along_s(road, section, lane_);
    const double heading = at.heading_rad + (along ? 0.0 : std::numbers::pi);
    const double back_m = model.centre_x_m();  // A vehicle's frame lies at its rear axle.
    cars_.push_back({index,
                     paint,
                     {at.position_m - back_m * Vec3(std::cos(heading), std::sin(heading), 0.0),
                      orientation_from_angles(heading, along ? at.pitch_rad : -at.pitch_rad, 0.0)}});
  }

  const RoadShape& roads_;
  road::RoadIndex index_;
  int lane_;
  std::vector<ParkedCar>& cars_;
};

}  // namespace

std::vector<ParkedCar> parked_cars(const RoadShape& roads, std::uint64_t seed) {
  std::vector<ParkedCar> cars;
  for (road::RoadIndex index = 0; index < roads.network().roads.size(); ++index) {
    const road::Road& road = roads.road(index);
    if (road.junction != road::no_index || !is_in_town(roads.network(), index, 0.5 * road.length_m)) continue;
    for (std::size_t n = 0; n < road.sections.size(); ++n) {
      const road::LaneSection& section = road.sections[n];
      const double end_m = n + 1 < road.sections.size() ? road.sections[n + 1].s_m : road.length_m;
      for (const road::Lane& lane : section.lanes) {
        if (lane.type != road::LaneType::parking) continue;
        Random random(seed, 9000 + 64 * static_cast<std::uint64_t>(index) + static_cast<std::uint64_t>(lane.id + 32));
        Row(roads, index, lane.id, cars).fill(section, section.s_m, end_m, random);
      }
    }
  }
  return cars;
}

}  // namespace septet::roadside
