#include "sim-client/film/film.hpp"

#include <fmt/core.h>

#include "engine/render/renderer.hpp"
#include "sim-client/film/film_frames.hpp"
#include "sim-client/frame/picture_writer.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

/// Nothing that is in the folder for the pictures is touched.
Expected<void> check_is_free(const fs::path& out) {
  std::error_code error;
  if (fs::exists(out, error) && !(fs::is_directory(out, error) && fs::is_empty(out, error)))
    return failure("it is there already and not an empty folder", out.string(), "choose a new folder with --out");
  return {};
}

Expected<void> make_folder(const fs::path& out) {
  std::error_code error;
  fs::create_directories(out, error);
  if (error) return failure(error.message(), out.string(), "choose a folder that can be written with --out");
  return {};
}

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

Expected<image::Image> draw(render::Renderer& renderer, FilmFrames& frames, const FilmFrame& frame) {
  auto input = frames.input_of(frame);
  if (!input) return tl::unexpected(input.error());
  if (auto drawn = renderer.draw(std::move(*input)); !drawn) return tl::unexpected(drawn.error());
  return renderer.read_back();
}

}  // namespace

Expected<FilmMade> make_film(const FilmOptions& options, const std::function<bool(const FilmMade&)>& go_on) {
  if (auto is_free = check_is_free(options.out); !is_free) return tl::unexpected(is_free.error());
  auto frames = FilmFrames::open(options);
  if (!frames) return tl::unexpected(frames.error());
  auto renderer = make_rasteriser(options, frames->scene());
  if (!renderer) return tl::unexpected(renderer.error());
  if (auto folder = make_folder(options.out); !folder) return tl::unexpected(folder.error());
  frame::PictureWriter pictures;
  const std::vector<FilmFrame>& due = frames->plan().frames;
  FilmMade made{0, due.size()};
  while (made.frames < made.planned && go_on(made)) {
    auto picture = draw(*renderer, *frames, due[made.frames]);
    if (!picture) return tl::unexpected(picture.error());
    const fs::path file = options.out / fmt::format("{:06}.png", due[made.frames].number);
    if (auto queued = pictures.write(file, std::move(*picture)); !queued) return tl::unexpected(queued.error());
    ++made.frames;
  }
  if (auto written = pictures.finish(); !written) return tl::unexpected(written.error());
  return made;
}

}  // namespace septet::film
