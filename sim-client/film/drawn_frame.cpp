#include "sim-client/film/drawn_frame.hpp"

#include <utility>

namespace septet::film {
namespace {

/// Takes over the right half.
void put_beside(const image::Image& second, image::Image& picture) {
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = picture.width / 2; x < picture.width; ++x) picture.set(x, y, second.at(x, y));
}

}  // namespace

Expected<render::Renderer> make_rasteriser(const FilmOptions& options, const scene::ResolvedScene& scene) {
  render::RendererOptions target;
  target.width = options.width_px;
  target.height = options.height_px;
  if (options.software) target.device = render::DevicePreference::software;
  auto renderer = render::Renderer::create(target);
  if (!renderer) return renderer;
  if (auto uploaded = renderer->upload(scene); !uploaded) return tl::unexpected(uploaded.error());
  return renderer;
}

Expected<image::Image> draw_frame(FilmFrames& frames, const FilmFrame& frame, render::Renderer& rasteriser) {
  const auto drawn = [&](instant::FrameInput input) -> Expected<image::Image> {
    if (auto done = rasteriser.draw(std::move(input)); !done) return tl::unexpected(done.error());
    return rasteriser.read_back();
  };
  auto input = frames.input_of(frame);
  if (!input) return tl::unexpected(input.error());
  if (auto uploaded = rasteriser.upload(frames.scene()); !uploaded) return tl::unexpected(uploaded.error());
  auto picture = drawn(std::move(*input));
  if (!picture) return picture;
  auto beside = frames.input_beside(frame);
  if (!beside) return tl::unexpected(beside.error());
  if (*beside) {
    const auto second = drawn(std::move(**beside));
    if (!second) return second;
    put_beside(*second, *picture);
  }
  frames.draw_over(frame, *picture);
  return picture;
}

}  // namespace septet::film
