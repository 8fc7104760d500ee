#pragma once
/// One frame of a film by the rasteriser, with its overlay.

#include "engine/core/expected.hpp"
#include "engine/image/image.hpp"
#include "engine/render/renderer.hpp"
#include "sim-client/film/film_frames.hpp"

namespace septet::film {

/// Off-screen rasteriser of the film's size that holds its scene.
Expected<render::Renderer> make_rasteriser(const FilmOptions& options, const scene::ResolvedScene& scene);

/// The picture of a frame with its overlay; of two cameras, the halves of two pictures.
Expected<image::Image> draw_frame(FilmFrames& frames, const FilmFrame& frame, render::Renderer& rasteriser);

}  // namespace septet::film
