#pragma once
/// One path as it is traced by itself, through everything that there is (path_tracer.hpp tells by which rules).

#include <array>
#include <cstdint>

#include "engine/raytrace/path_tracer.hpp"

namespace septet::raytrace {

/// A path that was begun elsewhere, at the end of an edge that begins at a matt surface under lamps alone.
struct PathMiddle {
  std::uint32_t edge = 1;  ///< Which one it is; if the first, the rest is as a path begins.
  glm::vec3 light{0.0f}, throughput{1.0f}, from_m{0.0f};
  float pdf = 0.0f;
};

/// One thread's walk along one path: by turns it arrives at the end of an edge, looks at a light from there, and leaves.
class Path {
 public:
  Path(const World& world, const PathSettings& settings, PathStart& start)
      : world_(world),
        photons_(world.photons()),
        settings_(settings),
        random_(start.random),
        ray_(start.ray),
        time_(start.ray.time),
        from_share_of_sky_(world.eye_share_of_sky()) {}
  /// In the middle of it: `edge` of its edges lie behind it or are begun, and `start` has its random numbers and the last edge's ray.
  Path(const World& world, const PathSettings& settings, PathStart& start, const PathMiddle& middle,
       const LampWeights& lamp_weights);

  /// At what the ray has met. False: the path ends there.
  bool arrive(bool met, Hit& hit, FirstSeen* first);
  /// Whether a light is looked at from its first point, along `shadow`; to be told how much of it comes through.
  bool looks() const { return looks_; }
  const Ray& shadow() const { return shadow_; }
  void take_light(float let_through) { take_light(shadow_, estimate_, let_through); }
  /// From its first point to its end.
  void go_on();
  /// From what its ray has met to its end.
  void finish(bool met, Hit hit, FirstSeen* first);
  const glm::vec3& light() const { return light_; }

 private:
  enum class Kind : std::uint8_t { sun, sky, lamp, headlight };

  float chance(Kind kind) const { return chances_[static_cast<std::size_t>(kind)]; }
  void choose_chances(const SurfacePoint& point);
  void meet_sky(const glm::vec3& direction);
  void meet_lamp(const Ray& ray, const SurfacePoint& point);
  void look_at_a_light(const SurfacePoint& point, const glm::vec3& to_viewer);
  void add_light(const SurfacePoint& point, const glm::vec3& to_viewer, Kind kind, const LightSample& light,
                 float distance_m);
  void note_first(const Ray& ray, const Hit& hit, const SurfacePoint& point, float edge_m, FirstSeen& first) const;
  bool meet_smoke(const glm::vec3& from_m, const Ray& ray, float edge_m, SurfacePoint& point);
  bool take_photons(const SurfacePoint& point, const glm::vec3& to_viewer, float edge_m);
  bool leave(Ray& next);
  void take_light(const Ray& shadow, const glm::vec3& estimate, float let_through);

  const World& world_;
  const PhotonMaps* photons_;
  const PathSettings& settings_;
  PathRandom& random_;
  Ray ray_;                   ///< The edge's, from the last surface that let it through.
  SurfacePoint point_;        ///< Where it ends.
  Ray shadow_;                ///< Of the first point.
  glm::vec3 estimate_{0.0f};  ///< What comes along it if nothing is in its way.
  std::uint32_t edge_ = 1;
  bool looks_ = false;
  bool is_clear_ = false;  ///< The point is a clear body's, and ray_ goes on from there.
  glm::vec3 light_{0.0f}, throughput_{1.0f};
  float time_;                      ///< While the shutter is open.
  float from_share_of_sky_;         ///< Where the edge begins.
  float pdf_ = 0.0f;                ///< With which the last direction was drawn; 0: it was no matter of chance.
  glm::vec3 from_m_{0.0f};          ///< The last point that scattered.
  LampWeights lamp_weights_;        ///< From there.
  float headlight_sum_ = 0.0f;      ///< Of their strengths there.
  std::array<float, 4> chances_{};  ///< With which each kind of light is looked at from there.
  bool scattered_ = false;          ///< It has been at a surface that scatters.
  bool looks_alone_ = false;        ///< It ends here: nothing is met by chance any more.
  bool has_caustics_ =
      false;  ///< At the last point that scattered the light through clear bodies is known: photons have brought it.
  bool gathers_ = false;  ///< From a matt surface, on which what comes from another one is taken from photons there.
};

}  // namespace septet::raytrace
