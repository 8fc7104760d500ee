#pragma once
/// Writing a file that has its name only when it is whole: until then it is NAME.part.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

#include "engine/core/expected.hpp"

namespace septet {

/// Lets `fill` write NAME.part and gives that the name. What stood there stays until then, and a failure leaves no part.
/// Error: that of `fill`, or why the part cannot take the name.
Expected<void> write_whole_file(const std::filesystem::path& path,
                                const std::function<Expected<void>(const std::filesystem::path& part)>& fill);

/// The same with these bytes, which are, in the Error's words, an `image` or the like. A device or a pipe is written to.
Expected<void> write_whole_file(const std::filesystem::path& path, std::string_view what,
                                std::span<const std::byte> bytes);

}  // namespace septet
