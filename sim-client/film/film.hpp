#pragma once
/// A recorded session to the pictures of a film, drawn off-screen by the rasteriser or the ray tracer.
///
/// A frame depends on the session, the shot and its number in it (film_frames.hpp), and on no other frame, so that any share of a
/// film can be drawn anywhere.

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "engine/raytrace/bucket_schedule.hpp"
#include "engine/raytrace/ray_tracer.hpp"
#include "sim-client/film/camera_path.hpp"

namespace septet::program {
class Machines;
}

namespace septet::film {

enum class FilmRenderer : std::uint8_t {
  raster,  ///< engine/render, by a graphics card where there is one.
  traced,  ///< engine/raytrace, by the processor's cores.
};

/// OpenEXR pictures beside the others, with what numbers.
enum class ExrNumbers : std::uint8_t { none, half_precision, single_precision };

/// What they hold beside the light.
enum class Layer : std::uint8_t { depth, object, participant, normal, albedo, motion, variance };

struct FilmOptions {
  std::filesystem::path session;
  std::filesystem::path shots;  ///< Script; empty: the default one.
  /// Folder for the pictures, made, or empty already; or a film (film_file.hpp), whose pictures lie in a folder beside it until it is
  /// made of them.
  std::filesystem::path out;
  bool sound = true;    ///< Of a film as one file: what the driver heard, with its pictures (soundtrack/cut_track.hpp).
  bool resume = false;  ///< Goes on with the same film that was begun there: finished pictures stay (film_folder.hpp).
  double frames_per_second = 25.0;
  std::uint32_t width_px = 1280, height_px = 720;
  bool software =
      false;  ///< Drawn by the processor even where there is a graphics card: the same pixels as an off-screen screen's.
  FilmRenderer renderer = FilmRenderer::raster;
  std::uint32_t samples = 64;  ///< Of a pixel, of the ray tracer; the most of them where there is an `error`.
  double error = 0.0;          ///< Enough of it: raytrace::TraceSettings::error. 0: all samples are taken.
  /// Sent at ice by sun and lamps, of what is traced (raytrace::PhotonSettings): the light that it throws on other surfaces. 0: none.
  std::uint32_t caustic_photons = 100'000;
  std::uint32_t gather_photons =
      0;                 ///< Sent by lamps for a final gather, where they alone shine. 0: paths find all light.
  bool denoise = false;  ///< raytrace::denoised.
  raytrace::Filter filter = raytrace::Filter::quadratic;
  ExrNumbers exr = ExrNumbers::none;  ///< Of what is traced.
  std::set<Layer> layers;
  std::uint32_t sample_sets = 1;             ///< A tile's samples are dealt in so many sets; at most `samples`.
  raytrace::BucketScheduleOptions schedule;  ///< Of what is traced; the pictures are the same.
  std::filesystem::path statistics;          ///< File that tells who traced what (traced/statistics.hpp); empty: none.
  std::uint32_t every = 1;                   ///< Only the first of so many frames.
  std::optional<double> from_s,
      to_s;  ///< Only what the film shows between; of a film without a script, its beginning and end.
};

/// One frame of a film.
struct FilmFrame {
  std::uint64_t number = 0;  ///< From 1, through all shots.
  std::size_t shot = 0;
  std::size_t number_in_shot = 0;
  double instant_s = 0.0;
};

/// A script with the way of each shot's camera and all frames, in order.
struct FilmPlan {
  Script script;
  std::vector<std::vector<Look>> paths;  ///< By shot.
  std::vector<FilmFrame> frames;
};

/// Error: a shot that reaches beyond the session's span, or that has no path.
Expected<FilmPlan> plan_film(Script script, double frames_per_second, std::pair<double, double> span_s);

struct FilmMade {
  std::size_t frames = 0, planned = 0;
  std::size_t kept = 0;           ///< Of the frames: they were there already.
  bool encoding = false;          ///< All pictures are there, and a film is made of them.
  bool stopped = false;           ///< `go_on` has said no.
  double share_of_next = 0.0;     ///< Of the frames that are being drawn together: 1 is one frame.
  double kept_of_next = 0.0;      ///< What was there of them already.
  std::size_t workers = 0;        ///< That trace: programs, this one too.
  std::string notice;             ///< What was noticed last that does not stop the film: who has given up.
  std::uint64_t bad_samples = 0;  ///< Whose light was not a number: black.
  /// Of the pixels that were traced: the root mean square of their errors (raytrace::relative_error), samples of one.
  double error = 0.0, samples = 0.0;
};

using program::Machines;

/// Draws the film. `go_on` hears how far it is before each frame and while frames are traced; where it says no, the film ends there.
/// While a frame is traced, preview.png in the folder shows what there is of it. What is finished stays whatever happens: pictures, and of
/// frames that are traced their tiles. `others` help to trace (program/machines.hpp); null: nobody.
Expected<FilmMade> make_film(const FilmOptions& options, const std::function<bool(const FilmMade&)>& go_on,
                             Machines* others = nullptr);

}  // namespace septet::film
