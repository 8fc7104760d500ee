#pragma once
/// One instant of a session around one pair of eyes, for lines of sight: participants, debris, the observer's own
/// pillars and roof, glass, smoke, fog, and the standing world.
///
/// Surfaces are those of the ray tracer (raytrace::World), by the same triangles, holes, glass with its mirroring, frost
/// and cracks. Left out: still ice. Panes of the observer's own vehicle count as clear, but for
/// frost and cracks on them.
///
/// One thread at a time; several may share the standing world.

#include <functional>
#include <memory>

#include "engine/instant/atmosphere.hpp"
#include "engine/raytrace/world.hpp"
#include "engine/sight/silhouette.hpp"
#include "sim-client/sight/observer.hpp"
#include "sim-client/sight/standing_world.hpp"

namespace septet::sight {

class ObservedWorld {
 public:
  /// Error: Embree does not start on this machine. Both outlive it.
  static Expected<ObservedWorld> create(const SceneParts& scene, const StandingWorld& standing);
  ObservedWorld(ObservedWorld&&) noexcept;
  ObservedWorld& operator=(ObservedWorld&&) noexcept;
  ~ObservedWorld();

  /// Takes an instant. `add_effects` adds its debris, dents, frost and smoke to a frame of it, as
  /// frame::EffectsDrawing::add_to does; empty: it has none.
  void take(const Snapshot& world, std::function<void(instant::FrameInput&)> add_effects = {});
  /// Takes the eyes of a participant of that instant (checked).
  void look_from(ParticipantId observer, const DriverSeat& seat);

  const Vec3& eye_m() const;  ///< World.
  /// Description of a line from the eye, or from a mirror beside it. `from_m`: where on the line it begins to count.
  OnLine along(const Line& line, ParticipantId target, double from_m = 0.0) const;
  /// Share of light that passes along a line for `length_m`, past all bodies.
  double transmittance(const Line& line, double length_m) const;

 private:
  struct Parts;
  explicit ObservedWorld(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace septet::sight
