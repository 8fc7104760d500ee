#pragma once
/// Content of each frame of a film: log → interpolate → scene → frame, for either renderer.
///
/// A frame is a function of the session, its shot and its number in it. Frames may be requested in any order, on any
/// machine that has the session; ascending order is cheapest. One thread.

#include "engine/image/image.hpp"
#include "engine/instant/frame_input.hpp"
#include "sim-client/film/camera.hpp"
#include "sim-client/film/film.hpp"
#include "sim-client/frame/effects_drawing.hpp"
#include "sim-client/playback/session_instants.hpp"

namespace septet::film {

class FilmFrames {
 public:
  /// Reads script and scene. Errors: those of the session, the script, and shots that the session does not hold.
  static Expected<FilmFrames> open(const FilmOptions& options);
  FilmFrames(FilmFrames&&) noexcept;
  FilmFrames& operator=(FilmFrames&&) noexcept;
  ~FilmFrames();

  const FilmPlan& plan() const;  ///< Its frames are those between the options' `from_s` and `to_s`.
  /// The scene at the frame that `input_of` was asked for last; at first of the session's beginning. Its revision rises when
  /// it changes.
  const scene::ResolvedScene& scene() const;
  const logging::SessionInfo& session() const;

  /// Input of a frame of the plan. Error: the session cannot be read there.
  Expected<instant::FrameInput> input_of(const FilmFrame& frame);
  /// Input of a frame's second camera, of which the right half of the picture is drawn; empty: its shot has none. To be
  /// called right after `input_of` of the same frame, of which the left half is drawn then.
  Expected<std::optional<instant::FrameInput>> input_beside(const FilmFrame& frame);
  /// Draws what lies over a frame's picture: a border between two cameras, and its shot's overlay. To be called after
  /// `input_of`, and of two cameras `input_beside`, of that frame.
  void draw_over(const FilmFrame& frame, image::Image& picture) const;
  /// Input at the instant at which the shot's shutter closes; empty if the shutter is open for no time.
  Expected<std::optional<instant::FrameInput>> input_as_shutter_closes(const FilmFrame& frame);
  /// Input at the next frame's instant, or at the end of its shot if that comes first.
  Expected<instant::FrameInput> input_of_next(const FilmFrame& frame);

 private:
  struct State;
  /// Input at this share of a frame's time later.
  Expected<instant::FrameInput> input_after(const FilmFrame& frame, double share);
  /// `brings_scene`: the scene becomes that of the instant.
  Expected<instant::FrameInput> input_at(const FilmFrame& frame, double instant_s, const Look& look, bool brings_scene);
  explicit FilmFrames(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace septet::film
