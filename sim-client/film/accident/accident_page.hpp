#pragma once
/// A page for print of an accident: what happened, figures with their origin, stills of each shot, speeds over time.

#include <string>
#include <vector>

#include "sim-client/film/accident/accident_plan.hpp"

namespace septet::film {

/// A still picture of a shot.
struct Still {
  std::string file;  ///< Beside the page.
  double instant_s = 0.0;
  std::size_t shot = 0;
};

/// HTML with its style and chart in it; stills lie beside it. `film` is the film's file there, `version` that of Septet.
std::string accident_page(const AccidentFacts& facts, const AccidentPlan& plan, const std::vector<Still>& stills,
                          const std::string& film, const std::string& version);

}  // namespace septet::film
