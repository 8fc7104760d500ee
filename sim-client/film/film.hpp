#pragma once
/// Renders a recorded session to the pictures of a film, off-screen, by the rasteriser or the ray tracer.
///
/// A frame depends on the session, the shot and its number in it (film_frames.hpp), and on no other frame, so that any
/// share of a film can be drawn anywhere.

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/raytrace/bucket_schedule.hpp"
#include "engine/raytrace/ray_tracer.hpp"
#include "sim-client/film/camera_path.hpp"

namespace septet::program {
class Machines;
}

namespace septet::film {

enum class FilmRenderer : std::uint8_t {
  raster,  ///< engine/render, on a graphics card if there is one.
  traced,  ///< engine/raytrace, on the processor's cores.
};

/// OpenEXR pictures beside the others, and their number format.
enum class ExrNumbers : std::uint8_t { none, half_precision, single_precision };

/// Channels beside the light.
enum class Layer : std::uint8_t { depth, object, participant, normal, albedo, motion, variance };

struct FilmOptions {
  std::filesystem::path session;
  /// Other sessions whose participants are shown where they went another way (ghosts.hpp).
  std::vector<std::filesystem::path> ghosts;
  std::filesystem::path shots;  ///< Script; empty: the default one.
  /// Folder for the pictures: created, or empty already; or a film file (film_file.hpp), whose pictures lie in a folder
  /// beside it until it is encoded.
  std::filesystem::path out;
  bool sound = true;           ///< Adds the driver's sound to a film as one file (soundtrack/cut_track.hpp).
  bool resume = false;         ///< Continues the same film in that folder: finished pictures stay (film_folder.hpp).
  bool keep_pictures = false;  ///< The pictures of a film as one file stay.
  double frames_per_second = 25.0;
  std::uint32_t width_px = 1280, height_px = 720;
  /// Draws on the processor even if there is a graphics card: the same pixels as an off-screen screen's.
  bool software = false;
  FilmRenderer renderer = FilmRenderer::raster;
  std::uint32_t samples = 64;  ///< Ray tracer: samples per pixel; the maximum if there is an `error`.
  double error = 0.0;          ///< Target error: raytrace::TraceSettings::error. 0: all samples are taken.
  /// Ray tracer: photons sent at ice by sun and lamps (raytrace::PhotonSettings), for the light that it throws on other
  /// surfaces. 0: off.
  std::uint32_t caustic_photons = 100'000;
  /// Photons sent by lamps for a final gather, where lamps are the only light. 0: paths find all light.
  std::uint32_t gather_photons = 0;
  bool denoise = false;  ///< raytrace::denoised.
  raytrace::Filter filter = raytrace::Filter::quadratic;
  ExrNumbers exr = ExrNumbers::none;  ///< Ray tracer only.
  std::set<Layer> layers;
  std::uint32_t sample_sets = 1;  ///< Number of sets that a tile's samples are split into; at most `samples`.
  raytrace::BucketScheduleOptions schedule;  ///< Ray tracer only; the pictures do not depend on it.
  /// File that records which worker traced which tile (traced/statistics.hpp); empty: not written.
  std::filesystem::path statistics;
  std::uint32_t every = 1;  ///< Draw every n-th frame only.
  std::optional<double> from_s,
      to_s;  ///< Draw only this interval of the film; for a film without a script, its beginning and end.
};

/// One frame of a film.
struct FilmFrame {
  std::uint64_t number = 0;  ///< Counted from 1, through all shots.
  std::size_t shot = 0;
  std::size_t number_in_shot = 0;
  double instant_s = 0.0;
};

/// Script with the camera path of each shot and all frames, in order.
struct FilmPlan {
  Script script;
  std::vector<std::vector<Look>> paths;  ///< Indexed by shot.
  std::vector<FilmFrame> frames;
};

/// Error: a shot that reaches beyond the session's span, or that has no path.
Expected<FilmPlan> plan_film(Script script, double frames_per_second, std::pair<double, double> span_s);

struct FilmMade {
  std::size_t frames = 0, planned = 0;
  std::size_t kept = 0;           ///< Frames kept: they were there already.
  bool encoding = false;          ///< All pictures are there, and the film file is being encoded.
  bool stopped = false;           ///< `go_on` returned false.
  double share_of_next = 0.0;     ///< Progress of the frames being drawn together: 1 is one frame.
  double kept_of_next = 0.0;      ///< Share of these that was there already.
  std::size_t workers = 0;        ///< Programs that trace, including this one.
  std::string notice;             ///< Last event that does not stop the film: no scene, a worker that has given up.
  std::uint64_t bad_samples = 0;  ///< Samples with NaN or infinite light: counted as black.
  /// Root mean square of the traced pixels' errors (raytrace::relative_error); samples of one pixel.
  double error = 0.0, samples = 0.0;
};

using program::Machines;

/// Draws the film. `go_on` receives the progress before each frame and while frames are traced; if it returns false,
/// the film ends there. While a frame is traced, preview.png in the folder shows its present state. Finished work
/// survives any end: pictures, and the tiles of traced frames. `others` help to trace (program/machines.hpp); null:
/// this program alone.
Expected<FilmMade> make_film(const FilmOptions& options, const std::function<bool(const FilmMade&)>& go_on,
                             Machines* others = nullptr);

}  // namespace septet::film
