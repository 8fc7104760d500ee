#pragma once
/// Small pictures of what a screen shows, for the operator's page.
///
/// A picture that was read back anyway is made smaller at once (0.6 ms), and packed on a thread of its own: a frame never waits for that.
/// One that comes while the last is being packed is left out.

#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

#include "engine/control/control_message.hpp"
#include "engine/core/job_thread.hpp"
#include "engine/image/image.hpp"

namespace septet::screen {

/// The picture within 160 × 120 pixels, its sides' ratio kept: each pixel the mean of up to 4 × 4 of those that it stands for. A smaller one as it is.
image::Image thumbnail_of(const image::Image& picture);

class ThumbnailMaker {
 public:
  ThumbnailMaker();
  void take(Tick tick, const image::Image& picture) { thread_.give_if_idle({tick, thumbnail_of(picture)}); }
  /// The newest that is ready, once.
  std::optional<control::Thumbnail> finished();

 private:
  struct Job {
    Tick tick = 0;
    image::Image picture;
  };
  std::mutex mutex_;
  std::optional<control::Thumbnail> finished_;
  JobThread<Job> thread_;  ///< Last: it is gone before the rest.
};

}  // namespace septet::screen
