#pragma once
/// World of one instant for paths: hits of rays, the surfaces there, and the lights.
///
/// Made from a scene and the description of an instant (engine/instant), the same that the rasteriser draws, by the
/// same rules: level of detail by the eye's distance, paint, wetness, snow, soot, lit lamps, the light of sky and sun.
/// The rasteriser's approximations are left out, since light finds its own way here: the share of the sky under a roof,
/// and the light of its lamps. Frame: metres from the first view's eye, along the world's axes. Const once made; any
/// number of threads.

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/instant/clouds.hpp"
#include "engine/instant/ice_body.hpp"
#include "engine/instant/instant.hpp"
#include "engine/raytrace/geometry.hpp"
#include "engine/raytrace/headlights.hpp"
#include "engine/raytrace/lamps.hpp"
#include "engine/raytrace/matt_faces.hpp"
#include "engine/raytrace/scene_index.hpp"
#include "engine/raytrace/sky.hpp"
#include "engine/raytrace/smoke.hpp"
#include "engine/raytrace/surface.hpp"

namespace septet::raytrace {

inline constexpr std::uint32_t no_lamp = 0xffffffffu;

struct PhotonMaps;

/// Point where a ray met a surface.
struct SurfacePoint {
  Surface surface;
  glm::vec3 position_m{0.0f};
  glm::vec3 flat_normal{0.0f};      ///< Normal of the triangle, towards the viewer.
  bool from_front = true;           ///< True if it was met on the side that its triangle faces.
  glm::vec3 emission{0.0f};         ///< Emitted radiance towards the viewer.
  float lights_up = 1.0f;           ///< Factor of its emission for the surfaces that it lights.
  glm::vec3 retroreflection{0.0f};  ///< Coefficient of retroreflection, cd/(lx m²), towards the light.
  /// Share of the light from around, of sky and surfaces, that its own unevenness lets through (scene::SurfaceMap): not
  /// of sun, lamps and headlights.
  float from_around = 1.0f;
  float opacity = 1.0f;  ///< Share of the rays that it stops; the others go straight on.
  /// True: a point in the air, not a surface, that scatters isotropically with the albedo surface.diffuse.
  bool in_smoke = false;
  /// True for a sheet that scatters light from either side to both alike: `surface.diffuse` is the share of both.
  bool translucent = false;
  /// True for the face of a crack within a sheet: light leaves on either side of the sheet.
  bool face_in_sheet = false;
  bool dielectric = false;  ///< True for a transparent body: `index` and `absorption_per_m` are those of its inside.
  float index = 1.5f;
  glm::vec3 absorption_per_m{0.0f};
  /// Share of visible sky by the rasteriser's estimate; here only a guess at which lights matter.
  float share_of_sky = 1.0f;
  std::uint32_t place = 0;
  std::uint32_t lamp = no_lamp;  ///< Index of the lamp that it belongs to.
};

/// Closed body of clear matter, such as ice: refracts at its surface and absorbs inside.
struct ClearBody {
  Vec3 origin_m{0.0};  ///< World frame.
  /// Vertices from the origin along the world's axes; three a triangle, counter-clockwise seen from outside.
  std::vector<scene::SurfaceVertex> vertices;
  float index = 1.31f;
  glm::vec3 absorption_per_m{0.0f};
  std::vector<scene::SurfaceVertex> later{};  ///< Vertices from the same origin at time 1; empty: it does not move.
};

class World : public Openings {
 public:
  /// `index` is the scene's. `geometry` holds the scene's meshes; those of this instant alone are added behind them.
  /// `cloud_noise` is instant::cloud_noise(). All of these outlive the world. `later`: the instant at which the shutter
  /// closes, time 1, for motion until then; null: nothing moves.
  World(const scene::ResolvedScene& scene, const SceneIndex& index, const instant::Instant& instant,
        const instant::Instant* later, std::span<const ClearBody> bodies, std::span<const std::uint8_t> cloud_noise,
        Geometry& geometry);
  ~World() override = default;
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const Geometry& geometry() const { return geometry_; }
  const Sky& sky() const { return sky_; }
  /// Visible clouds, whose light the sky's table holds already.
  instant::CloudSeen cloud(const glm::vec3& direction) const {
    return instant::cloud_seen(cloud_noise_, *instant_.light, instant_.environment.cloud_cover, cloud_drift_m_,
                               direction);
  }
  const instant::Instant& instant() const { return instant_; }
  const std::vector<Lamp>& lamps() const { return lamps_; }
  const LampRow& lamp_row() const { return lamp_row_; }
  /// True if every light can be drawn, none is met by chance only.
  bool all_light_can_be_drawn() const { return all_lamps_are_drawn_ && smoke_.empty() && fog_per_m() <= 0.0f; }
  /// True without sky, sun and headlights: every light sampled is a lamp.
  bool lamps_alone_shine() const { return lamps_alone_shine_; }
  /// Faces for eight paths at once; null where paths are traced singly: other lights than still lamps of one colour
  /// each shine, or there is smoke or fog.
  const MattFaces* matt_faces() const { return matt_faces_ ? &*matt_faces_ : nullptr; }
  const HeadlightRow& headlights() const { return headlights_; }
  /// Sphere around a clear body in all its positions while the shutter is open.
  struct ClearBodySphere {
    std::uint32_t place = 0;
    glm::vec3 middle_m{0.0f};
    float radius_m = 0.0f;
  };
  std::vector<ClearBodySphere> clear_body_spheres() const;
  /// Photons that paths use; null: none. Set while no path is traced; outlives the paths.
  const PhotonMaps* photons() const { return photons_; }
  void set_photons(const PhotonMaps* photons) { photons_ = photons; }
  const Smoke& smoke() const { return smoke_; }
  const Vec3& origin_m() const { return origin_m_; }  ///< World frame.

