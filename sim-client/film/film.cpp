#include "sim-client/film/film.hpp"

#include <fmt/core.h>

#include "engine/image/png.hpp"
#include "engine/raytrace/displayed.hpp"
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

/// One frame after the other, by one of the renderers.
class FilmPainter {
 public:
  static Expected<FilmPainter> create(const FilmOptions& options, const scene::ResolvedScene& scene) {
    FilmPainter painter(options);
    if (options.renderer == FilmRenderer::raster) {
      auto rasteriser = make_rasteriser(options, scene);
      if (!rasteriser) return tl::unexpected(rasteriser.error());
      painter.rasteriser_.emplace(std::move(*rasteriser));
    } else {
      auto tracer = raytrace::RayTracer::create(scene);
      if (!tracer) return tl::unexpected(tracer.error());
      painter.tracer_.emplace(std::move(*tracer));
      painter.summary_ = instant::summarise(scene);
    }
    return painter;
  }

  /// Nothing where `go_on` has said no.
  Expected<std::optional<image::Image>> draw(instant::FrameInput input, std::uint64_t number, FilmMade& made,
                                             const std::function<bool(const FilmMade&)>& go_on) {
    if (!rasteriser_) return trace(std::move(input), number, made, go_on);
    if (auto drawn = rasteriser_->draw(std::move(input)); !drawn) return tl::unexpected(drawn.error());
    return rasteriser_->read_back().map([](image::Image picture) { return std::optional(std::move(picture)); });
  }

 private:
  explicit FilmPainter(const FilmOptions& options) : options_(&options) {}

  Expected<std::optional<image::Image>> trace(instant::FrameInput input, std::uint64_t number, FilmMade& made,
                                              const std::function<bool(const FilmMade&)>& go_on) {
    const std::uint32_t width = options_->width_px, height = options_->height_px;
    raytrace::TraceSettings settings;
    settings.samples = options_->samples;
    settings.seed = number;  // Another noise in each frame.
    tracer_->begin(instant::describe(std::move(input), summary_), settings);
    const instant::Exposure exposure = tracer_->instant().exposure;
    raytrace::TracedPicture so_far(width, height);
    const double pixels = double(width) * double(height);
    double traced = 0.0, shown = 0.0;
    bool goes_on = true;
    const auto picture = raytrace::whole_picture(*tracer_, width, height, [&](const raytrace::Bucket& bucket) {
      so_far.put(bucket);
      traced += static_cast<double>(bucket.pixels.size());
      made.share_of_next = traced / pixels;
      if (made.share_of_next >= shown + 0.125) {
        shown = made.share_of_next;
        show_preview(raytrace::displayed(so_far, exposure));
      }
      goes_on = goes_on && go_on(made);
      return goes_on;
    });
    made.share_of_next = 0.0;
    made.bad_samples += picture.bad_samples;
    std::error_code ignored;
    fs::remove(options_->out / "preview.png", ignored);
    if (!goes_on) return std::nullopt;
    return raytrace::displayed(picture, exposure);
  }

  /// Whoever looks sees a whole file. Without one the film is made none the less.
  void show_preview(const image::Image& picture) const {
    const fs::path part = options_->out / "preview.part";
    std::error_code ignored;
    if (image::write_png(part, picture, image::PngEffort::fast))
      fs::rename(part, options_->out / "preview.png", ignored);
    fs::remove(part, ignored);
  }

  const FilmOptions* options_;
  std::optional<render::Renderer> rasteriser_;
  std::optional<raytrace::RayTracer> tracer_;
  instant::SceneSummary summary_;
};

}  // namespace

Expected<FilmMade> make_film(const FilmOptions& options, const std::function<bool(const FilmMade&)>& go_on) {
  if (auto is_free = check_is_free(options.out); !is_free) return tl::unexpected(is_free.error());
  auto frames = FilmFrames::open(options);
  if (!frames) return tl::unexpected(frames.error());
  auto painter = FilmPainter::create(options, frames->scene());
  if (!painter) return tl::unexpected(painter.error());
  if (auto folder = make_folder(options.out); !folder) return tl::unexpected(folder.error());
  frame::PictureWriter pictures;
  const std::vector<FilmFrame>& due = frames->plan().frames;
  FilmMade made{.planned = due.size()};
  while (made.frames < made.planned && go_on(made)) {
    auto input = frames->input_of(due[made.frames]);
    if (!input) return tl::unexpected(input.error());
    auto picture = painter->draw(std::move(*input), due[made.frames].number, made, go_on);
    if (!picture) return tl::unexpected(picture.error());
    if (!*picture) break;
    const fs::path file = options.out / fmt::format("{:06}.png", due[made.frames].number);
    if (auto queued = pictures.write(file, std::move(**picture)); !queued) return tl::unexpected(queued.error());
    ++made.frames;
  }
  if (auto written = pictures.finish(); !written) return tl::unexpected(written.error());
  return made;
}

}  // namespace septet::film
