#pragma once
/// The one queue between threads: values are pushed one by one and taken in batches, in order. Its bound makes a slow
/// reader visible to the writer: it is full once the sizes of its values, in a unit of the writer's choice, reach the
/// capacity. Thread-safe.

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace septet {

template <class T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

  /// Returns false, with the value untouched, where the queue is full or closed.
  bool try_push(T& value, std::size_t size = 1) {
    const std::lock_guard lock(mutex_);
    return push_if_open(value, size);
  }
  /// Waits for room. Returns false where the queue is closed, before or during the wait.
  bool push(T& value, std::size_t size = 1) {
    std::unique_lock lock(mutex_);
    has_room_.wait(lock, [&] { return closed_ || !is_full(); });
    return push_if_open(value, size);
  }
  /// Takes all values into `batch` (emptied first), after waiting for `enough` values, the deadline or the close.
  /// Returns false once the queue is closed and empty.
  bool take_all(std::vector<T>& batch, std::chrono::steady_clock::time_point deadline, std::size_t enough = 1) {
    batch.clear();
    std::unique_lock lock(mutex_);
    enough_ = enough;
    has_enough_.wait_until(lock, deadline, [&] { return closed_ || has_enough(); });
    batch.swap(values_);
    size_ = 0;
    has_room_.notify_all();
    return !batch.empty() || !closed_;
  }
  /// Refuses further values; those in the queue can still be taken.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    has_enough_.notify_all();
    has_room_.notify_all();
  }

 private:
  bool is_full() const { return size_ >= capacity_; }
  bool has_enough() const { return values_.size() >= enough_ || is_full(); }
  bool push_if_open(T& value, std::size_t size) {
    if (closed_ || is_full()) return false;
    values_.push_back(std::move(value));
    size_ += size;
    if (has_enough()) has_enough_.notify_one();
    return true;
  }

  const std::size_t capacity_;
  std::mutex mutex_;
  std::condition_variable has_enough_, has_room_;
  std::vector<T> values_;
  std::size_t size_ = 0;    ///< Sum over `values_`, in the writer's unit.
  std::size_t enough_ = 1;  ///< Number that the taker waits for.
  bool closed_ = false;
};

}  // namespace septet