  /// Numbers for a picture's layers (TracedPixel).
  std::uint32_t object(std::uint32_t place) const { return placed_[place].object; }
  std::uint32_t participant(std::uint32_t place) const { return placed_[place].stands ? 0 : placed_[place].number; }

  /// Describes the hit; all of `point` is set.
  void point(const Ray& ray, const Hit& hit, SurfacePoint& point) const;
  /// Radiance of fog in this direction: as bright as the sky behind it, below the horizon as the sky just above.
  /// Interpolates between places with these shares of the sky.
  glm::vec3 fog_radiance(const glm::vec3& direction, float from_share_of_sky, float to_share_of_sky) const;
  float eye_share_of_sky() const { return instant_.share_of_sky; }
  float fog_per_m() const { return instant_.extinction_per_m; }

  bool is_hole(std::uint32_t place, std::uint32_t triangle, float u, float v) const override;
  float share_let_through(std::uint32_t place, std::uint32_t triangle, float u, float v,
                          const glm::vec3& direction) const override;

 private:
  glm::vec3 open_fog_radiance(const glm::vec3& direction) const;
  struct PlacedSurface {
    std::span<const scene::SurfaceVertex> vertices;
    std::span<const std::uint32_t> indices;
    std::span<const scene::MeshPart> parts;
    glm::mat3 turn{1.0f}, normal_turn{1.0f};
    glm::vec3 origin_m{0.0f};
    glm::vec4 tint{1.0f};
    float share_of_sky = 1.0f;
    bool snowed_on = true;
    std::uint32_t number = 0;  ///< Number of its participant.
    bool stands = false;       ///< True for an instance of the scene: not a part of a participant, nor loose.
    std::span<const std::uint32_t> materials;  ///< Materials of its triangles, or one of all.
    std::vector<std::uint32_t> lamps;          ///< Indices into lamps_.
    const ClearBody* body = nullptr;
    std::uint32_t object = 0;  ///< TracedPixel::object.
    std::optional<Motion> motion{};
    std::span<const scene::SurfaceVertex> later{};  ///< Vertices at time 1, if they move.
    const ice::IceBody* on_glass = nullptr;         ///< Ice on a pane, if it is that.
    bool lights_around = false;                     ///< Same as instant::PlacedMesh::lights_around.
    bool is_turned = turn != glm::mat3(1.0f);

    glm::vec3 turned(const glm::vec3& way) const { return is_turned ? turn * way : way; }
  };
  struct Corners {
    const scene::SurfaceVertex *a, *b, *c;
  };

