#pragma once
/// Images as PNG files (libpng). Any PNG is read; 8-bit RGBA is written. Thread-safe: no shared state.

#include <filesystem>
#include <span>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/image/image.hpp"

namespace septet::image {

/// `fast` costs a third of the time of `small` and gives larger files; the pixels are the same.
enum class PngEffort { fast, small };

Bytes encode_png(const Image& image, PngEffort effort = PngEffort::small);

/// Error: not a PNG, or larger than 16,384 pixels a side. `where` names the source in errors.
Expected<Image> decode_png(std::span<const std::byte> bytes, std::string_view where);

/// Whole or not at all: it is written beside its place (`.part`) and renamed. Error: the system's reason (no such
/// folder, no permission, disk full); an older file stays.
Expected<void> write_png(const std::filesystem::path& path, const Image& image, PngEffort effort = PngEffort::small);

Expected<Image> read_png(const std::filesystem::path& path);

}  // namespace septet::image
