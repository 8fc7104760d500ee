#pragma once
/// Pictures as JPEG files (ITU-T T.81, baseline, by libjpeg-turbo), for remote viewers: a tenth of a PNG's bytes, not
/// the same pixels. Thread-safe: no shared state.

#include "engine/core/bytes.hpp"
#include "engine/image/image.hpp"

namespace septet::image {

/// `quality` from 1 to 100; colour at half the resolution. Empty for a picture without pixels or of more than 16,384 a
/// side, and where memory is out.
Bytes encode_jpeg(const Image& image, int quality = 80);

}  // namespace septet::image
