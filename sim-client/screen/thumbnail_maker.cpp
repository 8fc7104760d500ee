#include "sim-client/screen/thumbnail_maker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "engine/image/jpeg.hpp"

namespace septet::screen {
namespace {

constexpr std::uint32_t samples_a_side = 4;
constexpr int quality = 80;

}  // namespace

image::Image thumbnail_of(const image::Image& picture, const PictureLimits& limits) {
  const double scale = std::max(
      {1.0, static_cast<double>(picture.width) / limits.width, static_cast<double>(picture.height) / limits.height});
  if (scale <= 1.0) return picture;
  const auto side = [&](std::uint32_t pixels, std::uint32_t most) {
    return std::clamp(static_cast<std::uint32_t>(std::lround(pixels / scale)), 1u, most);
  };
  image::Image small(side(picture.width, limits.width), side(picture.height, limits.height));
  // Evenly spread samples of the stretch that a pixel covers.
  const auto place = [](std::uint32_t pixel, std::uint32_t sample, std::uint32_t from, std::uint32_t to) {
    const std::uint64_t part = std::uint64_t{pixel} * samples_a_side + sample;
    return static_cast<std::uint32_t>((2 * part + 1) * from / (std::uint64_t{2} * samples_a_side * to));
  };
  for (std::uint32_t y = 0; y < small.height; ++y)
    for (std::uint32_t x = 0; x < small.width; ++x) {
      std::array<std::uint32_t, 3> sum{};
      for (std::uint32_t j = 0; j < samples_a_side; ++j)
        for (std::uint32_t i = 0; i < samples_a_side; ++i) {
          const auto color =
              picture.at(place(x, i, picture.width, small.width), place(y, j, picture.height, small.height));
          sum[0] += color.red;
          sum[1] += color.green;
          sum[2] += color.blue;
        }
      const auto mean = [&](std::size_t channel) {
        return static_cast<std::uint8_t>(sum[channel] / (samples_a_side * samples_a_side));
      };
      small.set(x, y, {mean(0), mean(1), mean(2), 255});
    }
  return small;
}

ThumbnailMaker::ThumbnailMaker(const PictureLimits& limits)
    : thread_(1, [this, limits](Job& job) -> Expected<void> {
        const Bytes packed = image::encode_jpeg(thumbnail_of(job.picture, limits), quality);
        if (packed.empty() || packed.size() > limits.bytes) return {};
        Made made{job.tick, std::string(reinterpret_cast<const char*>(packed.data()), packed.size())};
        const std::lock_guard lock(mutex_);
        finished_ = std::move(made);
        return {};
      }) {}

std::optional<ThumbnailMaker::Made> ThumbnailMaker::finished() {
  const std::lock_guard lock(mutex_);
  return std::exchange(finished_, std::nullopt);
}

}  // namespace septet::screen
