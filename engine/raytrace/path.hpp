#pragma once
/// One path traced by itself, through any kind of surface and medium (rules: path_tracer.hpp).

#include <array>
#include <cstdint>

#include "engine/raytrace/path_tracer.hpp"

namespace septet::raytrace {

/// State of a path that was begun elsewhere, at the end of an edge from a matt surface lit by lamps alone.
struct PathMiddle {
  std::uint32_t edge = 1;  ///< Number of that edge; for the first edge the other fields keep their defaults.
  glm::vec3 light{0.0f}, throughput{1.0f}, from_m{0.0f};
  float pdf = 0.0f;
};

/// Walk along one path, on one thread: by turns it arrives at the end of an edge, samples a light from there, and
/// leaves.
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
  /// Continues a path: `edge` of its edges are complete or begun, and `start` holds its random numbers and the last
  /// edge's ray.
  Path(const World& world, const PathSettings& settings, PathStart& start, const PathMiddle& middle,
       const LampWeights& lamp_weights);

  /// Arrives at the ray's hit, or at the sky. False: the path ends there.
  bool arrive(bool met, Hit& hit, FirstSeen* first);
  /// True if a light is sampled from its first point, along `shadow`; `take_light` adds the share that passes.
  bool looks() const { return looks_; }
  const Ray& shadow() const { return shadow_; }
  void take_light(float let_through) { take_light(shadow_, estimate_, let_through); }
  /// Walks from its first point to its end.
  void go_on();
  /// Walks from its ray's hit to its end.
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
  Ray ray_;                   ///< Ray of the edge, from the last surface that let it through.
  SurfacePoint point_;        ///< End of the edge.
  Ray shadow_;                ///< Shadow ray of the first point.
  glm::vec3 estimate_{0.0f};  ///< Unshadowed light along it.
  std::uint32_t edge_ = 1;
  bool looks_ = false;
  bool is_clear_ = false;  ///< True if the point is a clear body's, and ray_ goes on from there.
  glm::vec3 light_{0.0f}, throughput_{1.0f};
  float around_ = 1.0f;             ///< Share of what the edge brings that arrives, lights themselves excepted.
  float time_;                      ///< Time while the shutter is open.
  float from_share_of_sky_;         ///< Share of sky at the edge's beginning.
  float pdf_ = 0.0f;                ///< Density with which the last direction was drawn; 0: it was not drawn at random.
  glm::vec3 from_m_{0.0f};          ///< Last point that scattered.
  LampWeights lamp_weights_;        ///< Weights there.
  float headlight_sum_ = 0.0f;      ///< Sum of headlight strengths there.
  std::array<float, 4> chances_{};  ///< Chances with which each kind of light is sampled from there.
  bool scattered_ = false;          ///< True after a surface that scatters.
  bool looks_alone_ = false;        ///< True if it ends here: no light is met by chance any more.
  /// True if photons have brought the light through clear bodies to the last point that scattered.
  bool has_caustics_ = false;
  bool gathers_ = false;  ///< True from a matt surface on: light of the next matt surface is taken from its photons.
};

}  // namespace septet::raytrace
