#include "engine/render/vulkan/block_allocator.hpp"

#include <algorithm>

#include "engine/core/check.hpp"

namespace septet::render::vulkan {

BlockAllocator::BlockAllocator(std::uint64_t size) : size_(size), gaps_{{0, size}} {}

std::optional<std::uint64_t> BlockAllocator::allocate(std::uint64_t size, std::uint64_t alignment) {
  SEPTET_CHECK(size > 0 && alignment > 0, "{} bytes aligned to {}", size, alignment);
  for (std::size_t i = 0; i < gaps_.size(); ++i) {
    const Gap gap = gaps_[i];
    const std::uint64_t begin = (gap.begin + alignment - 1) / alignment * alignment;
    if (begin + size > gap.end) continue;
    // Bytes skipped for the alignment stay a gap of their own.
    std::vector<Gap> rest;
    if (begin > gap.begin) rest.push_back({gap.begin, begin});
    if (begin + size < gap.end) rest.push_back({begin + size, gap.end});
    const auto at = gaps_.erase(gaps_.begin() + static_cast<std::ptrdiff_t>(i));
    gaps_.insert(at, rest.begin(), rest.end());
    return begin;
  }
  return std::nullopt;
}

void BlockAllocator::free(std::uint64_t offset, std::uint64_t size) {
  const auto after = std::lower_bound(gaps_.begin(), gaps_.end(), offset,
                                      [](const Gap& gap, std::uint64_t begin) { return gap.begin < begin; });
  const bool clear_before = after == gaps_.begin() || std::prev(after)->end <= offset;
  const bool clear_after = after == gaps_.end() || offset + size <= after->begin;
  SEPTET_CHECK(offset + size <= size_ && clear_before && clear_after, "freeing {} bytes at {} that are free", size,
               offset);
  auto gap = gaps_.insert(after, {offset, offset + size});
  if (const auto next = std::next(gap); next != gaps_.end() && next->begin == gap->end) {
    gap->end = next->end;
    gap = std::prev(gaps_.erase(next));
  }
  if (gap != gaps_.begin() && std::prev(gap)->end == gap->begin) {
    std::prev(gap)->end = gap->end;
    gaps_.erase(gap);
  }
}

std::uint64_t BlockAllocator::free_bytes() const {
  std::uint64_t bytes = 0;
  for (const Gap& gap : gaps_) bytes += gap.end - gap.begin;
  return bytes;
}

}  // namespace septet::render::vulkan
