#include "engine/raytrace/denoise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/core/parallel_for.hpp"
#include "engine/raytrace/directions.hpp"

namespace septet::raytrace {
namespace {

constexpr int reach_px = 7, patch_px = 1, strip_rows = 16;

/// Weight of differences in light: a smaller one keeps more detail, and more noise.
constexpr float strictness = 0.55f;
constexpr float normal_sigma = 0.2f, albedo_sigma = 0.15f;
/// Lower bound for the divisor: darker surfaces mirror more light than they scatter, about which albedo says nothing.
constexpr float least_albedo = 0.1f;
constexpr int spark_reach_px = 2;
constexpr std::size_t spark_rank = 3;       ///< A spark is brighter than the pixel of this rank around it,
constexpr float spark_uncertainty = 0.25f;  ///< and the spark's least deviation as a share of it: a lamp's is far less.
constexpr float even_variance = 1e-9f;      ///< Variance after exposure: far below a display's code.

/// Features of a pixel that are compared.
struct Guide {
  glm::vec3 light{0.0f};  ///< Radiance over albedo, after exposure.
  glm::vec3 modulation{1.0f};
  float luminance = 0.0f, variance = 0.0f;  ///< Both of the light as it is compared: l / (1 + l).
  glm::vec3 normal{0.0f}, albedo{0.0f};
};

/// Share of a pixel's light that is kept: a spark, which few of its samples have met by chance, is dimmed to those
/// around, for a filter would make a patch of it.
float share_without_spark(const TracedPicture& picture, int x, int y) {
  const int width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
  const auto pixel_at = [&](int column, int row) -> const TracedPixel& {
    return picture.pixels[static_cast<std::size_t>(row) * picture.width + static_cast<std::size_t>(column)];
  };
  const TracedPixel& here = pixel_at(x, y);
  const float light = luminance(here.radiance);
  if (!(here.variance > spark_uncertainty * spark_uncertainty * light * light)) return 1.0f;
  std::array<float, spark_rank> brightest{};  // Brightest of those around, in falling order.
  for (int row = std::max(0, y - spark_reach_px); row <= std::min(height - 1, y + spark_reach_px); ++row)
    for (int column = std::max(0, x - spark_reach_px); column <= std::min(width - 1, x + spark_reach_px); ++column) {
      if (row == y && column == x) continue;
      float other = luminance(pixel_at(column, row).radiance);
      for (float& rank : brightest)
        if (other > rank) std::swap(rank, other);
    }
  return light > brightest.back() ? brightest.back() / light : 1.0f;
}

class Guides {
 public:
  Guides(const TracedPicture& picture, float scale)
      : width_(static_cast<int>(picture.width)), height_(static_cast<int>(picture.height)) {
    guides_.reserve(picture.pixels.size());
    for (const TracedPixel& pixel : picture.pixels) {
      const auto n = static_cast<int>(guides_.size());
      const float left = share_without_spark(picture, n % width_, n / width_);
      Guide guide;
      // Share of sky in a pixel: its mean normal is short of one by that, as the sky has no normal.
      const float sky = std::max(0.0f, 1.0f - glm::length(pixel.normal));
      guide.modulation = glm::max(pixel.albedo + sky, glm::vec3(least_albedo));
      guide.light = pixel.radiance * (left * scale) / guide.modulation;
      // Lamps that some samples met and others missed vary by thousands of whites: differences far beyond white are
      // compressed, or the dark around lamps would be similar to them.
      const float light = luminance(guide.light), beyond = 1.0f + light;
      guide.luminance = light / beyond;
      const float share = left * scale / (luminance(guide.modulation) * beyond * beyond);
      guide.variance = pixel.variance * share * share;
      guide.normal = pixel.normal, guide.albedo = pixel.albedo;
      guides_.push_back(guide);
    }
    even_out_variance();
  }
  int width() const { return width_; }
  int height() const { return height_; }
  const Guide& at(int x, int y) const {
    return guides_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }
  /// Pixel, or the nearest one of the edge beyond it.
  const Guide& near(int x, int y) const { return at(std::clamp(x, 0, width_ - 1), std::clamp(y, 0, height_ - 1)); }

