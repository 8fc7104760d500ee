#pragma once
/// Pictures as JPEG files (ITU-T T.81, by libjpeg-turbo). Written, baseline, for remote viewers: a tenth of a PNG's
/// bytes, not the same pixels. Read, baseline and progressive, as users' models hold them.
/// Thread-safe: no shared state.

#include <cstdint>
#include <span>
#include <string_view>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/image/image.hpp"

namespace septet::image {

/// `quality` from 1 to 100; colour at half the resolution. Empty for a picture without pixels or of more than 16,384 a
/// side, and where memory is out.
Bytes encode_jpeg(const Image& image, int quality = 80);

/// True if the bytes begin as a JPEG's do.
bool begins_as_jpeg(std::span<const std::byte> bytes);

/// Pixels as stored: an orientation that a camera noted is not applied. Error: not a JPEG, cut off, damaged, of four
/// inks, or larger than `most_px` a side. `where` names the source in errors.
Expected<Image> decode_jpeg(std::span<const std::byte> bytes, std::string_view where, std::uint32_t most_px = 16384);

}  // namespace septet::image
