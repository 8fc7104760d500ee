#pragma once
/// Free parts of a block of memory: first fit over a sorted list of gaps, neighbours merged when freed.
///
/// Pure bookkeeping of offsets, so that it is tested without a device.

#include <cstdint>
#include <optional>
#include <vector>

namespace septet::render::vulkan {

class BlockAllocator {
 public:
  explicit BlockAllocator(std::uint64_t size);

  /// Returns the offset of `size` bytes (more than zero), a multiple of `alignment`; empty if no gap is large enough.
  std::optional<std::uint64_t> allocate(std::uint64_t size, std::uint64_t alignment);
  /// Frees exactly the range allocated at `offset`.
  void free(std::uint64_t offset, std::uint64_t size);

  std::uint64_t size() const { return size_; }
  std::uint64_t free_bytes() const;

 private:
  struct Gap {
    std::uint64_t begin, end;
  };
  std::uint64_t size_;
  std::vector<Gap> gaps_;  ///< Ascending, never touching.
};

}  // namespace septet::render::vulkan
