#include "sim-client/film/traced/frame_writer.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "engine/core/check.hpp"
#include "engine/core/version.hpp"
#include "engine/image/png.hpp"
#include "engine/raytrace/denoise.hpp"
#include "engine/raytrace/displayed.hpp"

namespace septet::film {
namespace fs = std::filesystem;
namespace {

struct Assembled {
  raytrace::TracedPicture picture;
  FrameFacts facts;
  std::size_t missing = 0;
};

Assembled assembled(const FilmOptions& options, const KeptTiles& kept, std::span<const instant::PixelRectangle> tiles) {
  Assembled whole{raytrace::TracedPicture(options.width_px, options.height_px), {}, 0};
  const std::size_t places = tiles.size() / options.sample_sets;
  for (std::size_t n = 0; n < places; ++n) {
    raytrace::Bucket bucket{tiles[n], {}};
    std::vector<std::vector<raytrace::TracedPixel>> sets;
    for (std::size_t tile_number = n; tile_number < tiles.size(); tile_number += places) {
      auto tile = kept.read(static_cast<std::uint32_t>(tile_number));
      if (!tile) {
        ++whole.missing;
        continue;
      }
      whole.facts = tile->facts;
      sets.push_back(std::move(tile->pixels));
    }
    if (sets.empty()) continue;
    bucket.pixels = std::move(sets.front());
    for (std::size_t pixel = 0; sets.size() > 1 && pixel < bucket.pixels.size(); ++pixel) {
      std::vector<raytrace::TracedPixel> of_sets{bucket.pixels[pixel]};
      for (std::size_t set = 1; set < sets.size(); ++set) of_sets.push_back(sets[set][pixel]);
      bucket.pixels[pixel] = raytrace::joined(of_sets);
    }
    whole.picture.put(bucket);
  }
  return whole;
}

image::Image displayed(const Assembled& whole) {
  return raytrace::displayed(whole.picture, instant::Exposure{static_cast<float>(whole.facts.ev100)});
}

ExrFacts exr_facts(const FilmOptions& options, const logging::SessionInfo& session) {
  ExrFacts facts{.septet = version_text(),
                 .session = session.started_utc + " " + session.git_revision,
                 .ticks_per_second = session.ticks_per_second,
                 .frames_per_second = options.frames_per_second,
                 .samples = options.samples};
  for (const auto& [name, seed] : session.seeds)
    facts.drive_seeds += fmt::format("{}{} {}", facts.drive_seeds.empty() ? "" : "\n", name, seed);
  return facts;
}

}  // namespace

FrameWriter::FrameWriter(const FilmOptions& options, const FilmFolder& folder, const FilmFrames& frames,
                         std::span<const instant::PixelRectangle> tiles)
    : options_(options),
      folder_(folder),
      exr_facts_(exr_facts(options, frames.session())),
      has_overlays_(std::ranges::any_of(frames.plan().script.shots,
                                        [](const Shot& shot) { return shot.overlay || shot.beside; })),
      tiles_(tiles),
      preview_(folder.path() / "preview.png"),
      thread_(4, [this](Job& job) { return write(job); }) {}

Expected<void> FrameWriter::finish(std::uint64_t frame, KeptTiles tiles, fs::path kept_in) {
  return thread_.give({frame, std::move(tiles), std::move(kept_in)});
}

void FrameWriter::show_preview(fs::path kept_in) { thread_.give_if_idle({0, std::nullopt, std::move(kept_in)}); }

Expected<void> FrameWriter::wait() {
  auto written = thread_.wait();
  std::error_code ignored;
  fs::remove(preview_, ignored);
  return written;
}

FrameWriter::Quality FrameWriter::quality() {
  const std::lock_guard lock(mutex_);
  return quality_;
}

Expected<void> FrameWriter::write(Job& job) {
  std::error_code error;
  if (!job.tiles) {
    // A reader sees a whole file; a failure to write it does not stop the film. The frame may be whole and its tiles
    // gone by now.
    if (!fs::exists(job.kept_in, error)) return {};
    if (const auto kept = KeptTiles::open(job.kept_in, tiles_))
      (void)image::write_png(preview_, displayed(assembled(options_, *kept, tiles_)), image::PngEffort::fast);
    return {};
  }
  Assembled whole = assembled(options_, *job.tiles, tiles_);
  if (whole.missing > 0)
    return failure("what was written there cannot be read", job.kept_in.string(),
                   "check the disk and add --resume to go on");
  const instant::Exposure exposure{static_cast<float>(whole.facts.ev100)};
  note_quality(whole.picture, exposure);
  if (options_.denoise) whole.picture = raytrace::denoised(whole.picture, exposure);
  // The picture comes last: its presence marks the frame as whole.
  if (options_.exr != ExrNumbers::none) {
    exr_facts_.frame = job.frame;
    const exr::Picture light = exr_picture(whole.picture, whole.facts, exr_facts_, options_.exr, options_.layers);
    if (auto written = exr::write(folder_.exr_picture(job.frame), light); !written) return written;
  }
  image::Image picture = displayed(whole);
  if (auto drawn = draw_over(job.frame, picture); !drawn) return drawn;
  if (auto written = image::write_png(folder_.picture(job.frame), picture, image::PngEffort::fast); !written)
    return written;
  fs::remove(job.kept_in, error);
  return {};
}

Expected<void> FrameWriter::draw_over(std::uint64_t frame, image::Image& picture) {
  if (!has_overlays_) return {};
  if (!world_) {
    auto opened = FilmFrames::open(options_);
    if (!opened) return tl::unexpected(opened.error());
    world_.emplace(std::move(*opened));
  }
  const std::vector<FilmFrame>& frames = world_->plan().frames;
  const auto found = std::ranges::lower_bound(frames, frame, {}, &FilmFrame::number);
  SEPTET_CHECK(found != frames.end() && found->number == frame, "frame {}", frame);
  if (auto input = world_->input_of(*found); !input) return tl::unexpected(input.error());
  if (auto beside = world_->input_beside(*found); !beside) return tl::unexpected(beside.error());
  world_->draw_over(*found, picture);
  return {};
}

void FrameWriter::note_quality(const raytrace::TracedPicture& picture, const instant::Exposure& exposure) {
  const std::lock_guard lock(mutex_);
  quality_.bad_samples += picture.bad_samples;
  for (const raytrace::TracedPixel& pixel : picture.pixels) {
    const double error_of_pixel = raytrace::relative_error(pixel, exposure);
    quality_.squared_errors += error_of_pixel * error_of_pixel;
    quality_.samples += pixel.samples;
  }
  quality_.pixels += static_cast<double>(picture.pixels.size());
}

}  // namespace septet::film
