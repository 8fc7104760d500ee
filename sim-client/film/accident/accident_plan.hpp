#pragma once
/// Storyboard of an accident: from the log's facts to a film script, with the words that go with each shot.
///
/// Pure: the same facts, solids and shape of the picture give the same plan. Shots, as far as they last and their
/// cameras stand clear: from above with everybody's way; through the eyes of each of the two; both pairs of eyes at once;
/// from above and from beside in slow motion. Without a second the picture of two has the eyes and the view from above.

#include <string>
#include <vector>

#include "engine/film_script/shot.hpp"
#include "sim-client/film/accident/camera_clearance.hpp"

namespace septet::film {

/// A number of the plan with its origin, for the page and the manifest.
struct Figure {
  std::string name, unit;
  double value = 0.0;
  std::string origin;  ///< "logged event", "computed", …
};

struct AccidentPlan {
  std::string title;  ///< "ego and crosser meet at 6.48 s".
  Script script;
  std::vector<std::string> words;     ///< One or two sentences a shot, for subtitles.
  std::vector<std::string> left_out;  ///< Shots without a clear camera, in words.
  std::vector<Figure> figures;
};

/// `width_over_height`: of the picture.
AccidentPlan plan_accident(const AccidentFacts& facts, const Solids& solids, double width_over_height);

/// What is measured, what assumed and what computed in a film of these facts: one line each.
std::vector<std::string> origins(const AccidentFacts& facts);

}  // namespace septet::film
