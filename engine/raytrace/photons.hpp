#pragma once
/// Photons: light that starts at lamps, headlights and the sun and is followed to surfaces, where it lies.
///
/// Photon n is a function of the world, the settings and n: it is the same bit for bit in buckets of any size, in any
/// order and on any machine, and a map is made of them in the order of n.
///
/// Caustic photons are aimed at the spheres around clear bodies and lie where they first meet another surface. The pair
/// of light and body is drawn by an estimate of the light between them; a photon counts if the body that it was aimed
/// at is the first that it meets, so that neighbouring bodies count no light twice. Global photons leave lamps to all
/// sides and lie at each scattering; Russian roulette keeps their powers about equal.

#include "engine/raytrace/photon_map.hpp"

namespace septet::raytrace {

struct PhotonSettings {
  std::uint32_t caustic = 0;  ///< Photons to be sent at clear bodies; 0: paths alone find caustics.
  /// Photons to be sent by lamps, for a final gather: a path ends at the second matt surface, whose light is that of
  /// the photons there. Only where lamps alone shine, in clear air (World::lamps_alone_shine, all_light_can_be_drawn);
  /// elsewhere, and with 0, paths go on without.
  std::uint32_t global = 0;
  std::uint32_t nearest = 64;  ///< Photons of an estimate.
  float caustic_reach_m = 0.05f, global_reach_m = 0.15f;
};

enum class PhotonKind : std::uint8_t { caustic, global };

/// Photons first, first + 1, … below end, of those that are sent.
struct PhotonBucket {
  PhotonKind kind = PhotonKind::caustic;
  std::uint32_t first = 0, end = 0;
};

/// Buckets in the order in which their photons are kept.
std::vector<PhotonBucket> photon_buckets(std::uint32_t caustic, std::uint32_t global, std::uint32_t of_each = 4096);

class PhotonLights {
 public:
  /// `longest`: edges of a path from the eye to a lamp. `moves`: the shutter stays open. The world outlives it.
  PhotonLights(const World& world, const PhotonSettings& settings, std::uint64_t seed, std::uint32_t longest,
               bool moves);

  /// Number of photons of a kind to be sent: 0 where no light shines or there is no clear body.
  std::uint32_t count(PhotonKind kind) const;
  /// Photons of a bucket that have come to lie; all of one with a value that is not finite are dropped.
  std::vector<Photon> trace(const PhotonBucket& bucket) const;

 private:
  enum class Light : std::uint8_t { sun, lamp, headlight };
  struct Pair {
    Light light = Light::sun;
    std::uint32_t number = 0;  ///< Number of the lamp or headlight.
    std::size_t body = 0;
    float cumulative = 0.0f;
  };
  /// Photon on its way.
  struct Flight {
    Ray ray;
    glm::vec3 power{0.0f};
    std::uint32_t place = 0;  ///< Body that it has to meet first.
  };
  void add(Light light, std::uint32_t number, std::size_t body, float weight);
  Flight towards_body(PathRandom& random, float time) const;
  Flight from_lamp(PathRandom& random, float time) const;
  glm::vec3 place_on_lamp(std::size_t lamp, float time, PathRandom& random, glm::vec3& normal,
                          glm::vec3& radiance) const;
  void follow(Flight flight, PhotonKind kind, PathRandom& random, std::vector<Photon>& photons) const;

  const World& world_;
  PhotonSettings settings_;
  std::uint64_t seed_;
  std::uint32_t longest_;
  bool moves_;
  std::vector<World::ClearBodySphere> bodies_;
  std::vector<Pair> pairs_;
  std::vector<float> lamps_;  ///< Cumulative shares of their power.
};

}  // namespace septet::raytrace
