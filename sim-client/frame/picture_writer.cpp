#include "sim-client/frame/picture_writer.hpp"

#include "engine/image/png.hpp"

namespace septet::frame {
PictureWriter::PictureWriter() : thread_([this] { run(); }) {}

PictureWriter::~PictureWriter() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

Expected<void> PictureWriter::write(std::filesystem::path file, image::Image picture) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return jobs_.size() < 4; });
  if (error_) return tl::unexpected(*error_);
  jobs_.push_back({std::move(file), std::move(picture)});
  changed_.notify_all();
  return {};
}

Expected<void> PictureWriter::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return jobs_.empty() && !writing_; });
  if (error_) return tl::unexpected(*error_);
  return {};
}

void PictureWriter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return stop_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    writing_ = true;
    lock.unlock();
    const auto written = image::write_png(job.file, job.picture, image::PngEffort::fast);
    lock.lock();
    writing_ = false;
    if (!written && !error_) error_ = written.error();
    changed_.notify_all();
  }
}

}  // namespace septet::frame
