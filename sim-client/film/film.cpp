#include "sim-client/film/film.hpp"

#include "engine/image/png.hpp"
#include "engine/raytrace/displayed.hpp"
#include "engine/render/renderer.hpp"
#include "sim-client/film/film_file.hpp"
#include "sim-client/film/film_folder.hpp"
#include "sim-client/film/film_frames.hpp"
#include "sim-client/frame/picture_writer.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

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
  /// The preview lies in `folder`.
  static Expected<FilmPainter> create(const FilmOptions& options, const fs::path& folder,
                                      const scene::ResolvedScene& scene) {
    FilmPainter painter(options, folder);
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
  FilmPainter(const FilmOptions& options, fs::path folder) : options_(&options), folder_(std::move(folder)) {}

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
    fs::remove(folder_ / "preview.png", ignored);
    if (!goes_on) return std::nullopt;
    return raytrace::displayed(picture, exposure);
  }

  /// Whoever looks sees a whole file. Without one the film is made none the less.
  void show_preview(const image::Image& picture) const {
    const fs::path part = folder_ / "preview.part";
    std::error_code ignored;
    if (image::write_png(part, picture, image::PngEffort::fast)) fs::rename(part, folder_ / "preview.png", ignored);
    fs::remove(part, ignored);
  }

  const FilmOptions* options_;
  fs::path folder_;
  std::optional<render::Renderer> rasteriser_;
  std::optional<raytrace::RayTracer> tracer_;
  instant::SceneSummary summary_;
};

/// Those that are not there yet, until all are or `go_on` says no.
Expected<void> draw_pictures(const FilmOptions& options, FilmFrames& frames, FilmPainter& painter,
                             const FilmFolder& folder, FilmMade& made,
                             const std::function<bool(const FilmMade&)>& go_on) {
  frame::PictureWriter pictures;
  for (const FilmFrame& frame : frames.plan().frames) {
    if (!go_on(made)) break;
    if (options.resume && folder.has(frame.number, options.width_px, options.height_px)) {
      ++made.frames, ++made.kept;
      continue;
    }
    auto input = frames.input_of(frame);
    if (!input) return tl::unexpected(input.error());
    auto picture = painter.draw(std::move(*input), frame.number, made, go_on);
    if (!picture) return tl::unexpected(picture.error());
    if (!*picture) break;
    if (auto queued = pictures.write(folder.picture(frame.number), std::move(**picture)); !queued) return queued;
    ++made.frames;
  }
  return pictures.finish();
}

}  // namespace

Expected<FilmMade> make_film(const FilmOptions& options, const std::function<bool(const FilmMade&)>& go_on) {
  const auto is_file = is_film_file(options.out);
  if (!is_file) return tl::unexpected(is_file.error());
  fs::path ffmpeg, pictures_in = options.out;
  if (*is_file) {
    std::error_code error;
    if (fs::exists(options.out, error))
      return failure("it is there already", options.out.string(), "choose another name with --out");
    const auto found = find_ffmpeg();
    if (!found) return tl::unexpected(found.error());
    ffmpeg = *found;
    pictures_in += ".pictures";
  }
  if (auto is_free = FilmFolder::check_is_free(pictures_in, options.resume); !is_free)
    return tl::unexpected(is_free.error());
  auto frames = FilmFrames::open(options);
  if (!frames) return tl::unexpected(frames.error());
  const auto record = film_record(options, frames->session());
  if (!record) return tl::unexpected(record.error());
  auto painter = FilmPainter::create(options, pictures_in, frames->scene());
  if (!painter) return tl::unexpected(painter.error());
  const auto folder = FilmFolder::open(pictures_in, *record, options.resume);
  if (!folder) return tl::unexpected(folder.error());
  FilmMade made{.planned = frames->plan().frames.size()};
  if (auto drawn = draw_pictures(options, *frames, *painter, *folder, made, go_on); !drawn)
    return tl::unexpected(drawn.error());
  made.stopped = made.frames < made.planned;
  if (!*is_file || made.stopped) return made;
  std::vector<fs::path> pictures;
  for (const FilmFrame& frame : frames->plan().frames) pictures.push_back(folder->picture(frame.number));
  made.encoding = true;
  const auto whole = encode_film(ffmpeg, pictures, options.frames_per_second, options.out, [&] { return go_on(made); });
  if (!whole) return tl::unexpected(whole.error());
  made.stopped = !*whole;
  std::error_code ignored;
  if (*whole) fs::remove_all(pictures_in, ignored);
  return made;
}

}  // namespace septet::film
