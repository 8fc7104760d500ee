#pragma once
/// Pictures of a screen for the operator's page: small ones always, large ones while an operator watches closely.
///
/// A picture that was read back anyway is copied (1 ms), and scaled and compressed on a thread of its own: a frame
/// never waits for it. One that comes while the last is being compressed is dropped.

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "engine/control/control_message.hpp"
#include "engine/core/job_thread.hpp"
#include "engine/image/image.hpp"

namespace septet::screen {

/// Largest size of a picture.
struct PictureLimits {
  std::uint32_t width = 320, height = 240;
  std::size_t bytes = control::most_thumbnail_bytes;
};
inline constexpr PictureLimits large_picture{960, 720, control::most_picture_bytes};

/// Picture within the limits, aspect ratio kept: each pixel the mean of up to 4 × 4 pixels. A smaller one is returned
/// unchanged.
image::Image thumbnail_of(const image::Image& picture, const PictureLimits& limits = {});

class ThumbnailMaker {
 public:
  explicit ThumbnailMaker(const PictureLimits& limits = {});
  /// True: a picture that is taken now would not be dropped.
  bool is_idle() { return thread_.is_idle(); }
  void take(Tick tick, const image::Image& picture) {
    if (thread_.is_idle()) thread_.give_if_idle({tick, picture});
  }
  struct Made {
    Tick tick = 0;
    std::string picture;  ///< JPEG file.
  };
  /// Newest finished picture, once.
  std::optional<Made> finished();

 private:
  struct Job {
    Tick tick = 0;
    image::Image picture;
  };
  std::mutex mutex_;
  std::optional<Made> finished_;
  JobThread<Job> thread_;  ///< Last member: its thread ends before the rest is destroyed.
};

}  // namespace septet::screen
