#include "sim-client/screen/thumbnail_maker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "engine/image/png.hpp"

namespace septet::screen {
namespace {

constexpr std::uint32_t most_width = 160, most_height = 120, samples_a_side = 4;

}  // namespace

image::Image thumbnail_of(const image::Image& picture) {
  const double scale = std::max(
      {1.0, static_cast<double>(picture.width) / most_width, static_cast<double>(picture.height) / most_height});
  if (scale <= 1.0) return picture;
  const auto side = [&](std::uint32_t pixels, std::uint32_t most) {
    return std::clamp(static_cast<std::uint32_t>(std::lround(pixels / scale)), 1u, most);
  };
  image::Image small(side(picture.width, most_width), side(picture.height, most_height));
  // Of the stretch that a pixel stands for, evenly spread places.
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

ThumbnailMaker::ThumbnailMaker()
    : thread_(1, [this](Job& job) -> Expected<void> {
        const Bytes png = image::encode_png(job.picture);
        if (png.size() > control::most_thumbnail_bytes) return {};
        control::Thumbnail made{job.tick, std::string(reinterpret_cast<const char*>(png.data()), png.size())};
        const std::lock_guard lock(mutex_);
        finished_ = std::move(made);
        return {};
      }) {}

std::optional<control::Thumbnail> ThumbnailMaker::finished() {
  const std::lock_guard lock(mutex_);
  return std::exchange(finished_, std::nullopt);
}

}  // namespace septet::screen
