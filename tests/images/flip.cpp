#include "tests/images/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "engine/core/check.hpp"
#include "engine/image/srgb.hpp"

namespace septet {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float pixels_per_degree = 0.7f * 3840.0f / 0.7f * pi / 180.0f;
/// XYZ of linear Rec. 709; columns are red, green, blue.
const glm::mat3 xyz_of_rgb{{10135552.0f / 24577794.0f, 2613072.0f / 12288897.0f, 1425312.0f / 73733382.0f},
                           {8788810.0f / 24577794.0f, 8788810.0f / 12288897.0f, 8788810.0f / 73733382.0f},
                           {4435075.0f / 24577794.0f, 887015.0f / 12288897.0f, 70074185.0f / 73733382.0f}};
const glm::vec3 white = xyz_of_rgb * glm::vec3(1.0f);

using Plane = std::vector<float>;

float linear(std::uint8_t code) { return image::light_of_srgb(static_cast<float>(code) / 255.0f); }

glm::vec3 opponent(const glm::vec3& rgb) {
  const glm::vec3 ratio = xyz_of_rgb * rgb / white;
  return {116.0f * ratio.y - 16.0f, 500.0f * (ratio.x - ratio.y), 200.0f * (ratio.y - ratio.z)};
}

glm::vec3 rgb_of_opponent(const glm::vec3& c) {
  static const glm::mat3 rgb_of_xyz = glm::inverse(xyz_of_rgb);
  const float y = (c.x + 16.0f) / 116.0f;
  return rgb_of_xyz * (glm::vec3(y + c.y / 500.0f, y, y - c.z / 200.0f) * white);
}

glm::vec3 hunt_lab(const glm::vec3& rgb) {
  const glm::vec3 ratio = xyz_of_rgb * rgb / white;
  const auto f = [](float t) {
    constexpr float limit = 6.0f / 29.0f;
    return t > limit * limit * limit ? std::cbrt(t) : t / (3.0f * limit * limit) + 4.0f / 29.0f;
  };
  const glm::vec3 s(f(ratio.x), f(ratio.y), f(ratio.z));
  const float lightness = 116.0f * s.y - 16.0f;
  return {lightness, 0.01f * lightness * 500.0f * (s.x - s.y), 0.01f * lightness * 200.0f * (s.y - s.z)};
}

/// `across` along rows, then `down` along columns; edges go on as they end. Kernels have odd lengths.
Plane filtered(const Plane& plane, std::uint32_t width, std::uint32_t height, std::span<const float> across,
               std::span<const float> down) {
  const auto pass = [&](const Plane& from, std::span<const float> kernel, int dx, int dy) {
    Plane to(from.size());
    const int w = static_cast<int>(width), h = static_cast<int>(height), radius = static_cast<int>(kernel.size() / 2);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        float sum = 0.0f;
        for (int k = -radius; k <= radius; ++k) {
          const int column = std::clamp(x + dx * k, 0, w - 1), row = std::clamp(y + dy * k, 0, h - 1);
          sum += kernel[static_cast<std::size_t>(k + radius)] *
                 from[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)];
        }
        to[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = sum;
      }
    return to;
  };
  return pass(pass(plane, across, 1, 0), down, 0, 1);
}

/// A bell exp(−x²/(2·deviation²)) whose sum is 1; deviation in pixels.
std::vector<float> bell(float deviation, int radius) {
  std::vector<float> kernel;
  float sum = 0.0f;
  for (int x = -radius; x <= radius; ++x) {
    kernel.push_back(std::exp(-static_cast<float>(x * x) / (2.0f * deviation * deviation)));
    sum += kernel.back();
  }
  for (float& value : kernel) value /= sum;
  return kernel;
}

/// Filter of the eye's contrast sensitivity: a sum of bells a·√(π/b)·exp(−π²x²/b), x in degrees.
Plane as_seen(const Plane& plane, std::uint32_t width, std::uint32_t height,
              std::span<const std::array<float, 2>> terms) {
  static const int radius = static_cast<int>(std::ceil(3.0f * std::sqrt(0.04f / (2.0f * pi * pi)) * pixels_per_degree));
  Plane result(plane.size(), 0.0f);
  float weights = 0.0f;
  for (const auto& term : terms) {
    const float deviation = std::sqrt(term[1] / (2.0f * pi * pi)) * pixels_per_degree;
    float sum = 0.0f;
    for (int x = -radius; x <= radius; ++x)
      sum += std::exp(-static_cast<float>(x * x) / (2.0f * deviation * deviation));
    const float weight = term[0] * std::sqrt(pi / term[1]) * sum * sum;
    const std::vector<float> kernel = bell(deviation, radius);
    const Plane part = filtered(plane, width, height, kernel, kernel);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += weight * part[i];
    weights += weight;
  }
  for (float& value : result) value /= weights;
  return result;
}

