#pragma once
/// Limits of one command; the store's limits on the whole are in store.hpp.

#include <cstddef>

namespace septet::scene {

inline constexpr std::size_t max_name_bytes = 255;
inline constexpr std::size_t max_tag_string_bytes = 4096;
inline constexpr std::size_t max_tag_blob_bytes = 4096;
inline constexpr std::size_t max_run_values = 1u << 18;  ///< Numbers in one range command.
inline constexpr std::size_t max_run_bytes = 1u << 20;   ///< Bytes of tiles in one range command.

}  // namespace septet::scene