 private:
  /// Raises the variance to at least the mean of those around: few samples estimate it badly, and mostly too small.
  void even_out_variance() {
    std::vector<float> means;
    means.reserve(guides_.size());
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        float sum = 0.0f;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) sum += std::min(near(x + dx, y + dy).variance, 1e12f);
        means.push_back(sum / 9.0f);
      }
    for (std::size_t n = 0; n < guides_.size(); ++n) guides_[n].variance = std::max(guides_[n].variance, means[n]);
  }

  int width_, height_;
  std::vector<Guide> guides_;
};

/// Difference of two pixels' light beyond their noise; 0 and less: similar.
float distance_of(const Guide& a, const Guide& b) {
  const float off = a.luminance - b.luminance, both = a.variance + b.variance;
  return (off * off - (a.variance + std::min(a.variance, b.variance))) /
         (even_variance + strictness * strictness * both);
}

float likeness_of_surfaces(const Guide& a, const Guide& b) {
  const glm::vec3 normal = a.normal - b.normal, albedo = a.albedo - b.albedo;
  return glm::dot(normal, normal) / (2.0f * normal_sigma * normal_sigma) +
         glm::dot(albedo, albedo) / (2.0f * albedo_sigma * albedo_sigma);
}

/// Computes rows from..end of the filtered light.
void filter_strip(const Guides& guides, int from, int end, std::vector<glm::vec3>& filtered) {
  const int width = guides.width(), rows = end - from;
  const auto cells = static_cast<std::size_t>(width) * static_cast<std::size_t>(rows);
  std::vector<glm::vec3> sums(cells, glm::vec3(0.0f));
  std::vector<float> weights(cells, 0.0f);
  // Distances between the strip and itself shifted by (dx, dy).
  const int wide = width + 2 * patch_px;
  std::vector<float> distances(static_cast<std::size_t>(wide) * static_cast<std::size_t>(rows + 2 * patch_px));
  for (int dy = -reach_px; dy <= reach_px; ++dy)
    for (int dx = -reach_px; dx <= reach_px; ++dx) {
      auto distance = distances.begin();
      for (int y = from - patch_px; y < end + patch_px; ++y)
        for (int x = -patch_px; x < width + patch_px; ++x)
          *distance++ = distance_of(guides.near(x, y), guides.near(x + dx, y + dy));
      std::size_t cell = 0;
      for (int y = from; y < end; ++y)
        for (int x = 0; x < width; ++x, ++cell) {
          if (x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= guides.height()) continue;
          float patch = 0.0f;
          for (int py = 0; py <= 2 * patch_px; ++py)
            for (int px = 0; px <= 2 * patch_px; ++px)
              patch += distances[static_cast<std::size_t>(y - from + py) * static_cast<std::size_t>(wide) +
                                 static_cast<std::size_t>(x + px)];
          const Guide &here = guides.at(x, y), &there = guides.at(x + dx, y + dy);
          const float unlike = std::max(0.0f, patch / 9.0f) + likeness_of_surfaces(here, there);
          if (!(unlike < 20.0f)) continue;
          const float weight = std::exp(-unlike);
          sums[cell] += weight * there.light;
          weights[cell] += weight;
        }
    }
  for (std::size_t n = 0; n < cells; ++n)
    if (weights[n] > 0.0f)
      filtered[static_cast<std::size_t>(from) * static_cast<std::size_t>(width) + n] = sums[n] / weights[n];
}

}  // namespace

TracedPicture denoised(const TracedPicture& picture, const instant::Exposure& exposure) {
  TracedPicture result = picture;
  const float scale = exposure.scale();
  const Guides guides(picture, scale);
  std::vector<glm::vec3> filtered;
  filtered.reserve(picture.pixels.size());
  for (int y = 0; y < guides.height(); ++y)
    for (int x = 0; x < guides.width(); ++x) filtered.push_back(guides.at(x, y).light);
  const auto strips = static_cast<std::size_t>((guides.height() + strip_rows - 1) / strip_rows);
  parallel_for(strips, [&](std::size_t strip) {
    const int from = static_cast<int>(strip) * strip_rows;
    filter_strip(guides, from, std::min(from + strip_rows, guides.height()), filtered);
  });
  for (std::size_t n = 0; n < filtered.size(); ++n) {
    const Guide& guide = guides.at(static_cast<int>(n % picture.width), static_cast<int>(n / picture.width));
    if (guide.variance > 0.0f) result.pixels[n].radiance = filtered[n] * guide.modulation / scale;
  }
  return result;
}

}  // namespace septet::raytrace
