#include "engine/geometry/temporal_normals.hpp"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/core/check.hpp"
#include "engine/geometry/face_normal_loops.hpp"

namespace septet {
namespace {

glm::vec3 unit_or_zero(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 0.0f ? v / length : glm::vec3(0.0f);
}

/// Vectors kept of a face; as many as its method needs.
using FaceVectors = std::array<glm::vec3, 4>;

/// Coefficients of the polynomial through normals at equal distances of t, lowest first.
FaceVectors lagrange(const MovingFace& face, int degree) {
  FaceVectors n{};
  for (int i = 0; i <= degree; ++i)
    n[static_cast<std::size_t>(i)] = face_normal(face, static_cast<float>(i) / static_cast<float>(degree));
  if (degree == 1) return {n[0], n[1] - n[0]};
  if (degree == 2) return {n[0], -3.0f * n[0] + 4.0f * n[1] - n[2], 2.0f * n[0] - 4.0f * n[1] + 2.0f * n[2]};
  return {n[0], 0.5f * (-11.0f * n[0] + 18.0f * n[1] - 9.0f * n[2] + 2.0f * n[3]),
          4.5f * (2.0f * n[0] - 5.0f * n[1] + 4.0f * n[2] - n[3]), 4.5f * (-n[0] + 3.0f * n[1] - 3.0f * n[2] + n[3])};
}

/// Eq. 2, multiplied out.
FaceVectors t_variant(const MovingFace& face) {
  const glm::vec3 u = face.from[1] - face.from[0], v = face.from[2] - face.from[0];
  const glm::vec3 du = face.to[1] - face.to[0] - u, dv = face.to[2] - face.to[0] - v;
  return {glm::cross(u, v), glm::cross(u, dv) + glm::cross(du, v), glm::cross(du, dv)};
}

/// Eq. 5 for unit vectors; nearly equal ones are interpolated straight.
glm::vec3 slerp(const glm::vec3& from, const glm::vec3& to, float t) {
  const float sine = glm::length(glm::cross(from, to));
  if (sine < 1e-5f) return unit_or_zero(glm::mix(from, to, t));
  const float angle = std::atan2(sine, glm::dot(from, to));
  return (std::sin((1.0f - t) * angle) * from + std::sin(t * angle) * to) / sine;
}

struct Frames {
  glm::quat from, to;
};

/// The frames (t, b, n) of a face, with t = b × n, so that they are right-handed. The paper's b₁ = M b₀ needs only the
/// edges: b₀ is a combination of them, and M keeps it.
Frames frames_of(const MovingFace& face) {
  const auto quaternion = [](const glm::vec3& b, const glm::vec3& n) {
    return glm::quat_cast(glm::mat3(glm::cross(b, n), b, n));
  };
  const glm::vec3 n0 = face_normal(face, 0.0f), n1 = face_normal(face, 1.0f);
  const glm::vec3 u = face.from[1] - face.from[0], v = face.from[2] - face.from[0];
  const float length = glm::length(u);
  const glm::vec3 t0 = unit_or_zero(u), b0 = glm::cross(n0, t0);
  const float height = glm::dot(v, b0);
  if (!(length > 0.0f && std::abs(height) > 0.0f)) return {{1, 0, 0, 0}, {1, 0, 0, 0}};
  const glm::vec3 b1 = unit_or_zero((face.to[2] - face.to[0]) / height -
                                    (face.to[1] - face.to[0]) * (glm::dot(v, t0) / (height * length)));
  const glm::quat from = quaternion(b0, n0), to = quaternion(b1, n1);
  return {from, glm::dot(from, to) < 0.0f ? -to : to};
}

}  // namespace

std::string_view name_of(NormalMethod method) {
  constexpr std::array<std::string_view, normal_method_count> names{
      "t_variant", "linear", "quadratic", "cubic", "vector_slerp", "spherical_de_casteljau", "quaternion_slerp"};
  return names[static_cast<std::size_t>(method)];
}

glm::vec3 face_normal(const MovingFace& face, float t) {
  std::array<glm::vec3, 3> p;
  for (std::size_t c = 0; c < 3; ++c) p[c] = face.from[c] + t * (face.to[c] - face.from[c]);
  return unit_or_zero(glm::cross(p[1] - p[0], p[2] - p[0]));
}

TemporalNormals::TemporalNormals(NormalMethod method, std::span<const MovingFace> faces)
    : method_(method), count_(faces.size()) {
  constexpr std::array<std::size_t, normal_method_count> plane_count{9, 6, 9, 12, 6, 12, 8};
  const std::size_t planes = plane_count[static_cast<std::size_t>(method)];
  // Planes a multiple of 4 KiB apart would compete for the same cache sets.
  constexpr std::size_t page = 1024, apart = 80;
  stride_ = (count_ + page - 1) / page * page + apart;
  planes_.resize(planes * stride_);
  const auto keep = [&](std::size_t face, const FaceVectors& vectors) {
    for (std::size_t n = 0; n < planes / 3; ++n)
      for (std::size_t c = 0; c < 3; ++c)
        planes_[(3 * n + c) * stride_ + face] = vectors[n][static_cast<glm::length_t>(c)];
  };
  for (std::size_t n = 0; n < count_; ++n) {
    const MovingFace& face = faces[n];
    switch (method) {
      case NormalMethod::t_variant:
        keep(n, t_variant(face));
        break;
      case NormalMethod::linear:
        keep(n, lagrange(face, 1));
        break;
      case NormalMethod::quadratic:
        keep(n, lagrange(face, 2));
        break;
      case NormalMethod::cubic:
        keep(n, lagrange(face, 3));
        break;
      case NormalMethod::vector_slerp:
        keep(n, {face_normal(face, 0.0f), face_normal(face, 1.0f)});
        break;
      case NormalMethod::spherical_de_casteljau:
        keep(n, {face_normal(face, 0.0f), face_normal(face, 1.0f / 3.0f), face_normal(face, 2.0f / 3.0f),
                 face_normal(face, 1.0f)});
        break;
      case NormalMethod::quaternion_slerp: {
        const Frames frames = frames_of(face);
        for (std::size_t c = 0; c < 4; ++c) {
          planes_[c * stride_ + n] = frames.from[static_cast<glm::length_t>(c)];
          planes_[(c + 4) * stride_ + n] = frames.to[static_cast<glm::length_t>(c)];
        }
        break;
      }
    }
  }
}

std::array<const float*, 12> TemporalNormals::planes() const {
  std::array<const float*, 12> planes{};
  for (std::size_t n = 0; n * stride_ < planes_.size(); ++n) planes[n] = planes_.data() + n * stride_;
  return planes;
}

void TemporalNormals::area_vectors_at(float t, FaceNormals& vectors) const {
  SEPTET_CHECK(method_ == NormalMethod::t_variant, "method {}", name_of(method_));
  for (auto* values : {&vectors.x, &vectors.y, &vectors.z}) values->resize(count_);
  float* const out[3] = {vectors.x.data(), vectors.y.data(), vectors.z.data()};
  polynomial_2(planes().data(), count_, t, out);
}

void TemporalNormals::at(float t, FaceNormals& normals) const {
  for (auto* values : {&normals.x, &normals.y, &normals.z}) values->resize(count_);
  float* const out[3] = {normals.x.data(), normals.y.data(), normals.z.data()};
  const std::array<const float*, 12> planes = this->planes();
  const auto vector = [&](std::size_t which, std::size_t face) {
    return glm::vec3(planes[3 * which][face], planes[3 * which + 1][face], planes[3 * which + 2][face]);
  };
  const auto store = [&](std::size_t face, const glm::vec3& normal) {
    for (int c = 0; c < 3; ++c) out[c][face] = normal[c];
  };
  switch (method_) {
    case NormalMethod::linear:
      return unit_polynomial_1(planes.data(), count_, t, out);
    case NormalMethod::t_variant:
    case NormalMethod::quadratic:
      return unit_polynomial_2(planes.data(), count_, t, out);
    case NormalMethod::cubic:
      return unit_polynomial_3(planes.data(), count_, t, out);
    case NormalMethod::vector_slerp:
      for (std::size_t n = 0; n < count_; ++n) store(n, slerp(vector(0, n), vector(1, n), t));
      return;
    case NormalMethod::spherical_de_casteljau:
      for (std::size_t n = 0; n < count_; ++n) {
        std::array<glm::vec3, 4> v{vector(0, n), vector(1, n), vector(2, n), vector(3, n)};
        for (std::size_t left = 3; left > 0; --left)
          for (std::size_t i = 0; i < left; ++i) v[i] = slerp(v[i], v[i + 1], t);
        store(n, v[0]);
      }
      return;
    case NormalMethod::quaternion_slerp:
      for (std::size_t n = 0; n < count_; ++n) {
        glm::quat from, to;
        for (int c = 0; c < 4; ++c) {
          from[c] = planes[static_cast<std::size_t>(c)][n];
          to[c] = planes[static_cast<std::size_t>(c) + 4][n];
        }
        store(n, glm::mat3_cast(glm::slerp(from, to, t))[2]);
      }
      return;
  }
}

}  // namespace septet
