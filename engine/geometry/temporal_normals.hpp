#pragma once
/// Face normals between two keyframes of a mesh whose vertices move along straight lines.
///
/// Source: Parus, Hast and Kolingerová, "Temporal Face Normal Interpolation" (SIGRAD 2006). Septet draws with the
/// t-variant cross product (eqs. 2 and 3), which is exact. Preparing it costs a sixth of preparing linear
/// interpolation, which needs normals at both ends; evaluating costs 1.2 to 1.45 times as much, because nine
/// coefficients are read and multiplied where linear has six, whatever their layout (DECISIONS.md, 19). For a pair of
/// keyframes shown in two frames it is 5.7 times cheaper. The other methods are here for comparison. Frame and unit are
/// those of the vertices.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace septet {

enum class NormalMethod : std::uint8_t {
  t_variant,  ///< Exact (eq. 3).
  linear,     ///< Between the first and the last normal (eq. 4).
  quadratic,
  cubic,                   ///< Lagrange, through one or two exact normals more.
  vector_slerp,            ///< Eq. 5.
  spherical_de_casteljau,  ///< Section 2.4, with two exact normals between.
  quaternion_slerp,        ///< Section 2.5: the face's frame turns (eqs. 6 to 8).
};
inline constexpr int normal_method_count = 7;
std::string_view name_of(NormalMethod method);

/// One number for each face of each component: flat, so that the loops vectorise over faces.
struct FaceNormals {
  std::vector<float> x, y, z;
};

/// Corners of a triangle, counter-clockwise from outside, at t = 0 and t = 1.
struct MovingFace {
  std::array<glm::vec3, 3> from, to;
};

/// The normal as eq. 1 gives it; zero for a face without area.
glm::vec3 face_normal(const MovingFace& face, float t);

/// Computes everything that does not depend on t on construction.
class TemporalNormals {
 public:
  TemporalNormals(NormalMethod method, std::span<const MovingFace> faces);

  /// Unit normals at t in [0, 1]; the t-variant product is exact beyond, too. A face without area has the zero normal
  /// (t-variant, linear, quadratic, cubic).
  void at(float t, FaceNormals& normals) const;
  /// Normals as long as twice the area of their faces (eq. 2): their sum at a vertex is weighted by area. Method t_variant
  /// only.
  void area_vectors_at(float t, FaceNormals& vectors) const;
  std::size_t size() const { return count_; }

 private:
  std::array<const float*, 12> planes() const;

  NormalMethod method_;
  std::size_t count_ = 0, stride_ = 0;
  std::vector<float> planes_;  ///< The coefficients, each of all faces, one plane every `stride_`.
};

}  // namespace septet
