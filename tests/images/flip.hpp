#pragma once
/// Perceived difference of two pictures for a viewer who flips between them: LDR-FLIP.
///
/// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A Difference Evaluator for Alternating
/// Images" (2020), with its constants: 0.7 m from a screen 0.7 m wide with 3840 pixels. The mirror of flip.py, for
/// tests that draw hundreds of pictures.

#include <vector>

#include "engine/image/image.hpp"

namespace septet {

/// Features of a picture for comparison with others of its size.
struct FlipFeatures {
  std::uint32_t width = 0, height = 0;
  std::vector<float> lightness, green_red, blue_yellow;  ///< Filtered by contrast sensitivity, Hunt-adjusted Lab.
  std::vector<float> edges, points;
};
FlipFeatures flip_features(const image::Image& picture);

/// One number a pixel, row by row, 0 alike to 1. The two are of one size.
std::vector<float> flip(const FlipFeatures& reference, const FlipFeatures& picture);

}  // namespace septet
