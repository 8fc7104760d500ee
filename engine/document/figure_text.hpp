#pragma once
/// Figures as text: what every command that measures writes.

#include <span>
#include <string>
#include <vector>

#include "engine/core/figure.hpp"
#include "engine/document/json.hpp"

namespace septet::document {

/// The members of `about`, then the list `figures`.
std::string figures_json(Json about, std::span<const Figure> figures);
/// "name: value unit", for beside a plot.
std::vector<std::string> figure_notes(std::span<const Figure> figures);

}  // namespace septet::document
