#include "engine/render/vulkan/block_allocator.hpp"

#include <vector>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"

namespace septet::render::vulkan {

TEST_CASE("offsets are aligned and parts never overlap whatever the order of allocating and freeing") {
  constexpr std::uint64_t size = 1 << 16;
  BlockAllocator allocator(size);
  Random random(3);
  struct Part {
    std::uint64_t offset, size;
  };
  std::vector<Part> parts;
  std::vector<bool> taken(size);
  int made = 0, refused = 0;
  for (int step = 0; step < 4000; ++step) {
    if (parts.empty() || random.uniform() < 0.55) {
      const auto bytes = static_cast<std::uint64_t>(random.uniform(1.0, 3000.0));
      const std::uint64_t alignment = std::uint64_t{1} << static_cast<int>(random.uniform(0.0, 9.0));
      const auto offset = allocator.allocate(bytes, alignment);
      if (!offset) {
        ++refused;
        continue;
      }
      ++made;
      REQUIRE(*offset % alignment == 0);
      REQUIRE(*offset + bytes <= size);
      for (std::uint64_t i = *offset; i < *offset + bytes; ++i) {
        REQUIRE_FALSE(taken[i]);
        taken[i] = true;
      }
      parts.push_back({*offset, bytes});
    } else {
      const auto index = static_cast<std::size_t>(random.uniform() * static_cast<double>(parts.size()));
      const Part part = parts[index];
      allocator.free(part.offset, part.size);
      for (std::uint64_t i = part.offset; i < part.offset + part.size; ++i) taken[i] = false;
      parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(index));
    }
  }
  CHECK(made > 1000);
  CHECK(refused > 0);
}

TEST_CASE("once everything is freed the whole block is one gap again") {
  BlockAllocator allocator(4096);
  const auto a = allocator.allocate(1000, 64), b = allocator.allocate(1000, 256), c = allocator.allocate(500, 4);
  REQUIRE((a && b && c));
  allocator.free(*b, 1000);
  allocator.free(*a, 1000);
  allocator.free(*c, 500);
  CHECK(allocator.free_bytes() == 4096);
  CHECK(allocator.allocate(4096, 1) == std::uint64_t{0});
}

}  // namespace septet::render::vulkan
