#pragma once
/// Pictures of what a screen shows, for the operator's page: small ones always, large ones while somebody looks.
///
/// A picture that was read back anyway is copied (1 ms), and made smaller and packed on a thread of its own: a frame never waits for that. One
/// that comes while the last is being packed is left out.

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "engine/control/control_message.hpp"
#include "engine/core/job_thread.hpp"
#include "engine/image/image.hpp"

namespace septet::screen {

/// How large a picture may be.
struct PictureLimits {
  std::uint32_t width = 320, height = 240;
  std::size_t bytes = control::most_thumbnail_bytes;
};
inline constexpr PictureLimits large_picture{960, 720, control::most_picture_bytes};

/// The picture within the limits, its sides' ratio kept: each pixel the mean of up to 4 × 4 of those that it stands for. A smaller one as it is.
image::Image thumbnail_of(const image::Image& picture, const PictureLimits& limits = {});

class ThumbnailMaker {
 public:
  explicit ThumbnailMaker(const PictureLimits& limits = {});
  void take(Tick tick, const image::Image& picture) {
    if (thread_.is_idle()) thread_.give_if_idle({tick, picture});
  }
  struct Made {
    Tick tick = 0;
    std::string picture;  ///< A JPEG file.
  };
  /// The newest that is ready, once.
  std::optional<Made> finished();

 private:
  struct Job {
    Tick tick = 0;
    image::Image picture;
  };
  std::mutex mutex_;
  std::optional<Made> finished_;
  JobThread<Job> thread_;  ///< Last: it is gone before the rest.
};

}  // namespace septet::screen
