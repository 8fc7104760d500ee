#pragma once
/// Rain on the windscreen of the car whose inside is drawn, and the wipers that clear it.
///
/// Pure: both are functions of simulated time and weather, so that every screen, a replay and a film agree. On the
/// glass, metres: x to the right of its middle and y up from its foot, as the driver sees it. Wipers run once in 4 s in
/// light rain, else 45 or 60 times a minute (EU 1008/2010, annex III: one speed of at least 45, another 15 below it).

#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/instant/frame_input.hpp"
#include "engine/scene/resolved_scene.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::frame {

/// Wiper: its pivot, the reach of its blade, and its sweep from angle to angle (from x, counter-clockwise).
struct Wiper {
  glm::dvec2 pivot_m;
  double from_m, to_m;
  double rest_rad, turn_rad;
};
extern const std::vector<Wiper> wipers;
/// Parking position of wipers at rest: this far below the start of their sweep, below the cowl's line. After this share
/// of the sweep they have risen from it.
inline constexpr double parked_m = 0.10, rises_by_share = 0.08;
/// Place on the glass at `reach_m` from a wiper's pivot, at a share of its sweep.
glm::dvec2 place_on_wiper(const Wiper& wiper, double reach_m, double share);

/// Share of the sweep: 0 at rest to 1 at its other end.
double wiper_share(double rain_mm_per_h, double time_s);
/// Last instant at or before `time_s` at which a blade passed `share`. Empty without rain.
std::optional<double> last_passed_s(double rain_mm_per_h, double share, double time_s);
/// Share of its sweep at which a wiper passes this place; empty if no wiper does.
std::optional<double> swept_share(const glm::dvec2& place_m);

struct GlassDrop {
  glm::dvec2 place_m;
  double radius_m;
};
/// Drops fallen since the wipers last passed. Empty in snow.
std::vector<GlassDrop> drops_on_glass(const Environment& environment, double time_s);

/// Adds drops and wipers to a frame in which the inside of `car` is drawn. Prototypes that the scene does not have
/// (yet) are left out.
void add_windscreen(instant::FrameInput& frame, const Snapshot& shown, const Participant& car,
                    const scene::ResolvedScene& scene);

}  // namespace septet::frame
