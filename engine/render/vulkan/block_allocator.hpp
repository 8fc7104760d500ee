#pragma once
/// Which part of a block of memory is free: first fit over a sorted list of gaps, neighbours merged when freed.
///
/// Pure bookkeeping of offsets, so that it is tested without a device.

#include <cstdint>
#include <optional>
#include <vector>

namespace septet::render::vulkan {

class BlockAllocator {
 public:
  explicit BlockAllocator(std::uint64_t size);

  /// The offset of `size` bytes (more than zero), a multiple of `alignment`, or nothing where no gap is large enough.
  std::optional<std::uint64_t> allocate(std::uint64_t size, std::uint64_t alignment);
  /// Gives back exactly what was allocated at `offset`.
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
