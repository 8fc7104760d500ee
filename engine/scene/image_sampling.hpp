#pragma once
/// How an image is read between and beyond its pixels.

namespace septet::scene {

struct ImageSampling {
  bool clamps_u = false, clamps_v = false;  ///< Goes on as its edges' pixels are beyond them; otherwise it repeats.
  bool sharp = false;  ///< Near to, each place has the colour of one pixel; otherwise of a mean between four.
  bool operator==(const ImageSampling&) const = default;
};

}  // namespace septet::scene