  void add(std::vector<Place>& places, const instant::PlacedMesh& placed, bool stands, std::size_t object,
           const instant::PlacedMesh* later = nullptr);
  void add_headlights(const instant::Instant* later);
  void add_parts(std::vector<Place>& places, const instant::Instant* later);
  bool is_street_lamp(const PlacedSurface& placed, const scene::SurfaceMaterial& material, bool looks_down) const;
  float lights_up(const PlacedSurface& placed, const scene::SurfaceMaterial& material, bool looks_down) const;
  void add_soups(std::vector<Place>& places, const instant::Instant* later, std::span<const ClearBody> bodies);
  void add_lamps(const std::vector<Place>& places);
  void add_lamps(std::uint32_t place, const scene::MeshPart& part);
  void add_matt_faces();
  Face matt_face(const PlacedSurface& placed, std::uint32_t triangle) const;
  Corners corners(const PlacedSurface& placed, std::uint32_t triangle) const;
  /// True if it is visible from behind, as the rasteriser draws it.
  bool shows_back(const scene::SurfaceMaterial& material) const;
  const scene::SurfaceMaterial& material_of(const PlacedSurface& placed, std::uint32_t triangle) const;
  /// Texture coordinate: of several pictures in an image, that of the participant.
  static glm::vec2 in_image(const PlacedSurface& placed, const scene::SurfaceMaterial& material, const glm::vec2& uv);
  /// An image of the scene, or null where there is none or it is empty.
  const scene::TextureImage* image_at(std::int32_t index) const;
  /// White where there is no image.
  glm::vec4 texel(const scene::TextureImage* image, const glm::vec2& at) const;
  /// Roughness and metallic of a point, and whether a layer mirrors there.
  struct Finish {
    float roughness = 1.0f, metallic = 0.0f;
    bool mirrors = false;
  };
  /// Where a point lies on the images of its material.
  struct MapPlaces {
    glm::vec2 uv, second_uv;
    std::uint32_t by_second_uv;  ///< See scene::SurfaceMaterial.

    const glm::vec2& of(scene::SurfaceMap map) const { return scene::has_map(by_second_uv, map) ? second_uv : uv; }
  };
  /// Factor of the base colour at a point between three corners.
  static glm::vec3 vertex_color(const Corners& at, float u, float v);
  /// Applies the images of properties and normals.
  void apply_maps(const PlacedSurface& placed, const scene::SurfaceMaterial& material, const Ray& ray, const Hit& hit,
                  const MapPlaces& lies, SurfacePoint& point, Finish& finish) const;
  glm::vec3 mapped_normal(const PlacedSurface& placed, const Ray& ray, const Hit& hit, const glm::vec3& texel,
                          const glm::vec3& front, bool by_second_uv) const;
  glm::vec3 stand(const PlacedSurface& placed, const Ray& ray, const Hit& hit, SurfacePoint& point) const;
  void lay_weather(const PlacedSurface& placed, const scene::SurfaceMaterial& material, const Finish& finish,
                   const glm::vec2& uv, const glm::vec3& base, const glm::vec3& seen, SurfacePoint& point) const;
  void give_off(const PlacedSurface& placed, const scene::SurfaceMaterial& material, const glm::vec3& color,
                const Hit& hit, const glm::vec3& seen, SurfacePoint& point) const;
  static void blacken(float share, SurfacePoint& point);
  float lay_snow(const PlacedSurface& placed, const scene::SurfaceMaterial& material, const glm::vec2& uv, float up,
                 float share_of_sky, glm::vec3& albedo) const;
  float soot(const glm::vec3& position_m) const;
  glm::vec2 ripple(const glm::vec3& position_m) const;
  void lie_on_glass(const PlacedSurface& placed, const Ray& ray, const Hit& hit, SurfacePoint& point) const;

  const scene::ResolvedScene& scene_;
  const SceneIndex& index_;
  const instant::Instant& instant_;
  Geometry& geometry_;
  Sky sky_;
  std::span<const std::uint8_t> cloud_noise_;
  glm::vec2 cloud_drift_m_;
  std::vector<glm::vec2> ripples_;  ///< Result of instant::ripple_slopes; empty where it is dry.
  Vec3 origin_m_;
  Smoke smoke_;
  bool nothing_lies_on_it_;  ///< True without snow and soot.
  std::vector<PlacedSurface> placed_;
  std::vector<std::uint32_t> loose_indices_;  ///< 0, 1, 2, … for soups of triangles.
  std::vector<std::vector<scene::MeshPart>> loose_parts_;
  std::vector<std::vector<scene::SurfaceVertex>> later_soups_;
  std::vector<std::vector<scene::SurfaceVertex>> panes_;  ///< Vertices of ice on glass, at times 0 and 1 by turns.
  std::uint32_t next_mesh_ = 0;                           ///< Next index behind the scene's meshes.
  /// Owners of the meshes that replace a scene's.
  std::map<const scene::SurfaceMesh*, std::shared_ptr<const scene::SurfaceMesh>> reshaped_;
  /// Triangle materials of the meshes that replace a scene's.
  std::vector<std::vector<std::uint32_t>> reshaped_materials_;
  HeadlightRow headlights_;
  std::vector<Lamp> lamps_;
  LampRow lamp_row_;
  std::optional<MattFaces> matt_faces_;
  const PhotonMaps* photons_ = nullptr;
  bool all_lamps_are_drawn_ = true, lamps_alone_shine_ = false;
  scene::SurfaceMaterial no_material_;
};

}  // namespace septet::raytrace
