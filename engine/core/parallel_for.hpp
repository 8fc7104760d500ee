#pragma once
/// A loop over independent indices, on all of the machine's cores.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace septet {

/// Calls `body(i)` once for each i below `count`, on `threads` threads at most, of which the calling one is one, and
/// returns when all are done. `body` must be safe to call on several threads at once and must not throw.
template <class Body>
void parallel_for(std::size_t count, const Body& body, std::size_t threads = std::thread::hardware_concurrency()) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) body(i);
  };
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < std::min(threads, count); ++i) others.emplace_back(work);
  work();
}

}  // namespace septet
