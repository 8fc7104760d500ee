#pragma once
/// Writes a file that takes its name only when it is complete: until then it is NAME.part.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

#include "engine/core/expected.hpp"

namespace septet {

/// Lets `fill` write NAME.part and renames it. An older file stays until then, and a failure leaves no part. Error:
/// that of `fill`, or the reason why the part cannot be renamed.
Expected<void> write_whole_file(const std::filesystem::path& path,
                                const std::function<Expected<void>(const std::filesystem::path& part)>& fill);

/// Writes these bytes likewise; the Error calls them `what`, an "image" or the like. A device or a pipe is written to
/// directly.
Expected<void> write_whole_file(const std::filesystem::path& path, std::string_view what,
                                std::span<const std::byte> bytes);

}  // namespace septet
