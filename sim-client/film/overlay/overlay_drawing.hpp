#pragma once
/// Draws a film's overlay onto a picture, and reads its figures back from the pixels. Pure but for the font.

#include <string>

#include "sim-client/film/overlay/overlay_content.hpp"

namespace septet::film {

void draw(const OverlayContent& content, const image::Font& font, image::Image& picture);

/// Text of a figure, read from the pixels of its box: each cell is compared with each character that a figure can
/// have, drawn likewise. A cell that equals none gives '?'.
std::string read_figure(const image::Image& picture, const OverlayLine& figure, const image::Font& font);

}  // namespace septet::film
