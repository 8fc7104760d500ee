#pragma once
/// Writes pictures to disk on a thread of its own, so that the frame after the one that is kept does not wait for it. A picture has its name
/// only when it is whole: until then it is NAME.part.

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>

#include "engine/core/expected.hpp"
#include "engine/image/image.hpp"

namespace septet::frame {

class PictureWriter {
 public:
  PictureWriter();
  ~PictureWriter();  ///< Writes what is queued.
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// Queues one picture; waits while four are queued already. Answers the first failure of an earlier one.
  Expected<void> write(std::filesystem::path file, image::Image picture);
  /// Waits until everything is written; returns the first failure.
  Expected<void> finish();

 private:
  struct Job {
    std::filesystem::path file;
    image::Image picture;
  };
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  bool writing_ = false;
  bool stop_ = false;
  std::optional<Error> error_;
  std::thread thread_;
};

}  // namespace septet::frame
