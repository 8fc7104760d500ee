#pragma once
/// Photons: light that starts at lamps, headlights and the sun and is followed to where it lies on surfaces.
///
/// Photon n is a function of the world, the settings and n: whoever follows which of them, in buckets of any size and any order, they
/// are the same bit for bit, and a map is made of them in the order of n.
///
/// Those of caustics are aimed at the spheres around clear bodies and lie where they first meet another surface. Which lamp and which
/// body is drawn by about what the one gives the other; a photon counts if the body that it was meant for is the first that it meets,
/// so that bodies that stand together count no light twice. The others leave lamps to all sides and lie wherever they are scattered,
/// each time; where they go on is a matter of chance, so that all carry about the same.

#include "engine/raytrace/photon_map.hpp"

namespace septet::raytrace {

struct PhotonSettings {
  std::uint32_t caustic = 0;  ///< To be sent at clear bodies; 0: what they do to light is found by paths alone.
  /// To be sent by lamps, for a final gather: a path ends at the second matt surface, whose light is that of the photons there. Only
  /// where lamps alone shine, in clear air (World::lamps_alone_shine, all_light_can_be_drawn); elsewhere paths go on as ever. 0: so they do.
  std::uint32_t global = 0;
  std::uint32_t nearest = 64;  ///< Of an estimate.
  float caustic_reach_m = 0.05f, global_reach_m = 0.15f;
};

enum class PhotonKind : std::uint8_t { caustic, global };

/// Photons first, first + 1, … below end, of those that are sent.
struct PhotonBucket {
  PhotonKind kind = PhotonKind::caustic;
  std::uint32_t first = 0, end = 0;
};

/// In the order in which their photons are kept.
std::vector<PhotonBucket> photon_buckets(std::uint32_t caustic, std::uint32_t global, std::uint32_t of_each = 4096);

class PhotonLights {
 public:
  /// `longest`: edges of a path from the eye to a lamp. `moves`: the shutter stays open. The world outlives it.
  PhotonLights(const World& world, const PhotonSettings& settings, std::uint64_t seed, std::uint32_t longest,
               bool moves);

  /// How many of a kind there are to be sent: none, where nothing shines or there is no clear body.
  std::uint32_t count(PhotonKind kind) const;
  /// What lies of them; what is no number does not.
  std::vector<Photon> trace(const PhotonBucket& bucket) const;

 private:
  enum class Light : std::uint8_t { sun, lamp, headlight };
  struct Pair {
    Light light = Light::sun;
    std::uint32_t number = 0;  ///< Of the lamp or headlight.
    std::size_t body = 0;
    float cumulative = 0.0f;
  };
  /// On its way.
  struct Flight {
    Ray ray;
    glm::vec3 power{0.0f};
    std::uint32_t place = 0;  ///< Which body it has to meet first.
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
