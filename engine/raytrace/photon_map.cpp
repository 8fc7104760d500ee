#include "engine/raytrace/photon_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "engine/core/check.hpp"

namespace septet::raytrace {
namespace {

/// Photons on a surface turned further than this cosine lie on another one; so do those further out of the plane than
/// this share of the reach.
constexpr float same_surface_cosine = 0.8f, most_out_of_plane = 0.25f;
constexpr std::size_t most_levels = 64;

}  // namespace

/// Nearest photons so far as a heap, the furthest first.
struct PhotonMap::Nearest {
  struct Found {
    float square_m2 = 0.0f;
    std::uint32_t photon = 0;
    bool operator<(const Found& other) const {
      return square_m2 != other.square_m2 ? square_m2 < other.square_m2 : photon < other.photon;
    }
  };
  std::array<Found, most_nearest> found;
  std::uint32_t count = 0, most = 0;
  float square_m2 = 0.0f;  ///< Further ones do not count.

  void add(const Found& one) {
    if (count < most) {
      found[count++] = one;
      std::push_heap(found.begin(), found.begin() + count);
    } else if (one < found[0]) {
      std::pop_heap(found.begin(), found.begin() + count);
      found[count - 1] = one;
      std::push_heap(found.begin(), found.begin() + count);
    }
    if (count == most) square_m2 = found[0].square_m2;
  }
};

PhotonMap::PhotonMap(std::vector<Photon> photons, std::uint32_t nearest, float reach_m)
    : photons_(std::move(photons)), axes_(photons_.size()), nearest_(nearest), reach_m_(reach_m) {
  SEPTET_CHECK(nearest >= 2 && nearest <= most_nearest && reach_m > 0.0f, "{} nearest photons within {} m", nearest,
               reach_m);
  if (photons_.empty()) return;
  low_m_ = high_m_ = photons_.front().position_m;
  for (const Photon& photon : photons_)
    low_m_ = glm::min(low_m_, photon.position_m), high_m_ = glm::max(high_m_, photon.position_m);
  low_m_ -= reach_m, high_m_ += reach_m;
  balance(0, photons_.size());
}

/// Moves the median along the widest axis to the middle, smaller ones before and larger ones behind it.
void PhotonMap::balance(std::size_t first, std::size_t end) {
  while (end - first > 1) {
    glm::vec3 low = photons_[first].position_m, high = low;
    for (std::size_t n = first; n < end; ++n)
      low = glm::min(low, photons_[n].position_m), high = glm::max(high, photons_[n].position_m);
    const glm::vec3 spread = high - low;
    const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
    const std::size_t middle = first + (end - first) / 2;
    const auto at = [&](std::size_t n) { return photons_.begin() + static_cast<std::ptrdiff_t>(n); };
    std::nth_element(at(first), at(middle), at(end),
                     [axis](const Photon& a, const Photon& b) { return a.position_m[axis] < b.position_m[axis]; });
    axes_[middle] = static_cast<std::uint8_t>(axis);
    balance(first, middle);
    first = middle + 1;
  }
}

void PhotonMap::find(const SurfacePoint& point, Nearest& nearest) const {
  struct Stretch {
    std::size_t first, end;
    float square_m2;  ///< Squared distance to it.
  };
  std::array<Stretch, most_levels> open;
  std::size_t count = 0;
  open[count++] = {0, photons_.size(), 0.0f};
  while (count > 0) {
    const Stretch stretch = open[--count];
    if (stretch.first >= stretch.end || stretch.square_m2 > nearest.square_m2) continue;
    const std::size_t middle = stretch.first + (stretch.end - stretch.first) / 2;
    const Photon& photon = photons_[middle];
    const glm::vec3 way = photon.position_m - point.position_m;
    if (const float square = glm::dot(way, way);
        square <= nearest.square_m2 && glm::dot(photon.normal, point.flat_normal) > same_surface_cosine &&
        std::abs(glm::dot(way, point.flat_normal)) <= most_out_of_plane * reach_m_)
      nearest.add({square, static_cast<std::uint32_t>(middle)});
    const float off = point.position_m[axes_[middle]] - photon.position_m[axes_[middle]];
    Stretch near{stretch.first, middle, stretch.square_m2}, far{middle + 1, stretch.end, stretch.square_m2};
    if (off > 0.0f) std::swap(near, far);
    far.square_m2 = std::max(far.square_m2, off * off);
    open[count++] = far;
    open[count++] = near;
  }
}

glm::vec3 PhotonMap::radiance(const SurfacePoint& point, const glm::vec3& to_viewer) const {
  if (photons_.empty() || !glm::all(glm::greaterThan(point.position_m, low_m_)) ||
      !glm::all(glm::lessThan(point.position_m, high_m_)))
    return glm::vec3(0.0f);
  Nearest nearest;
  nearest.most = nearest_;
  nearest.square_m2 = reach_m_ * reach_m_;
  find(point, nearest);
  if (nearest.count == 0) return glm::vec3(0.0f);
  const bool is_full = nearest.count == nearest.most;
  const float square_m2 = is_full ? nearest.found[0].square_m2 : reach_m_ * reach_m_;
  if (!(square_m2 > 0.0f)) return glm::vec3(0.0f);
  const bool is_matt = is_rough(point.surface);
  glm::vec3 sum(0.0f);
  for (std::uint32_t n = is_full ? 1 : 0; n < nearest.count; ++n) {
    const Photon& photon = photons_[nearest.found[n].photon];
    if (is_matt) {
      sum += photon.power;
      continue;
    }
    const float cosine = glm::dot(point.surface.normal, photon.to_light);
    if (cosine > 0.0f)
      sum += photon.power * scattering(point.surface, to_viewer, photon.to_light).value / std::max(cosine, 0.02f);
  }
  if (is_matt) sum *= point.surface.diffuse * (1.0f / pi);
  return sum / (pi * square_m2);
}

}  // namespace septet::raytrace
