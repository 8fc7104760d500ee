#pragma once
/// Writes pictures to disk on a thread of its own, so that the next frame does not wait for it. A picture gets its name
/// only when it is whole: until then it is NAME.part.

#include <filesystem>

#include "engine/core/expected.hpp"
#include "engine/core/job_thread.hpp"
#include "engine/image/image.hpp"

namespace septet::frame {

class PictureWriter {
 public:
  PictureWriter();  ///< The destructor writes the rest of the queue.

  /// Queues one picture; waits while four are queued already. Returns the first failure of an earlier one.
  Expected<void> write(std::filesystem::path file, image::Image picture);
  /// Waits until everything is written; returns the first failure.
  Expected<void> finish();

 private:
  struct Job {
    std::filesystem::path file;
    image::Image picture;
  };
  JobThread<Job> thread_;
};

}  // namespace septet::frame