float colour_distance(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 d = a - b;
  return std::pow(std::abs(d.x) + std::hypot(d.y, d.z), 0.7f);
}

/// Strength of a kernel's response along rows and along columns; its positive and its negative part count as one each.
Plane strength(const Plane& lightness, std::uint32_t width, std::uint32_t height, std::vector<float> kernel,
               std::span<const float> across_it) {
  float positive = 0.0f, negative = 0.0f;
  for (const float value : kernel) (value > 0.0f ? positive : negative) += std::abs(value);
  for (float& value : kernel) value /= value > 0.0f ? positive : negative;
  Plane along = filtered(lightness, width, height, kernel, across_it);
  const Plane down = filtered(lightness, width, height, across_it, kernel);
  for (std::size_t i = 0; i < along.size(); ++i) along[i] = std::hypot(along[i], down[i]);
  return along;
}

}  // namespace

FlipFeatures flip_features(const image::Image& picture) {
  FlipFeatures result;
  result.width = picture.width;
  result.height = picture.height;
  const std::size_t count = std::size_t{picture.width} * picture.height;
  std::array<Plane, 3> planes;
  Plane lightness;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 c =
        opponent({linear(picture.rgba[4 * i]), linear(picture.rgba[4 * i + 1]), linear(picture.rgba[4 * i + 2])});
    for (std::size_t k = 0; k < 3; ++k) planes[k].push_back(c[static_cast<int>(k)]);
    lightness.push_back((c.x + 16.0f) / 116.0f);
  }
  constexpr std::array<std::array<float, 2>, 1> light{{{1.0f, 0.0047f}}}, red{{{1.0f, 0.0053f}}};
  constexpr std::array<std::array<float, 2>, 2> blue{{{34.1f, 0.04f}, {13.5f, 0.025f}}};
  planes[0] = as_seen(planes[0], picture.width, picture.height, light);
  planes[1] = as_seen(planes[1], picture.width, picture.height, red);
  planes[2] = as_seen(planes[2], picture.width, picture.height, blue);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 lab = hunt_lab(glm::clamp(rgb_of_opponent({planes[0][i], planes[1][i], planes[2][i]}), 0.0f, 1.0f));
    result.lightness.push_back(lab.x);
    result.green_red.push_back(lab.y);
    result.blue_yellow.push_back(lab.z);
  }
  const float deviation = 0.5f * 0.082f * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0f * deviation));
  const std::vector<float> smooth = bell(deviation, radius);
  std::vector<float> edge, point;
  for (int x = -radius; x <= radius; ++x) {
    const float at = static_cast<float>(x), value = smooth[static_cast<std::size_t>(x + radius)];
    edge.push_back(-at * value);
    point.push_back((at * at / (deviation * deviation) - 1.0f) * value);
  }
  result.edges = strength(lightness, picture.width, picture.height, edge, smooth);
  result.points = strength(lightness, picture.width, picture.height, point, smooth);
  return result;
}

std::vector<float> flip(const FlipFeatures& reference, const FlipFeatures& picture) {
  SEPTET_CHECK(reference.width == picture.width && reference.height == picture.height, "pictures of two sizes");
  const float most = colour_distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), knee = 0.4f * most;
  std::vector<float> result;
  for (std::size_t i = 0; i < reference.lightness.size(); ++i) {
    const auto lab = [&](const FlipFeatures& of) {
      return glm::vec3(of.lightness[i], of.green_red[i], of.blue_yellow[i]);
    };
    const float distance = colour_distance(lab(reference), lab(picture));
    const float colour = distance < knee ? 0.95f / knee * distance : 0.95f + 0.05f * (distance - knee) / (most - knee);
    const float feature = std::sqrt(
        std::max(std::abs(reference.edges[i] - picture.edges[i]), std::abs(reference.points[i] - picture.points[i])) /
        std::numbers::sqrt2_v<float>);
    result.push_back(std::pow(colour, 1.0f - feature));
  }
  return result;
}

}  // namespace septet
