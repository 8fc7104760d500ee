#pragma once
/// What lies over a frame of a film: figures and words of an instant, and where they stand in the picture.
///
/// Pixels from the upper left of the picture. Pure but for the font, which measures text.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/film_script/shot.hpp"
#include "engine/image/draw.hpp"
#include "engine/image/font.hpp"
#include "engine/instant/view.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::film {

/// Colour of the n-th participant of an overlay, of Okabe and Ito's set, which colour-blind people tell apart.
image::Color color_of(std::size_t n);

/// A participant of the overlay.
struct OverlayPerson {
  ParticipantId number = 0;
  std::string name;
};

/// Places of a participant's ground point over the time of the film, ascending.
struct OverlayWay {
  std::vector<double> times_s;
  std::vector<Vec3> places_m;
};

/// Figures as their characters stand in the picture, without their units.
std::string clock_text(double time_s);                            ///< "   6.48", in s.
std::string contact_clock_text(double time_s, double contact_s);  ///< "  -1.24", "  +0.30", in s.
std::string speed_text(const Participant* participant);           ///< " 48.6", in km/h; " --.-": not there.
std::string slow_motion_text(double speed);                       ///< "0.25", of the speed of time.

/// A line of text with its box. A figure stands in cells of equal whole width (OverlaySizes::cell_px), so that the same
/// character is the same pixels wherever it stands.
struct OverlayLine {
  std::string text;
  std::int64_t x = 0, y = 0;  ///< Upper left of its box.
  std::int64_t width = 0, height = 0;
  bool is_figure = false;
  image::Color color{255, 255, 255, 255};
};

/// A way or an outline, as lines.
struct OverlayStroke {
  std::vector<image::Point> points;
  double width_px = 1.0;
  image::Color color;
};

struct OverlayContent {
  std::vector<OverlayStroke> strokes;  ///< Below the text.
  std::vector<OverlayLine> lines;
};

/// Height of a line of text in a picture of this height, and the size of its characters.
struct OverlaySizes {
  std::int64_t line_px = 0, cell_px = 0, baseline_px = 0;
  double text_px = 0.0;
};
OverlaySizes overlay_sizes(const image::Font& font, std::uint32_t height_px);

/// Everything that an overlay is made of, for one frame.
struct OverlayMoment {
  const Script& script;
  const Shot& shot;
  const Snapshot& world;
  std::span<const OverlayPerson> people;
  std::span<const OverlayWay> ways;           ///< One a person; empty: none are drawn.
  std::span<const instant::FrameView> views;  ///< One, or two beside each other.
  std::uint32_t width_px = 0, height_px = 0;
};
OverlayContent overlay_content(const OverlayMoment& moment, const image::Font& font);

/// Pixel of a point of the world in a view; empty behind the eye or far outside.
std::optional<image::Point> pixel_of(const instant::FrameView& view, const Vec3& point_m);

}  // namespace septet::film
