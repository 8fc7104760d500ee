#pragma once
/// One thread that does jobs in order, so that the caller does not wait: few and large ones, such as pictures to be
/// written. (Values in thousands go through a BoundedQueue.) Any number of threads may give jobs.

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "engine/core/expected.hpp"

namespace septet {

template <class Job>
class JobThread {
 public:
  /// `work` runs on the thread; it and its captures must outlive this object.
  JobThread(std::size_t most_waiting, std::function<Expected<void>(Job&)> work)
      : most_waiting_(most_waiting), work_(std::move(work)), thread_([this] { run(); }) {}
  /// Completes the waiting jobs.
  ~JobThread() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }
  JobThread(const JobThread&) = delete;
  JobThread& operator=(const JobThread&) = delete;

  /// Waits while `most_waiting` jobs are waiting. Returns the first failure of an earlier job; then this one is not
  /// done.
  Expected<void> give(Job job) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return jobs_.size() < most_waiting_; });
    if (error_) return tl::unexpected(*error_);
    jobs_.push_back(std::move(job));
    changed_.notify_all();
    return {};
  }
  /// Gives the job only where the thread is idle; drops it otherwise.
  void give_if_idle(Job job) {
    const std::lock_guard lock(mutex_);
    if (!has_nothing()) return;
    jobs_.push_back(std::move(job));
    changed_.notify_all();
  }
  /// True where no job is waiting or running. It stays so until a job is given.
  bool is_idle() {
    const std::lock_guard lock(mutex_);
    return has_nothing();
  }
  /// Waits until all jobs are done; returns the first failure.
  Expected<void> wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return has_nothing(); });
    if (error_) return tl::unexpected(*error_);
    return {};
  }

 private:
  bool has_nothing() const { return jobs_.empty() && !working_; }
  void run() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] { return stop_ || !jobs_.empty(); });
      if (jobs_.empty()) return;
      Job job = std::move(jobs_.front());
      jobs_.pop_front();
      working_ = true;
      lock.unlock();
      const auto done = work_(job);
      lock.lock();
      working_ = false;
      if (!done && !error_) error_ = done.error();
      changed_.notify_all();
    }
  }

  const std::size_t most_waiting_;
  const std::function<Expected<void>(Job&)> work_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  bool working_ = false, stop_ = false;
  std::optional<Error> error_;
  std::thread thread_;
};

}  // namespace septet
